// SPDX-License-Identifier: Apache-2.0
// What a hit reflects: diffuse surfaces under glTF lights, in float.
#include "surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::peer {
namespace {

const std::array<float, 256>& linear_from_srgb() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (size_t i = 0; i < t.size(); ++i) {
            const double e = static_cast<double>(i) / 255.0;
            t[i] = static_cast<float>(e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4));
        }
        return t;
    }();
    return table;
}

uint32_t wrapped(int32_t texel, uint32_t size, Wrap wrap) {
    const auto n = static_cast<int32_t>(size);
    if (wrap == Wrap::clamp_to_edge) return static_cast<uint32_t>(std::clamp(texel, 0, n - 1));
    const int32_t period = wrap == Wrap::repeat ? n : 2 * n;
    texel = (texel % period + period) % period;
    return static_cast<uint32_t>(texel < n ? texel : 2 * n - 1 - texel);
}

glm::vec3 texel_at(const Image& image, uint32_t x, uint32_t y) {
    const uint8_t* rgba = &image.rgba[(static_cast<size_t>(y) * image.width + x) * 4];
    const auto& linear = linear_from_srgb();
    return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]};
}

// Bilinear; texel centres lie at (i + 1/2) / size.
glm::vec3 texture(const Image& image, Wrap wrap_u, Wrap wrap_v, glm::vec2 uv) {
    const glm::vec2 p = uv * glm::vec2(image.width, image.height) - 0.5f;
    const glm::vec2 cell(std::floor(p.x), std::floor(p.y));
    const glm::vec2 f = p - cell;
    const auto i = static_cast<int32_t>(cell.x), j = static_cast<int32_t>(cell.y);
    const uint32_t x0 = wrapped(i, image.width, wrap_u), x1 = wrapped(i + 1, image.width, wrap_u);
    const uint32_t y0 = wrapped(j, image.height, wrap_v), y1 = wrapped(j + 1, image.height, wrap_v);
    return glm::mix(glm::mix(texel_at(image, x0, y0), texel_at(image, x1, y0), f.x),
                    glm::mix(texel_at(image, x0, y1), texel_at(image, x1, y1), f.x), f.y);
}

template <class Of>
auto interpolated(const Triangle& triangle, const Hit& hit, Of of) {
    return (1.0f - hit.u - hit.v) * of(triangle.vertex[0]) + hit.u * of(triangle.vertex[1]) + hit.v * of(triangle.vertex[2]);
}

}  // namespace

PeerLight::PeerLight(const Light& light, Motion motion)
    : kind_(light.kind),
      power_(light.color * light.intensity),
      range_(light.range),
      cos_inner_(std::cos(light.inner_cone)),
      cos_outer_(std::cos(light.outer_cone)),
      motion_(std::move(motion)) {}

glm::vec3 PeerLight::direction(const glm::vec3& point, float t) const {
    const Placement place = motion_.at(t);
    return directional() ? place.rotation[2] : place.translation - point;
}

bool PeerLight::in_cone(const glm::vec3& to_light, float t) const {
    return glm::dot(to_light, motion_.at(t).rotation[2]) >= cos_outer_ * glm::length(to_light);
}

glm::vec3 PeerLight::arriving(const Hit& hit, const glm::vec3& normal) const {
    if (!shadows()) return glm::vec3(0.0f);
    const Placement place = motion_.at(hit.t);
    const glm::vec3& axis = place.rotation[2];
    if (directional()) return power_ * std::max(0.0f, glm::dot(normal, axis));
    const glm::vec3 to_light = place.translation - hit.point;
    const float distance2 = glm::dot(to_light, to_light);
    if (distance2 == 0.0f) return glm::vec3(0.0f);
    const glm::vec3 direction = to_light / std::sqrt(distance2);
    const float cone =
        std::clamp((glm::dot(direction, axis) - cos_outer_) / std::max(0.001f, cos_inner_ - cos_outer_), 0.0f, 1.0f);
    const float ratio2 = range_ > 0.0f ? distance2 / (range_ * range_) : 0.0f;
    const float window = std::clamp(1.0f - ratio2 * ratio2, 0.0f, 1.0f);
    return power_ * (cone * cone * window / distance2 * std::max(0.0f, glm::dot(normal, direction)));
}

Surface::Surface(const Scene& scene, const std::vector<std::vector<glm::vec3>>& normals, uint32_t segment_count)
    : scene_(scene), normals_(normals), segment_count_(segment_count) {}

glm::vec3 Surface::albedo(const Hit& hit) const {
    const Triangle& triangle = scene_.triangles[hit.triangle];
    const Material& material = scene_.materials[triangle.material];
    glm::vec3 albedo = glm::vec3(material.base_color) *
                       interpolated(triangle, hit, [&](uint32_t i) { return glm::vec3(scene_.vertices[i].color); });
    if (material.image >= 0) {
        const glm::vec2 uv = interpolated(triangle, hit, [&](uint32_t i) { return scene_.vertices[i].uv; });
        albedo *= texture(scene_.images[static_cast<size_t>(material.image)], material.wrap_u, material.wrap_v, uv);
    }
    return albedo;
}

glm::vec3 Surface::normal(const Hit& hit) const {
    if (normals_.empty()) return hit.normal;
    const KeyTime when = key_time(hit.t, segment_count_);
    const glm::vec3* first = normals_[when.segment].data();
    const glm::vec3* last = normals_[when.segment + 1].data();
    const glm::vec3 smooth =
        interpolated(scene_.triangles[hit.triangle], hit, [&](uint32_t i) { return first[i] + when.s * (last[i] - first[i]); });
    const float length2 = glm::dot(smooth, smooth);
    if (length2 <= 1e-20f) return hit.normal;
    const float scale = 1.0f / std::sqrt(length2);
    return smooth * (glm::dot(smooth, hit.normal) < 0.0f ? -scale : scale);
}

}  // namespace gnomon::peer
