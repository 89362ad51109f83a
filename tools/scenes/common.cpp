// SPDX-License-Identifier: Apache-2.0
// What several scenes share.
#include "common.hpp"

#include <cmath>
#include <gnomon/error.hpp>
#include <sstream>

namespace gnomon::makers {

void require_range(const std::string& option, double value, double low, double high) {
    if (value >= low && value <= high) return;
    std::ostringstream hint;
    hint.precision(10);
    hint << "give a value from " << low << " to " << high;
    throw Error(ErrorKind::usage, "value out of range", option, hint.str());
}

Rgb from_srgb(int r, int g, int b) {
    const auto linear = [](int byte) {
        const double v = byte / 255.0;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return {linear(r), linear(g), linear(b)};
}

Rgba bytes_of(Rgb color) {
    const auto byte = [](double v) { return static_cast<uint8_t>(std::lround(v * 255.0)); };
    return {byte(color.r), byte(color.g), byte(color.b), 255};
}

std::vector<double> key_times(double end, uint32_t count) {
    std::vector<double> times;
    for (uint32_t i = 0; i <= count; ++i) times.push_back(end * i / count);
    return times;
}

void add_ground(GltfWriter& writer, double half_size, double y, Rgb color) {
    const Mesh mesh = sheet(1, 1, [&](double u, double v) {
        return Vec3{half_size * (2.0 * u - 1.0), y, half_size * (1.0 - 2.0 * v)};
    });
    const Primitive primitive{&mesh, writer.add_material("ground", color)};
    writer.add_mesh_node("ground", writer.add_mesh("ground", {&primitive, 1}));
}

Placement looking_at(Vec3 position, Vec3 target) { return {position, look_rotation(target - position, {0.0, 1.0, 0.0})}; }

void add_fill_light(GltfWriter& writer, Vec3 direction) {
    writer.add_directional_light("fill", direction, direction * -5.0, {0.72, 0.84, 1.0}, 0.8);
}

}  // namespace gnomon::makers
