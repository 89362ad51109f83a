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

// What a triangle's corners have, blended at a hit. In arrays of floats, which compilers can fetch as vectors.
struct Corners {
    Corners(const Triangle& triangle, float u, float v)
        : a(size_t{3} * triangle.vertex[0]),
          b(size_t{3} * triangle.vertex[1]),
          c(size_t{3} * triangle.vertex[2]),
          w(1.0f - u - v),
          u_(u),
          v_(v) {}
    float blend(const float* values) const { return w * values[a] + u_ * values[b] + v_ * values[c]; }
    size_t a, b, c;
    float w, u_, v_;
};

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
    return kind_ == LightKind::point || glm::dot(to_light, motion_.at(t).rotation[2]) >= cos_outer_ * glm::length(to_light);
}

glm::vec3 PeerLight::arriving(const glm::vec3& point, float t, const glm::vec3& normal) const {
    const Placement place = motion_.at(t);
    const glm::vec3& axis = place.rotation[2];
    if (directional()) return power_ * std::max(0.0f, glm::dot(normal, axis));
    const glm::vec3 to_light = place.translation - point;
    const float distance2 = glm::dot(to_light, to_light);
    if (distance2 == 0.0f) return glm::vec3(0.0f);
    const glm::vec3 direction = to_light / std::sqrt(distance2);
    const float edge = (glm::dot(direction, axis) - cos_outer_) / std::max(0.001f, cos_inner_ - cos_outer_);
    const float cone = kind_ == LightKind::point ? 1.0f : std::clamp(edge, 0.0f, 1.0f);
    const float ratio2 = range_ > 0.0f ? distance2 / (range_ * range_) : 0.0f;
    const float window = std::clamp(1.0f - ratio2 * ratio2, 0.0f, 1.0f);
    return power_ * (cone * cone * window / distance2 * std::max(0.0f, glm::dot(normal, direction)));
}

void PeerLight::add_arriving(const Hits& hits, const Vectors& normals, Vectors& sums) const {
    if (still_sun()) {
        const glm::vec3 axis = motion_.at(0.0f).rotation[2], power = power_;
        for (uint32_t i = 0; i < hits.count; ++i) {
            const float cosine = normals.x[i] * axis.x + normals.y[i] * axis.y + normals.z[i] * axis.z;
            const float share = hits.lit[i] != 0 && cosine > 0.0f ? cosine : 0.0f;
            sums.x[i] += power.x * share;
            sums.y[i] += power.y * share;
            sums.z[i] += power.z * share;
        }
        return;
    }
    for (uint32_t i = 0; i < hits.count; ++i) {
        if (hits.lit[i] != 0) sums.set(i, sums.at(i) + arriving(hits.point.at(i), hits.t[i], normals.at(i)));
    }
}

Paint::Paint(const Scene& scene) {
    for (const Material& material : scene.materials) {
        base_colours.emplace_back(material.base_color);
        textured = textured || material.image >= 0;
    }
    smooth = std::any_of(scene.vertices.begin(), scene.vertices.end(),
                         [](const Vertex& vertex) { return vertex.normal != glm::vec3(0.0f); });
    const auto white = [](const Vertex& vertex) { return glm::vec3(vertex.color) == glm::vec3(1.0f); };
    if (std::all_of(scene.vertices.begin(), scene.vertices.end(), white)) return;
    colours.reserve(scene.vertices.size());
    for (const Vertex& vertex : scene.vertices) colours.emplace_back(vertex.color);
}

void Surface::get_normals(const Hits& hits, Vectors& normals) const {
    if (normals_.empty()) {
        normals = hits.normal;
        return;
    }
    const auto segment_count = static_cast<uint32_t>(normals_.size()) - 1;
    const Triangle* const triangles = scene_.triangles.data();
    const auto blend = [triangles, &hits, &normals](uint32_t i, const float* first, const float* last, float s) {
        const Corners corners(triangles[hits.triangle[i]], hits.u[i], hits.v[i]);
        const float x0 = corners.blend(first), y0 = corners.blend(first + 1), z0 = corners.blend(first + 2);
        const float x = x0 + s * (corners.blend(last) - x0);
        const float y = y0 + s * (corners.blend(last + 1) - y0);
        const float z = z0 + s * (corners.blend(last + 2) - z0);
        const float length2 = x * x + y * y + z * z;
        const float side = x * hits.normal.x[i] + y * hits.normal.y[i] + z * hits.normal.z[i];
        const bool smooth = length2 > 1e-20f;
        const float scale = (side < 0.0f ? -1.0f : 1.0f) / std::sqrt(smooth ? length2 : 1.0f);
        normals.x[i] = smooth ? x * scale : hits.normal.x[i];
        normals.y[i] = smooth ? y * scale : hits.normal.y[i];
        normals.z[i] = smooth ? z * scale : hits.normal.z[i];
    };
    if (segment_count == 1) {
        const float *first = &normals_[0][0].x, *last = &normals_[1][0].x;
        for (uint32_t i = 0; i < hits.count; ++i) blend(i, first, last, hits.t[i]);
        return;
    }
    for (uint32_t i = 0; i < hits.count; ++i) {
        const KeyTime when = key_time(hits.t[i], segment_count);
        blend(i, &normals_[when.segment][0].x, &normals_[when.segment + 1][0].x, when.s);
    }
}

void Surface::get_albedos(const Hits& hits, Vectors& albedos) const {
    const float* base = &paint_.base_colours[0].x;
    for (uint32_t i = 0; i < hits.count; ++i) {
        const size_t material = size_t{3} * scene_.triangles[hits.triangle[i]].material;
        albedos.x[i] = base[material];
        albedos.y[i] = base[material + 1];
        albedos.z[i] = base[material + 2];
    }
    if (!paint_.colours.empty()) {
        const float* colours = &paint_.colours[0].x;
        for (uint32_t i = 0; i < hits.count; ++i) {
            const Corners corners(scene_.triangles[hits.triangle[i]], hits.u[i], hits.v[i]);
            albedos.x[i] *= corners.blend(colours);
            albedos.y[i] *= corners.blend(colours + 1);
            albedos.z[i] *= corners.blend(colours + 2);
        }
    }
    if (!paint_.textured) return;
    for (uint32_t i = 0; i < hits.count; ++i) {
        const Triangle& triangle = scene_.triangles[hits.triangle[i]];
        const Material& material = scene_.materials[triangle.material];
        if (material.image < 0 || hits.lights[i] == 0) continue;
        const auto uv_of = [&](size_t corner) { return scene_.vertices[triangle.vertex[corner]].uv; };
        const glm::vec2 uv = (1.0f - hits.u[i] - hits.v[i]) * uv_of(0) + hits.u[i] * uv_of(1) + hits.v[i] * uv_of(2);
        albedos.set(i, albedos.at(i) *
                           texture(scene_.images[static_cast<size_t>(material.image)], material.wrap_u, material.wrap_v, uv));
    }
}

}  // namespace gnomon::peer
