// SPDX-License-Identifier: Apache-2.0
// Moving triangles as one Embree geometry, with its BVH.
#pragma once

#include "embree.hpp"
#include "motion.hpp"

namespace gnomon::reference {

/// A new Embree of so many threads; to be released. wide: it may use AVX-512, at which some processors run slower, and huge
/// pages. Errors: ErrorKind::internal.
RTCDevice new_embree(uint32_t threads, bool wide);

struct BuildSettings {
    RTCDevice device = nullptr;   ///< What builds; none: a new one of `threads`.
    uint32_t least_segments = 1;  ///< Linear motion is split into the least multiple of the surface's segments that reaches it.
    uint32_t threads = 1;
    bool robust = false;  ///< Rays do not slip through between triangles, and take longer.
    RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
    RTCFilterFunctionN occluded_filter = nullptr;  ///< Called for every candidate of a shadow ray.
};

/// Owns the Embree scene, and a share of its device. Primitive id = triangle index.
class EmbreeScene {
public:
    /// Build the BVH. `surface` must outlive this.
    /// Errors: ErrorKind::usage for more segments than Embree has; ErrorKind::out_of_memory, internal as Embree reports them.
    EmbreeScene(const SurfaceMotion& surface, const BuildSettings& settings);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene scene() const { return scene_; }
    uint32_t time_step_count() const { return time_step_count_; }

private:
    void check(const char* doing) const;
    void attach(const SurfaceMotion& surface, const BuildSettings& settings);

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    uint32_t time_step_count_ = 1;
};

}  // namespace gnomon::reference
