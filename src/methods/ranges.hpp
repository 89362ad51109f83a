// SPDX-License-Identifier: Apache-2.0
// Methods whose light side is an S-buffer of ranges: exact, dtr, dtr-analytic, and temporal, which also has a coverage map.
#pragma once

#include "methods/method.hpp"

namespace gnomon {

/// Of the methods whose ranges may come from raster/prism: cull-back-faces.
std::vector<Parameter> prism_parameters();

/// Errors: ErrorKind::usage, for cull-back-faces with a raster that keeps all prisms.
std::unique_ptr<ShadowMap> make_s_buffer(const LightContext& light, const Bins& bins);

/// An S-buffer whose covered texels have no ranges, and its coverage map.
std::unique_ptr<ShadowMap> make_temporal_map(const LightContext& light, const Bins& bins);

}  // namespace gnomon
