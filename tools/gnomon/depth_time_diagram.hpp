// SPDX-License-Identifier: Apache-2.0
// What a texel of a light's view knows, drawn: time to the right, depth from the light downward.
#pragma once

#include <string>
#include <vector>

#include "probed_texels.hpp"

namespace gnomon::cli {

struct DiagramText {
    std::string title;         ///< Of the scene and the light.
    double shutter_open = 0;   ///< Seconds.
    double shutter_close = 0;  ///< Seconds.
    bool exit_depths = false;  ///< Depth is linear in a range; else what a range has is the nearest.
};

/// An SVG image with a diagram for each texel, at most eight of them, one below the other.
std::string depth_time_diagram(const std::vector<ProbedTexel>& texels, const DiagramText& text);

}  // namespace gnomon::cli
