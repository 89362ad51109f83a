// SPDX-License-Identifier: Apache-2.0
// How far the ranges of triangulated prisms, and depth that is linear in time, are from the true ones (Hong and Oh 2018,
// sections 3.3 and 4.1).
#pragma once

#include <cstdint>
#include <gnomon/scene.hpp>
#include <vector>

#include "views/view.hpp"

namespace gnomon::cli {

/// Of a list of numbers; zero, if there are none.
struct Spread {
    double mean = 0.0;
    double p99 = 0.0;  ///< 99 of 100 are at most so large.
    double most = 0.0;
};
Spread spread_of(std::vector<float> values);

/// Summed over all pairs of a triangle and a texel whose centre it covers at some time, in each segment.
struct RangeErrors {
    uint64_t pairs = 0;          ///< With a true range or one of the prism.
    uint64_t missed = 0;         ///< Pairs with a true range and none of the prism.
    uint64_t invented = 0;       ///< Pairs with one of the prism and no true range.
    uint64_t several = 0;        ///< Pairs with more than one true range.
    uint64_t left_over = 0;      ///< Prism fragments without a partner.
    double true_time = 0.0;      ///< Shutters: length of all true ranges,
    double time_missed = 0.0;    ///< of what of them the prism's leave out,
    double time_invented = 0.0;  ///< of what these have besides.
    Spread entry_time;           ///< Shutters, of pairs with one range each.
    Spread exit_time;
    Spread entry_depth;  ///< Metres, likewise: at the prism's entry less at the true one.
    Spread exit_depth;
    Spread linear_depth;        ///< Metres: linear between the true ends, less true, where that is largest within a range.
    Spread prism_depth;         ///< Metres: linear between the prism's ends, less true, at the largest over both ranges.
    Spread prism_depth_texels;  ///< The same in widths of a texel there.
};

/// Of the light's faces, taken together. poses: the keys of the segments.
RangeErrors range_errors(const Scene& scene, const std::vector<Pose>& poses, const std::vector<View>& faces);

}  // namespace gnomon::cli
