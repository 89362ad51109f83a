// SPDX-License-Identifier: Apache-2.0
// The peer: gnomon's picture by Embree as fast as it goes, for the benchmark to compare with. It takes the same samples and
// shades the same surfaces; pictures are compared with the exact reference instead.
#pragma once

#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

enum class PeerQuality { low, medium, high };                         ///< Of Embree's BVH.
enum class RayCalls { single, packets_of_8, packets_of_16, stream };  ///< How Embree is asked; streams in Embree 3 only.
/// Which rays follow each other: those of neighbouring pixels in one stratum of time, or all strata of a pixel.
enum class RayOrder { pixels, strata };

struct PeerBuild {
    uint32_t segments = 1;  ///< Embree gets the motion in at least this many.
    PeerQuality quality = PeerQuality::medium;
};

struct PeerRays {
    RayCalls calls = RayCalls::packets_of_8;
    RayOrder order = RayOrder::pixels;
};

std::string name_of(PeerQuality quality);     ///< "low", "medium", "high"
std::string name_of(RayCalls calls);          ///< "single", "packets of 8", "packets of 16", "stream"
std::string name_of(RayOrder order);          ///< "pixels", "strata"
std::string name_of(const PeerBuild& build);  ///< "8 segments, medium"
std::string name_of(const PeerRays& rays);    ///< "packets of 16, pixels"

/// What is worth trying: 1 and 8 segments at each quality, each way to ask in either order.
std::vector<PeerBuild> peer_builds();
std::vector<PeerRays> peer_rays();

struct PeerSettings {
    uint32_t width = 1280;
    uint32_t height = 720;
    uint32_t spp = 16;
    uint32_t seed = 0;
    uint32_t camera = 0;
    uint32_t threads = 1;
};

/// What of a scene does not move, and Embree, for several frames. The scene must outlive this. Errors: ErrorKind::internal.
class PeerScene {
public:
    /// threads: as PeerSettings's.
    PeerScene(const Scene& scene, uint32_t threads);
    ~PeerScene();

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

/// A scene that is posed, and its BVH.
class Peer {
public:
    /// The scene must outlive this. Settings as those of trace_reference. Errors: ErrorKind::out_of_memory, internal from
    /// Embree.
    Peer(const PeerScene& scene, const std::vector<Pose>& poses, const PeerSettings& settings, const PeerBuild& build);
    ~Peer();

    double prepare_seconds() const;  ///< Posing and building.

    /// Channels as gnomon's. Stages: pose and build, which ran before, then primary, shadow, shade (film included), whose wall
    /// time is split by the time that the threads spent in each. wall_seconds includes all.
    ///
    /// Rays are in float. Occluders nearer to a hit than 2^-18 of its largest coordinate, measured along the hit triangle's
    /// normal, do not count; Embree's BVH is not robust.
    ///
    /// frame: its channels' memory is used again.
    void trace(const PeerRays& rays, Frame& frame) const;

    /// Trace every `step`th tile only. Returns their share of all tiles. scratch: for their pixels; made by the first call that
    /// it is handed to, so that others can be timed without it.
    double trace_part(const PeerRays& rays, uint32_t step, std::vector<Channel>& scratch) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Both steps. Seconds include them.
void trace_peer(const PeerScene& scene, const std::vector<Pose>& poses, const PeerSettings& settings, const PeerBuild& build,
                const PeerRays& rays, Frame& frame);
/// One frame of a scene.
Frame trace_peer(const Scene& scene, const std::vector<Pose>& poses, const PeerSettings& settings, const PeerBuild& build,
                 const PeerRays& rays);

}  // namespace gnomon
