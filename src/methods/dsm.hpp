// SPDX-License-Identifier: Apache-2.0
// Deep shadow maps: a visibility function of depth per texel, from many samples whose times are forgotten.
// Sources: Lokovic and Veach 2000; Andersson et al. 2015, sections 2 and 6.
#pragma once

#include "methods/depth_map.hpp"
#include "stages/trace.hpp"

namespace gnomon {

/// map-spp, bias and cluster.
std::vector<Parameter> dsm_parameters();

/// How the light's view is sampled: map-spp or 128 times.
Sampling dsm_sampling(const LightContext& light);

/// Metres: cluster, else half the bias.
AxisLength dsm_extent(const LightContext& light);

/// The visibility functions of all texels, made at once. Errors: ErrorKind::out_of_memory.
std::unique_ptr<ShadowMap> make_deep_shadow_map(const LightContext& light, const Bins& bins);

}  // namespace gnomon
