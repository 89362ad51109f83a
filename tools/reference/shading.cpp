// SPDX-License-Identifier: Apache-2.0
// What a hit reflects: diffuse surfaces under glTF lights.
#include "shading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::reference {
namespace {

double linear_from_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const std::array<double, 256>& linear_from_srgb_table() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> t{};
        for (size_t i = 0; i < t.size(); ++i) t[i] = linear_from_srgb(static_cast<double>(i) / 255.0);
        return t;
    }();
    return table;
}

uint32_t wrapped(int64_t texel, uint32_t size, Wrap wrap) {
    const int64_t n = size;
    switch (wrap) {
        case Wrap::repeat:
            texel = (texel % n + n) % n;
            break;
        case Wrap::clamp_to_edge:
            texel = std::clamp<int64_t>(texel, 0, n - 1);
            break;
        case Wrap::mirrored_repeat:
            texel = (texel % (2 * n) + 2 * n) % (2 * n);
            if (texel >= n) texel = 2 * n - 1 - texel;
            break;
    }
    return static_cast<uint32_t>(texel);
}

glm::dvec3 texel_at(const Image& image, uint32_t x, uint32_t y) {
    const uint8_t* rgba = &image.rgba[(static_cast<size_t>(y) * image.width + x) * 4];
    const auto& linear = linear_from_srgb_table();
    return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]};
}

// Bilinear; texel centres lie at (i + 1/2) / size.
glm::dvec3 texture(const Image& image, Wrap wrap_u, Wrap wrap_v, glm::dvec2 uv) {
    const glm::dvec2 p = uv * glm::dvec2(image.width, image.height) - 0.5;
    const glm::dvec2 cell = glm::floor(p);
    const glm::dvec2 f = p - cell;
    const int64_t i = std::llround(cell.x), j = std::llround(cell.y);
    const uint32_t x0 = wrapped(i, image.width, wrap_u), x1 = wrapped(i + 1, image.width, wrap_u);
    const uint32_t y0 = wrapped(j, image.height, wrap_v), y1 = wrapped(j + 1, image.height, wrap_v);
    return glm::mix(glm::mix(texel_at(image, x0, y0), texel_at(image, x1, y0), f.x),
                    glm::mix(texel_at(image, x0, y1), texel_at(image, x1, y1), f.x), f.y);
}

// sum_i weight_i * of(corner i).
template <class Of>
auto interpolated(const Triangle& triangle, const Hit& hit, Of of) {
    const double u = hit.u, v = hit.v;
    return (1.0 - u - v) * of(triangle.vertex[0]) + u * of(triangle.vertex[1]) + v * of(triangle.vertex[2]);
}

}  // namespace

TracedLight::TracedLight(const Light& light, RigidMotion motion)
    : light_(light),
      motion_(std::move(motion)),
      cos_inner_(std::cos(double{light.inner_cone})),
      cos_outer_(std::cos(double{light.outer_cone})) {}

std::optional<glm::dvec3> TracedLight::shadow_ray(const Hit& hit) const {
    const RigidMotion::Placement placement = motion_.at(hit.when);
    if (light_.kind == LightKind::directional) return placement.rotation[2];
    const glm::dvec3 to_light = placement.translation - hit.point;
    const bool in_cone =
        light_.kind == LightKind::point || glm::dot(to_light, placement.rotation[2]) >= cos_outer_ * glm::length(to_light);
    return in_cone ? std::optional(to_light) : std::nullopt;
}

TracedLight::Arriving TracedLight::arriving(const Hit& hit) const {
    const RigidMotion::Placement placement = motion_.at(hit.when);
    const glm::dvec3 power = glm::dvec3(light_.color) * double{light_.intensity};
    if (light_.kind == LightKind::directional) return {power, placement.rotation[2]};
    const glm::dvec3 to_light = placement.translation - hit.point;
    const double distance = glm::length(to_light);
    if (distance == 0.0) return {glm::dvec3(0.0), placement.rotation[2]};
    const glm::dvec3 direction = to_light / distance;
    const double scale = 1.0 / std::max(0.001, cos_inner_ - cos_outer_);
    const bool point = light_.kind == LightKind::point;
    const double cone = point ? 1.0 : std::clamp((glm::dot(direction, placement.rotation[2]) - cos_outer_) * scale, 0.0, 1.0);
    const double window = light_.range > 0.0f ? std::clamp(1.0 - std::pow(distance / light_.range, 4.0), 0.0, 1.0) : 1.0;
    return {power * (cone * cone * window / (distance * distance)), direction};
}

Shading::Shading(const Scene& scene, const std::vector<Pose>& poses) : scene_(scene) {
    for (const Pose& pose : poses) normals_.push_back(posed_normals(scene, pose));
}

glm::dvec3 Shading::albedo(const Hit& hit) const {
    const Triangle& triangle = scene_.triangles[hit.triangle];
    const Material& material = scene_.materials[triangle.material];
    glm::dvec3 albedo = glm::dvec3(material.base_color) *
                        interpolated(triangle, hit, [&](uint32_t i) { return glm::dvec3(scene_.vertices[i].color); });
    if (material.image >= 0) {
        const glm::dvec2 uv = interpolated(triangle, hit, [&](uint32_t i) { return glm::dvec2(scene_.vertices[i].uv); });
        albedo *= texture(scene_.images[static_cast<size_t>(material.image)], material.wrap_u, material.wrap_v, uv);
    }
    return albedo;
}

glm::dvec3 Shading::normal(const Hit& hit) const {
    const glm::dvec3 smooth = interpolated(scene_.triangles[hit.triangle], hit, [&](uint32_t i) {
        return glm::mix(glm::dvec3(normals_[hit.when.segment][i]), glm::dvec3(normals_[hit.when.segment + 1][i]), hit.when.s);
    });
    const double length = glm::length(smooth);
    const glm::dvec3 facing = glm::dot(hit.normal, hit.to_eye) < 0.0 ? -hit.normal : hit.normal;
    if (length == 0.0) return facing;
    return glm::dot(smooth, facing) < 0.0 ? -smooth / length : smooth / length;
}

glm::dvec3 Shading::reflected(const Hit& hit, const std::vector<TracedLight>& lights, std::span<const uint8_t> lit) const {
    const glm::dvec3 n = normal(hit);
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < lights.size(); ++i) {
        if (lit[i] == 0) continue;
        const TracedLight::Arriving light = lights[i].arriving(hit);
        sum += light.irradiance * std::max(0.0, glm::dot(n, light.direction));
    }
    return sum * albedo(hit) * std::numbers::inv_pi;
}

}  // namespace gnomon::reference
