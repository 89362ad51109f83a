// SPDX-License-Identifier: Apache-2.0
// The trace stage run over a whole image, and what it should have found.
#include "traced.hpp"

#include <algorithm>

#include "math/cover.h"
#include "math/sample.h"
#include "pipeline/light_records.hpp"
#include "pipeline/memory_plan.hpp"

namespace gnomon::test {
namespace {

/// Calls visit(index, x, y, segment, local) for every sample, x and y in raster space. The segment is that of the sample's
/// cell.
template <class Visit>
void for_each_sample(const Soup& soup, const Sampling& sampling, Visit visit) {
    size_t index = 0;
    for (uint32_t y = 0; y < soup.height; ++y) {
        for (uint32_t x = 0; x < soup.width; ++x) {
            const uint32_t hash = shared::pixel_hash(x, y, sampling.seed);
            for (uint32_t s = 0; s < sampling.spp; ++s, ++index) {
                const glm::vec3 p = shared::sample_point(hash, x, y, s, shared::stratum_length(sampling.spp));
                const bool straddles = sampling.spp % sampling.cells != 0;
                const uint32_t cell = straddles ? shared::cell_of(p.z, sampling.cells) : s / (sampling.spp / sampling.cells);
                const uint32_t segment = cell / (sampling.cells / soup.segments());
                visit(index, p.x - 0.5f * float(soup.width), p.y - 0.5f * float(soup.height), segment,
                      p.z * float(soup.segments()) - float(segment));
            }
        }
    }
}

}  // namespace

std::vector<uint32_t> trace(gpu::Device& device, Programs& programs, const Soup& soup, const Sampling& sampling,
                            uint64_t* tests) {
    const Geometry geometry = pose_geometry(device, programs, soup.scene(), soup.poses());
    const View view = soup.view();
    Bins bins = project_prisms(device, programs, geometry, view, sampling.cells, sampling.part);
    bins.lattice = Lattice{sampling.spp, sampling.seed};
    list_prisms(device, programs, geometry, view, {0, tiles_across(view) * tiles_down(view)}, Listing::facing_first, bins);
    const gpu::Buffer lights = gpu::upload_new(device, "lights", light_records(soup.scene(), soup.poses()));
    Sampler sampler(device, programs, geometry, view, bins, lights,
                    {.shadow_stage = "sample/shadow@array",
                     .spp = sampling.spp,
                     .seed = sampling.seed,
                     .most_slots = sampling.most_slots,
                     .count_ranges = tests != nullptr});
    std::vector<uint32_t> found(size_t(soup.width) * soup.height * sampling.spp, 0xdeadbeefu);
    uint64_t hits = 0;
    for (const Batch& batch : split_batches(bins.window, sampling.spp, sampling.most_slots, sampling.spp)) {
        sampler.trace(batch);
        const std::vector<uint32_t> slots = sampler.batch_hits();
        for (size_t slot = 0; slot < slots.size(); ++slot) {
            const auto [x, y, stratum] = slot_sample(batch, bins.grid, slot);
            hits += slots[slot] != shared::kNone ? 1 : 0;
            if (x >= soup.width || y >= soup.height) continue;
            found[(size_t(y) * soup.width + x) * sampling.spp + stratum] = slots[slot];
        }
    }
    // The queue holds the hits, all of them and no others; pixels outside the image hit nothing.
    if (sampler.hit_count() != hits ||
        hits != found.size() - static_cast<size_t>(std::count(found.begin(), found.end(), shared::kNone))) {
        throw std::logic_error("the queue holds " + std::to_string(sampler.hit_count()) + " hits of " + std::to_string(hits));
    }
    if (tests != nullptr) *tests = sampler.test_count();
    return found;
}

std::vector<uint32_t> trace_in_float(const Soup& soup, const Sampling& sampling) {
    std::vector<uint32_t> found(size_t(soup.width) * soup.height * sampling.spp, shared::kNone);
    const View view = soup.view();
    for_each_sample(soup, sampling, [&](size_t index, float x, float y, uint32_t segment, float local) {
        float nearest = view.depth_far;
        for (uint32_t i = 0; i < soup.triangles.size(); ++i) {
            const glm::uvec3& t = soup.triangles[i];
            const auto at = [&](uint32_t v) {
                return shared::vertex_at(soup.keys[segment][v], soup.keys[segment + 1][v] - soup.keys[segment][v], local);
            };
            const glm::vec4 p0 = at(t.x), p[2] = {at(t.y), at(t.z)};
            for (int reversed = 0; reversed < 2; ++reversed) {
                const glm::vec4 &p1 = p[reversed], &p2 = p[1 - reversed];
                const glm::vec3 e = shared::edges_at(p0, p1, p2, x, y);
                const float depth =
                    soup.orthographic ? shared::depth_orthographic(e, p0, p1, p2) : shared::depth_perspective(e, p0, p1, p2);
                if (!shared::covers(e) || !(depth > view.depth_near) || !(depth < nearest)) continue;
                nearest = depth;
                found[index] = reversed != 0 ? i | shared::kReversed : i;
            }
        }
    });
    return found;
}

uint64_t count_differences_from_oracle(const Soup& soup, const Sampling& sampling, const std::vector<uint32_t>& found) {
    std::vector<std::vector<oracle::MovingTriangle>> triangles;
    for (uint32_t k = 0; k < soup.segments(); ++k) triangles.push_back(soup.all_triangles(k));
    const View view = soup.view();
    uint64_t differences = 0;
    for_each_sample(soup, sampling, [&](size_t index, float x, float y, uint32_t segment, float local) {
        const std::vector<oracle::Seen> seen = seen_at(triangles[segment], x, y, local, view.depth_near, view.depth_far);
        const uint32_t expected =
            seen.empty() ? shared::kNone : seen[0].triangle | (seen[0].surface.positive ? 0u : shared::kReversed);
        differences += found[index] != expected ? 1 : 0;
    });
    return differences;
}

}  // namespace gnomon::test
