// SPDX-License-Identifier: Apache-2.0
// Texels of a light's view, with their ranges and the samples of a picture that ask there.
#pragma once

#include <gnomon/render.hpp>
#include <optional>
#include <vector>

#include "views/view.hpp"

namespace gnomon::cli {

/// Columns and rows from the top; of a light with several faces, one below the other.
struct Place {
    uint32_t x = 0;
    uint32_t y = 0;
    auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr): the check takes it for a 0
};

struct ProbedSample {
    Place pixel;
    uint32_t number = 0;    ///< Of the pixel's samples.
    uint32_t triangle = 0;  ///< That it hit.
    double time = 0.0;      ///< In the shutter, 0 to 1.
    double depth = 0.0;     ///< Metres along the axis of the light's view.
    bool lit = false;
    /// The camera sees another side of its triangle than the light: of a closed body it is then dark without a range.
    bool turned_away = false;
    /// Of a dark one the nearest triangle of the texel's ranges that hides it from the light, and its depth; none where it is
    /// turned away, or that is a matter of rounding.
    std::optional<uint32_t> shadowed_by = {};
    double shadow_depth = 0.0;
};

struct ProbedTexel {
    Place texel;
    std::vector<TexelRange> ranges;
    std::vector<ProbedSample> samples;
};

struct Probed {
    const Scene& scene;
    const std::vector<Pose>& poses;
    const RenderSettings& settings;
    const Frame& frame;  ///< With samples and ranges.
    uint32_t light = 0;
};

/// A texel of the light's view, with the samples of the whole picture that ask there.
ProbedTexel probe_texel(const Probed& probed, const Place& texel);

/// The texels that the samples of a pixel of the picture ask, those with most of them first, each with those samples.
std::vector<ProbedTexel> probe_pixel(const Probed& probed, const Place& pixel);

}  // namespace gnomon::cli
