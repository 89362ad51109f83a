// SPDX-License-Identifier: Apache-2.0
// Moving triangles as one Embree geometry, with its BVH.
#pragma once

#include <embree3/rtcore.h>

#include "motion.hpp"

namespace gnomon::reference {

/// Owns the Embree device and scene. Primitive id = triangle index.
class EmbreeScene {
public:
    /// Build the BVH. Linear motion is split into the least multiple of the surface's segments that is >= least_segments.
    /// occluded_filter is called for every candidate of a shadow ray. `surface` must outlive this.
    /// Errors: ErrorKind::usage for more segments than Embree has; ErrorKind::out_of_memory, internal as Embree reports them.
    EmbreeScene(const SurfaceMotion& surface, uint32_t least_segments, uint32_t threads, RTCFilterFunctionN occluded_filter);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene scene() const { return scene_; }
    uint32_t time_step_count() const { return time_step_count_; }

private:
    void check(const char* doing) const;
    void attach(const SurfaceMotion& surface, uint32_t least_segments, RTCFilterFunctionN occluded_filter);

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    uint32_t time_step_count_ = 1;
};

}  // namespace gnomon::reference
