// SPDX-License-Identifier: Apache-2.0
// The samples of one tile of pixels: primary rays, shadow rays, shading, film.
#pragma once

#include <array>
#include <optional>

#include "surface.hpp"

namespace gnomon::peer {

inline constexpr uint32_t kTileSize = 16;  ///< Pixels along a side.

/// Everything that the threads share and do not change.
struct World {
    PeerSettings settings;
    PeerRays rays;
    RTCScene scene;
    const View& view;
    const std::vector<PeerLight>& lights;
    const Surface& surface;
};

/// What a thread did, and how long each part took it.
struct Tally {
    double primary_seconds = 0.0, shadow_seconds = 0.0, shade_seconds = 0.0;
    uint64_t hits = 0, shadow_tests = 0;
};

/// One per thread.
class Tracer {
public:
    explicit Tracer(const World& world);

    /// Trace the tile whose first pixel is (x_px, y_px) and write its pixels, as gnomon's channels.
    void trace(uint32_t x_px, uint32_t y_px, std::vector<Channel>& channels);

    const Tally& tally() const { return tally_; }

private:
    struct Pixel {
        uint32_t x, y, hash;
    };
    struct Sum {
        glm::vec3 reflected{0.0f};
        float depth = 0.0f;
        uint32_t hits = 0;
    };

    void choose_samples();
    void trace_primary();
    void find_hits();
    void trace_shadows(uint32_t light);
    uint32_t aim_at_sun(const PeerLight& light);
    uint32_t aim_at(const PeerLight& light);
    void begin_shading();
    void shade(uint32_t light);
    void add_to_film();
    void write(std::vector<Channel>& channels) const;

    const World& world_;
    std::vector<Pixel> pixels_;  ///< Of the tile, those in the image, so that 8 neighbours are 4 x 2 and 16 are 4 x 4.
    std::vector<Sum> sums_;      ///< By pixel.
    std::vector<uint32_t> lit_counts_;
    uint32_t next_slot_ = 0, next_stratum_ = 0;
    Rays rays_;
    std::array<uint32_t, kBatch> slots_{}, strata_{}, x_px_{}, y_px_{}, hashes_{};  ///< Of each ray.
    std::array<float, kBatch> x_{}, y_{};                                           ///< Where its sample lies, in pixels.
    Hits hits_;
    std::array<uint32_t, kBatch> shadowed_{};  ///< The hit of each shadow ray.
    Vectors normals_, albedos_, arriving_;
    Tally tally_;
};

}  // namespace gnomon::peer
