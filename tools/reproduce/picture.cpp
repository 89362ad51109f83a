// SPDX-License-Identifier: Apache-2.0
// What a report shows of frames, as images that HTML can hold.
#include "reproduce/picture.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/glm.hpp>

#include "html/image.hpp"
#include "io/png.hpp"

namespace gnomon::reproduce {
namespace {

// sRGB. Even steps of lightness: what is brighter on the screen is more.
constexpr std::array<glm::dvec3, 6> kScale = {
    {{8, 8, 24}, {66, 26, 110}, {148, 44, 108}, {214, 80, 64}, {246, 158, 40}, {252, 244, 176}}};

glm::dvec3 scale_colour(double value) {
    const double place = std::clamp(value, 0.0, 1.0) * (kScale.size() - 1);
    const size_t i = std::min(static_cast<size_t>(place), kScale.size() - 2);
    return glm::mix(kScale[i], kScale[i + 1], place - static_cast<double>(i));
}

glm::dvec3 signed_colour(double value) {
    const glm::dvec3 white(250.0), orange(196, 84, 0), blue(0, 92, 190);
    // Small shares are to be seen too.
    return glm::mix(white, value < 0.0 ? orange : blue, std::sqrt(std::min(1.0, std::abs(value))));
}

template <class Colour>
std::string coloured(uint32_t width, uint32_t height, std::span<const double> values, Colour colour) {
    assert(values.size() == size_t{width} * height);
    std::vector<uint8_t> rgb;
    rgb.reserve(values.size() * 3);
    for (const double value : values) {
        const glm::dvec3 c = colour(value);
        for (int i = 0; i < 3; ++i) rgb.push_back(static_cast<uint8_t>(std::lround(c[i])));
    }
    return html::png_address(width, height, rgb);
}

}  // namespace

std::string picture_of(const Frame& frame) {
    return html::png_address(frame.width, frame.height, io::tone_map(frame.channels, 0.0));
}

std::string difference_picture(const Frame& a, const Frame& b) {
    std::vector<Channel> difference;
    for (const Channel& channel : a.channels) {
        if (channel.name != "R" && channel.name != "G" && channel.name != "B") continue;
        const auto other =
            std::find_if(b.channels.begin(), b.channels.end(), [&](const Channel& c) { return c.name == channel.name; });
        assert(other != b.channels.end());
        Channel& shown = difference.emplace_back(channel);
        for (size_t i = 0; i < shown.values.size(); ++i) shown.values[i] = std::abs(shown.values[i] - other->values[i]);
    }
    return html::png_address(a.width, a.height, io::tone_map(difference, 0.0));
}

std::string signed_picture(uint32_t width, uint32_t height, std::span<const double> values) {
    return coloured(width, height, values, signed_colour);
}

std::string scale_picture(uint32_t width, uint32_t height, std::span<const double> values) {
    return coloured(width, height, values, scale_colour);
}

std::string scale_gradient() {
    std::string colours;
    for (const glm::dvec3& c : kScale) colours += fmt::format(", rgb({:.0f} {:.0f} {:.0f})", c.x, c.y, c.z);
    return "linear-gradient(to right" + colours + ")";
}

}  // namespace gnomon::reproduce
