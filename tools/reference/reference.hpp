// SPDX-License-Identifier: Apache-2.0
// The reference: gnomon's picture by ray tracing. It shares the scene and the sample generator with gnomon, and no maths of
// visibility.
#pragma once

#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <string>
#include <vector>

namespace gnomon {

struct ReferenceSettings {
    uint32_t width = 1280;  ///< Pixels, 1 to 16384.
    uint32_t height = 720;  ///< Pixels, 1 to 16384.
    uint32_t spp = 16;      ///< Samples per pixel, 1 to 65536.
    uint32_t seed = 0;
    uint32_t camera = 0;           ///< Index into Scene::cameras.
    uint32_t threads = 0;          ///< Up to 1024; 0: as many as the hardware runs. Same picture.
    uint32_t embree_segments = 1;  ///< Embree gets at least this many: fast motion traces faster.
    bool keep_samples = false;     ///< Fill Frame::samples.
    /// true: hit points and the distances of occluders are computed in double, and R G B are shaded.
    /// false: for speed; what Embree finds in float is taken as it is, and the frame has no R G B.
    bool exact = true;
};

/// Trace the scene in these poses (segments + 1 of them, see pose_scene; at most 128 segments).
///
/// Everything is posed at the keys; between two keys world positions and translations are linear and rotations spherical. The
/// horizontal field of view follows from the vertical one and the image's aspect; Camera::aspect and Camera::xmag play no part.
/// What lies outside the camera's [znear, zfar] is not seen, but casts shadows. A hit point is its ray against the plane of its
/// triangle at its time. A hit triangle does not occlude itself; nor does what lies nearer to the hit than 2^-20 of the hit's
/// largest coordinate, measured along the hit triangle's normal; nor what lies behind a spot light.
///
/// Channels: R G B (exact only) A Z, then visibility.<i> and visibility_var.<i> for each light. The latter is the standard
/// error of the former: sqrt(p (1 - p) / max(n - 1, 1)) of n hits. Stages: pose, build (the BVH), primary, shadow, shade (film
/// included); seconds are wall time, that of the last three split by the time that the threads spent in each.
/// Errors: ErrorKind::usage for settings out of range or a camera that is not there; ErrorKind::out_of_memory from Embree,
/// std::bad_alloc from the rest.
Frame trace_reference(const Scene& scene, const std::vector<Pose>& poses, const ReferenceSettings& settings);

}  // namespace gnomon
