// SPDX-License-Identifier: Apache-2.0
// How different two pictures look: FLIP and SSIM.
#pragma once

#include <array>
#include <cstdint>
#include <gnomon/render.hpp>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::io {

/// What a screen shows: linear R, G and B of the sRGB primaries in [0, 1], rows from the top.
struct ShownPicture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::array<std::vector<double>, 3> rgb;
    uint64_t not_finite = 0;  ///< Values among them that were not.
};

/// R, G and B times 2^exposure_ev, clamped; what is not finite is black, and counted. Nothing where a channel is missing.
std::optional<ShownPicture> shown_picture(std::span<const Channel> channels, uint32_t width, uint32_t height,
                                          double exposure_ev);

/// 67.02: a picture of 3840 pixels on 0.7 m, seen from 0.7 m (Andersson et al. 2020, section 5).
constexpr double kPixelsPerDegree = 67.02064327658225;

/// The difference that is seen at each pixel when the pictures are flipped, 0 to 1.
/// Andersson et al. 2020, "FLIP: A difference evaluator for alternating images" (LDR-FLIP).
std::vector<double> flip(const ShownPicture& test, const ShownPicture& reference, double pixels_per_degree = kPixelsPerDegree);

/// Mean structural similarity of the luma, -1 to 1; 1 for equal pictures. Gaussian windows of 11x11, sigma 1.5, those that lie
/// in the picture whole; smaller ones for a picture that is smaller. Wang et al. 2004, "Image quality assessment: from error
/// visibility to structural similarity".
double ssim(const ShownPicture& a, const ShownPicture& b);

}  // namespace gnomon::io
