// SPDX-License-Identifier: Apache-2.0
// The oracle of visibility: every sample against every triangle, in double, no acceleration. For small scenes.
#pragma once

#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon::oracle {

/// Answers single samples. The rules are those of trace_reference, which this shares no visibility code with.
class BruteForce {
public:
    /// poses: at least two, as from pose_scene.
    BruteForce(const Scene& scene, const std::vector<Pose>& poses, uint32_t camera, uint32_t width, uint32_t height);

    /// (x, y) in pixels, y down; t in the shutter, 0 to 1.
    SampleRecord sample(double x, double y, double t) const;

private:
    struct Ray {
        glm::dvec3 origin, direction;
        double t;  // In the shutter.
    };

    Rigid placement(const std::vector<Rigid> Pose::*list, size_t ix, double t) const;
    glm::dvec3 corner(uint32_t vertex, double t) const;
    double distance_to(uint32_t triangle, const Ray& ray) const;
    glm::dvec3 unit_normal(uint32_t triangle, double t) const;
    Ray camera_ray(double x, double y, double t) const;
    bool lit(size_t light, uint32_t triangle, const glm::dvec3& point, double t) const;

    const Scene& scene_;
    const std::vector<Pose>& poses_;
    std::vector<std::vector<glm::vec3>> keys_;
    uint32_t camera_;
    double width_, height_;
};

/// All samples of a frame: Frame::samples, and the channels A, Z, visibility.<i> and visibility_var.<i>. Of the settings, the
/// size, spp, seed and camera are used. Takes samples * triangles * (1 + lights) steps.
Frame brute_force_trace(const Scene& scene, const std::vector<Pose>& poses, const RenderSettings& settings);

}  // namespace gnomon::oracle
