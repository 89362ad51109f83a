// SPDX-License-Identifier: Apache-2.0
// Moving triangles as one Embree geometry, with its BVH.
#include "embree_scene.hpp"

#include <algorithm>
#include <gnomon/error.hpp>
#include <string>

namespace gnomon::reference {
namespace {

void check(RTCDevice device, const char* doing) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) {
        throw Error(ErrorKind::out_of_memory, "Embree ran out of memory", doing, "use fewer segments or a smaller scene");
    }
    throw Error(ErrorKind::internal, "Embree error " + std::to_string(error), doing, "report this as a bug");
}

bool stands_still(const SurfaceMotion& surface) {
    for (uint32_t k = 1; k <= surface.segment_count(); ++k) {
        if (surface.key(k) != surface.key(0)) return false;
    }
    return true;
}

}  // namespace

RTCDevice new_embree(uint32_t threads, bool wide) {
    std::string configuration = "threads=" + std::to_string(threads);
    if (wide) configuration += ",frequency_level=simd512,hugepages=1";
    const RTCDevice device = rtcNewDevice(configuration.c_str());
    check(device, "starting it");
    return device;
}

EmbreeScene::EmbreeScene(const SurfaceMotion& surface, const BuildSettings& settings) : device_(settings.device) {
    if (device_ != nullptr) {
        rtcRetainDevice(device_);
    } else {
        device_ = new_embree(settings.threads, false);
    }
    scene_ = rtcNewScene(device_);
    if (settings.robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, settings.quality);
    try {
        if (!surface.triangles().empty()) attach(surface, settings);
        rtcCommitScene(scene_);
        check("building the BVH");
    } catch (...) {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
        throw;
    }
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void EmbreeScene::check(const char* doing) const { reference::check(device_, doing); }

void EmbreeScene::attach(const SurfaceMotion& surface, const BuildSettings& settings) {
    // Embree's boxes are linear between its time steps; over a longer way they are wider than the triangles in them.
    const uint32_t parts = (settings.least_segments + surface.segment_count() - 1) / surface.segment_count();
    time_step_count_ = stands_still(surface) ? 1 : surface.segment_count() * parts + 1;
    if (time_step_count_ > RTC_MAX_TIME_STEP_COUNT) {
        throw Error(ErrorKind::usage,
                    "Embree takes at most " + std::to_string(RTC_MAX_TIME_STEP_COUNT - 1) + " segments of motion",
                    "not " + std::to_string(time_step_count_ - 1), "use fewer time steps or Embree segments");
    }
    const size_t vertex_count = surface.key(0).size() - 1;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(geometry, time_step_count_);
    for (uint32_t step = 0; step < time_step_count_; ++step) {
        const uint32_t k = step / parts;
        if (step % parts == 0) {
            rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, surface.key(k).data(), 0,
                                       sizeof(glm::vec3), vertex_count);
            continue;
        }
        auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step,
                                                                          RTC_FORMAT_FLOAT3, sizeof(glm::vec3), vertex_count));
        check("allocating vertices");
        const double s = static_cast<double>(step % parts) / parts;
        std::transform(
            surface.key(k).begin(), surface.key(k).end() - 1, surface.key(k + 1).begin(), positions,
            [s](glm::vec3 a, glm::vec3 b) { return glm::vec3(glm::dvec3(a) + s * (glm::dvec3(b) - glm::dvec3(a))); });
    }
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, surface.triangles().data(),
                               offsetof(Triangle, vertex), sizeof(Triangle), surface.triangles().size());
    rtcSetGeometryBuildQuality(geometry, settings.quality);
    if (settings.occluded_filter) rtcSetGeometryOccludedFilterFunction(geometry, settings.occluded_filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    check("attaching the triangles");
}

}  // namespace gnomon::reference
