// SPDX-License-Identifier: Apache-2.0
// Traces the samples of one tile of pixels at a time: primary rays, shadow rays, film.
#pragma once

#include <optional>

#include "camera_view.hpp"
#include "embree_scene.hpp"
#include "reference.hpp"
#include "shading.hpp"

namespace gnomon::reference {

/// Everything that the threads share and do not change.
struct World {
    const SurfaceMotion& surface;
    const EmbreeScene& embree;
    CameraView camera;
    std::vector<TracedLight> lights;
    std::optional<Shading> shading;  ///< Without: no R G B.
};

/// What the samples of one pixel add up to.
struct PixelSum {
    glm::dvec3 reflected{0.0};
    double depth = 0.0;
    uint32_t hits = 0;
};

/// What a thread did, and how long each part took it.
struct TraceTally {
    double primary_seconds = 0.0, shadow_seconds = 0.0, shade_seconds = 0.0;
    uint64_t hits = 0, shadow_tests = 0;
};

/// One per thread.
class TileTracer {
public:
    static constexpr uint32_t kTileSize = 16;  ///< Pixels along a side.

    /// Samples are kept where the frame has room for them.
    TileTracer(const World& world, const ReferenceSettings& settings, Frame& frame);

    /// Trace all samples of the tile whose first pixel is (x_px, y_px). Sums are then indexed by (y % kTileSize) * kTileSize +
    /// x % kTileSize.
    void trace(uint32_t x_px, uint32_t y_px);

    const PixelSum& sum(uint32_t pixel) const { return sums_[pixel]; }
    uint32_t lit_count(uint32_t pixel, size_t light) const { return lit_counts_[pixel * world_.lights.size() + light]; }
    const TraceTally& tally() const { return tally_; }

private:
    void trace_primary(uint32_t s);
    void trace_packet(uint32_t packet, uint32_t s);
    void trace_shadows(size_t light);
    void add_to_film(uint32_t s);
    bool in_image(uint32_t hit_ix) const;

    const World& world_;
    const ReferenceSettings& settings_;
    Frame& frame_;
    uint32_t x_px_ = 0, y_px_ = 0;
    std::vector<Hit> hits_;     ///< Of one stratum of time, by packet and lane.
    std::vector<uint8_t> lit_;  ///< Of each hit, each light: does it reach it?
    std::vector<PixelSum> sums_;
    std::vector<uint32_t> lit_counts_;
    TraceTally tally_;
};

/// The occluded filter of the geometry: rejects the hit triangle itself and what lies too near to the hit.
void reject_near_occluders(const RTCFilterFunctionNArguments* args);

}  // namespace gnomon::reference
