// SPDX-License-Identifier: Apache-2.0
// What a report shows of frames, as images that HTML can hold.
#pragma once

#include <cstdint>
#include <gnomon/render.hpp>
#include <span>
#include <string>
#include <vector>

namespace gnomon::reproduce {

/// The picture in sRGB.
std::string picture_of(const Frame& frame);

/// |a - b| of the linear colours, in sRGB.
std::string difference_picture(const Frame& a, const Frame& b);

/// Signed values: -1 orange, 0 white, 1 blue.
std::string signed_picture(uint32_t width, uint32_t height, std::span<const double> values);

/// 0 black over violet and orange to 1 pale yellow.
std::string scale_picture(uint32_t width, uint32_t height, std::span<const double> values);

/// The colours of scale_picture from left to right, as CSS.
std::string scale_gradient();

}  // namespace gnomon::reproduce
