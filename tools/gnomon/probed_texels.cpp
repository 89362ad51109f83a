// SPDX-License-Identifier: Apache-2.0
#include "probed_texels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "math/sample.h"

namespace gnomon::cli {
namespace {

using Corners = std::array<glm::dvec4, 3>;

/// The edge functions of the corners, in raster space, at (x, y): each of the edge opposite to a corner.
glm::dvec3 edges(const Corners& c, double x, double y) {
    const auto edge = [&](const glm::dvec4& a, const glm::dvec4& b) {
        return (a.x - x * a.w) * (b.y - y * b.w) - (a.y - y * a.w) * (b.x - x * b.w);
    };
    return {edge(c[1], c[2]), edge(c[2], c[0]), edge(c[0], c[1])};
}

/// Their sum's sign says which side of the triangle is seen; over it they are the weights of the corners at the point that is
/// seen there, which without area are NaN.
double sum(const glm::dvec3& e) { return e.x + e.y + e.z; }

glm::dvec4 weighted(const Corners& c, const glm::dvec3& weights) {
    return weights.x * c[0] + weights.y * c[1] + weights.z * c[2];
}

/// Follows samples into the light's view: in double, where the device has floats.
class LightLookup {
public:
    explicit LightLookup(const Probed& p)
        : probed_(p),
          camera_(
              camera_view(p.scene.cameras[p.settings.camera], p.poses, p.settings.camera, p.settings.width, p.settings.height)),
          faces_(light_faces(p.scene.lights[p.light], p.poses, p.light, bounds_of(p.scene, p.poses), p.settings.shadow_res)),
          ranges_(p.frame.light_ranges[p.light]) {
        for (const Pose& pose : p.poses) positions_.push_back(posed_positions(p.scene, pose));
    }

    /// Where a sample that hit asks, and the sample; nothing where its hit is in no face of the light's, or in another texel
    /// than the only one that counts.
    std::optional<std::pair<Place, ProbedSample>> follow(const Place& pixel, uint32_t number,
                                                         const Place* only = nullptr) const {
        const RenderSettings& s = probed_.settings;
        const size_t index = (size_t(pixel.y) * s.width + pixel.x) * s.spp + number;
        const SampleRecord& record = probed_.frame.samples[index];
        if (record.triangle == SampleRecord::kMiss) return std::nullopt;
        const glm::vec3 at = shared::sample_point(shared::pixel_hash(pixel.x, pixel.y, s.seed), pixel.x, pixel.y, number,
                                                  shared::stratum_length(s.spp));
        const glm::dvec3 at_pixel = edges(corners(camera_, record.triangle, at.z), at.x - 0.5 * s.width, at.y - 0.5 * s.height);
        for (size_t f = 0; f < faces_.size(); ++f) {
            const View& face = faces_[f];
            const Corners seen = corners(face, record.triangle, at.z);
            const glm::dvec4 hit = weighted(seen, at_pixel / sum(at_pixel));
            const double x = hit.x / hit.w + 0.5 * face.width, y = hit.y / hit.w + 0.5 * face.height;
            if (!(hit.w > 0.0 && x >= 0.0 && x < face.width && y >= 0.0 && y < face.height)) continue;
            const Place texel{static_cast<uint32_t>(x), static_cast<uint32_t>(y) + static_cast<uint32_t>(f) * face.height};
            if (only != nullptr && texel != *only) continue;
            ProbedSample sample{pixel,
                                number,
                                record.triangle,
                                at.z,
                                face.orthographic ? hit.z : hit.w,
                                probed_.frame.lit(index, probed_.light)};
            sample.turned_away = (sum(edges(seen, hit.x / hit.w, hit.y / hit.w)) < 0.0) != (sum(at_pixel) < 0.0);
            if (!sample.lit) find_shadow(face, hit, texel, sample);
            return std::pair(texel, sample);
        }
        return std::nullopt;
    }

    /// The texel without samples.
    ProbedTexel texel(const Place& place) const {
        const auto [first, end] = ranges_in(place);
        return {place, {first, end}, {}};
    }

private:
    using Range = std::vector<TexelRange>::const_iterator;

    std::pair<Range, Range> ranges_in(const Place& place) const {
        const uint32_t number = place.y * ranges_.width + place.x;
        const auto before = [](const TexelRange& r, uint32_t texel) { return r.texel < texel; };
        const auto first = std::lower_bound(ranges_.ranges.begin(), ranges_.ranges.end(), number, before);
        return {first, std::lower_bound(first, ranges_.ranges.end(), number + 1, before)};
    }

    Corners corners(const View& view, uint32_t triangle, double time) const {
        const double keys = time * static_cast<double>(view.keys.size() - 1);
        const size_t key = std::min(static_cast<size_t>(keys), view.keys.size() - 2);
        Corners result;
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t vertex = probed_.scene.triangles[triangle].vertex[i];
            result[i] = glm::mix(project(view.keys[key], positions_[key][vertex]),
                                 project(view.keys[key + 1], positions_[key + 1][vertex]), keys - static_cast<double>(key));
        }
        return result;
    }

    static glm::dvec4 project(const ViewKey& key, const glm::vec3& position) {
        const glm::dvec4 p(glm::dvec3(position) - glm::dvec3(key.origin), 1.0);
        return {glm::dot(glm::dvec4(key.row_x), p), glm::dot(glm::dvec4(key.row_y), p), glm::dot(glm::dvec4(key.row_z), p),
                glm::dot(glm::dvec4(key.row_w), p)};
    }

    /// By the method's own rule: a range whose depth is linear between its ends, or the triangle itself.
    std::optional<double> depth_at(const View& face, const glm::dvec4& hit, const TexelRange& r, double time) const {
        if (ranges_.exit_depths)
            return glm::mix(double(r.depth), double(r.exit_depth),
                            (time - r.enter) / std::max(1e-30, double(r.leave) - r.enter));
        const Corners c = corners(face, r.triangle, time);
        const glm::dvec3 e = edges(c, hit.x / hit.w, hit.y / hit.w), weights = e / sum(e);
        if (!(weights.x >= 0.0 && weights.y >= 0.0 && weights.z >= 0.0)) return std::nullopt;
        const glm::dvec4 at = weighted(c, weights);
        return face.orthographic ? at.z : at.w;
    }

    void find_shadow(const View& face, const glm::dvec4& hit, const Place& texel, ProbedSample& sample) const {
        const auto [first, end] = ranges_in(texel);
        for (auto r = first; r != end; ++r) {
            if (r->triangle == sample.triangle || sample.time < r->enter || sample.time > r->leave) continue;
            const std::optional<double> depth = depth_at(face, hit, *r, sample.time);
            if (!depth || !(*depth < sample.depth) || (!face.orthographic && *depth <= 0.0)) continue;
            if (sample.shadowed_by && sample.shadow_depth <= *depth) continue;
            sample.shadowed_by = r->triangle;
            sample.shadow_depth = *depth;
        }
    }

    const Probed& probed_;
    View camera_;
    std::vector<View> faces_;
    const LightRanges& ranges_;
    std::vector<std::vector<glm::vec3>> positions_;  ///< At each key.
};

}  // namespace

ProbedTexel probe_texel(const Probed& probed, const Place& texel) {
    const LightLookup lookup(probed);
    ProbedTexel result = lookup.texel(texel);
    for (uint32_t y = 0; y < probed.settings.height; ++y) {
        for (uint32_t x = 0; x < probed.settings.width; ++x) {
            for (uint32_t s = 0; s < probed.settings.spp; ++s) {
                const auto found = lookup.follow({x, y}, s, &texel);
                if (found) result.samples.push_back(found->second);
            }
        }
    }
    return result;
}

std::vector<ProbedTexel> probe_pixel(const Probed& probed, const Place& pixel) {
    const LightLookup lookup(probed);
    std::map<Place, ProbedTexel> texels;
    for (uint32_t s = 0; s < probed.settings.spp; ++s) {
        const auto found = lookup.follow(pixel, s);
        if (!found) continue;
        ProbedTexel& texel = texels.try_emplace(found->first, lookup.texel(found->first)).first->second;
        texel.samples.push_back(found->second);
    }
    std::vector<ProbedTexel> result;
    for (auto& [place, texel] : texels) result.push_back(std::move(texel));
    std::stable_sort(result.begin(), result.end(),
                     [](const ProbedTexel& a, const ProbedTexel& b) { return a.samples.size() > b.samples.size(); });
    return result;
}

}  // namespace gnomon::cli
