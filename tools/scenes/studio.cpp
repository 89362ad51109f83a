// SPDX-License-Identifier: Apache-2.0
// A studio: a chequered floor that bends upward into a wall.
#include <algorithm>

#include "common.hpp"
#include "png.hpp"

namespace gnomon::makers {
namespace {

/// Two tones in a checker with a thin line between the fields.
std::vector<uint8_t> checker_png() {
    constexpr uint32_t kSize = 64, kField = kSize / 2;
    std::vector<uint8_t> rgb;
    for (uint32_t y = 0; y < kSize; ++y) {
        for (uint32_t x = 0; x < kSize; ++x) {
            const bool line = x % kField == 0 || y % kField == 0;
            const bool light = (x / kField + y / kField) % 2 == 0;
            const int tone = line ? 186 : light ? 226 : 210;
            for (const int drop : {0, 5, 16}) rgb.push_back(static_cast<uint8_t>(tone - drop));
        }
    }
    return encode_png(kSize, kSize, rgb);
}

/// The walls and floor of a studio: a floor that bends upward into a wall. The floor's uv are in fields of the checker.
struct Studio {
    Mesh floor, backdrop;
};
Studio studio() {
    constexpr double kHalfWidth = 9.0, kFront = 6.0, kBend = -3.0, kRadius = 2.0, kTop = 5.0;
    Studio studio;
    studio.floor = sheet(1, 1, [](double u, double v) {
        return Vec3{kHalfWidth * (2.0 * u - 1.0), 0.0, kFront + (kBend - kFront) * v};
    });
    for (auto& uv : studio.floor.uvs) uv = {2.0 * kHalfWidth * uv[0], (kFront - kBend) * uv[1]};

    constexpr uint32_t kArcRows = 16;
    studio.backdrop = sheet(1, kArcRows + 1, [](double u, double v) {
        const double row = v * (kArcRows + 1), angle = kPi / 2.0 * std::min(1.0, row / kArcRows);
        const double y = row > kArcRows + 0.5 ? kTop : kRadius * (1.0 - std::cos(angle));
        return Vec3{kHalfWidth * (2.0 * u - 1.0), y, kBend - kRadius * std::sin(angle)};
    });
    studio.backdrop.uvs.clear();
    return studio;
}

}  // namespace

int add_checker_material(GltfWriter& writer, const std::string& name) {
    return writer.add_material(name, {}, writer.add_image("checker", checker_png()));
}

void add_studio(GltfWriter& writer, double turn, double scale) {
    Studio room = studio();
    for (Mesh* part : {&room.floor, &room.backdrop}) part->map([&](Vec3 p) { return p * scale; });
    const Primitive primitives[] = {{&room.floor, add_checker_material(writer, "floor")},
                                    {&room.backdrop, writer.add_material("backdrop", from_srgb(206, 204, 198))}};
    writer.add_mesh_node("studio", writer.add_mesh("studio", primitives), {{}, axis_angle({0.0, 1.0, 0.0}, turn)});
}

}  // namespace gnomon::makers
