// SPDX-License-Identifier: Apache-2.0
// Methods whose light side is an S-buffer of ranges: exact; dtr and dtr-analytic, which test linear depths; temporal, which
// also has a coverage map.
#pragma once

#include "methods/method.hpp"

namespace gnomon {

/// bias, and cull-back-faces where ranges come from triangulated prisms.
std::vector<Parameter> dtr_parameters(bool prisms);

std::unique_ptr<ShadowMap> make_s_buffer(const LightContext& light, const Bins& bins);

/// Errors: ErrorKind::usage, for cull-back-faces with a raster that keeps all prisms.
std::unique_ptr<ShadowMap> make_dtr_map(const LightContext& light, const Bins& bins);

/// An S-buffer whose covered texels have no ranges, and its coverage map.
std::unique_ptr<ShadowMap> make_temporal_map(const LightContext& light, const Bins& bins);

}  // namespace gnomon
