// SPDX-License-Identifier: Apache-2.0
#include "io/pixel_mean.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace gnomon::io {

namespace {

// How often two blocks of this side go into a length.
uint64_t fours_along(uint64_t length, double side) {
    return std::max<uint64_t>(1, static_cast<uint64_t>(std::lround(static_cast<double>(length) / (2.0 * side))));
}

}  // namespace

PixelMean pixel_mean(std::span<const double> values, uint32_t width) {
    assert(width > 0 && values.size() % width == 0);
    PixelMean result;
    double sum = 0.0;
    for (const double value : values) {
        if (std::isnan(value)) continue;
        sum += value;
        ++result.count;
    }
    if (result.count == 0) return result;
    const auto count = static_cast<double>(result.count);
    result.mean = sum / count;
    if (result.count < 2) return result;

    const uint64_t height = values.size() / width;
    const double side = std::pow(static_cast<double>(values.size()), 0.25);
    const uint64_t across = fours_along(width, side), down = fours_along(height, side);
    std::vector<double> contrasts(across * down, 0.0);
    for (uint64_t y = 0; y < height; ++y) {
        const uint64_t row = 2 * y * down / height;
        for (uint64_t x = 0; x < width; ++x) {
            const double value = values[y * width + x];
            if (std::isnan(value)) continue;
            const uint64_t column = 2 * x * across / width;
            const double sign = (row + column) % 2 == 0 ? 1.0 : -1.0;
            contrasts[row / 2 * across + column / 2] += sign * (value - result.mean);
        }
    }
    double variance = 0.0;
    for (const double contrast : contrasts) variance += contrast * contrast;
    result.standard_error = std::sqrt(variance) / count;
    return result;
}

double standard_error_of_two(std::span<const double> values, std::span<const double> again, uint32_t width) {
    assert(values.size() == again.size());
    std::vector<double> differences(values.size());
    for (size_t i = 0; i < values.size(); ++i) differences[i] = values[i] - again[i];
    return pixel_mean(differences, width).standard_error / std::numbers::sqrt2;
}

}  // namespace gnomon::io
