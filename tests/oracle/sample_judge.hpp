// SPDX-License-Identifier: Apache-2.0
// Is the answer of one sample right but for rounding? Every triangle at the sample's time, in double.
#pragma once

#include <array>
#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon::oracle {

/// How far from the exact answer one in float may be.
struct Rounding {
    double pixels =
        0x1p-9;  ///< The sample in the image. Vertices far outside the image are rounded more coarsely than those inside.
    double depth = 0x1p-17;  ///< Share of the depth within which two surfaces are equally deep.
    double scene = 0x1p-18;  ///< The hit in space: share of the scene's largest coordinate.
};

/// A sample: (x, y) in pixels, y down; t in the shutter.
struct SamplePoint {
    double x = 0.0, y = 0.0, t = 0.0;
};

class SampleJudge {
public:
    enum class Verdict {
        right,      ///< What the exact test says.
        tie,        ///< Primary: another triangle of the same depth covers the sample (coincident surfaces).
        tolerance,  ///< Shadow: right with gnomon's least tolerance near the hit, not with the hit's own.
        closer,     ///< Shadow: dark, by what lies between hit and light but nearer to the hit than the tolerance.
        border,     ///< Right for a sample or a hit within Rounding.
        wrong,
    };

    /// The scene and its poses must outlive the judge.
    SampleJudge(const Scene& scene, const std::vector<Pose>& poses, uint32_t camera, uint32_t width, uint32_t height,
                const Rounding& rounding = {});

    /// Do both triangles cover the sample, and are they equally deep there within Rounding::depth?
    bool coincident(uint32_t a, uint32_t b, const SamplePoint& sample) const;

    /// Is `triangle` (or SampleRecord::kMiss) the nearest at the sample?
    Verdict primary(uint32_t triangle, const SamplePoint& sample) const;

    /// Does the light reach the sample's hit on `triangle`? An occluder nearer to the hit, along its normal, than 2^-20 of the
    /// hit's largest coordinate does not count, one farther than that and than 2^-23 of the scene's does; in between the
    /// verdict is `tolerance`; dark by a nearer one it is `closer`: where a mesh is known to be closed no tolerance is needed.
    Verdict shadow(uint32_t triangle, uint32_t light, bool lit, const SamplePoint& sample) const;

    /// Metres, of all poses.
    double largest_coordinate() const { return largest_coordinate_; }

    /// Unit normal of a triangle's winding.
    glm::dvec3 normal(uint32_t triangle, double t) const;

    /// From any hit toward a directional or spot light.
    glm::dvec3 toward_light(uint32_t light, const glm::dvec3& point, double t) const;

    /// The sample's hit on the plane of `triangle`.
    glm::dvec3 hit_point(uint32_t triangle, const SamplePoint& sample) const;

private:
    using Corners = std::array<glm::dvec3, 3>;
    struct Ray {
        glm::dvec3 origin, direction;
    };
    struct Candidate {
        uint32_t triangle;
        Corners corners;
    };

    Rigid placement(const std::vector<Rigid> Pose::*list, size_t ix, double t) const;
    Corners corners(uint32_t triangle, double t) const;
    Ray camera_ray(const SamplePoint& sample) const;
    std::vector<Candidate> near_line(const Ray& ray, double spread, double margin, double t) const;
    bool light_reaches(const glm::dvec3& point, const std::vector<Candidate>& occluders, uint32_t triangle,
                       const glm::dvec3& normal, uint32_t light, double tolerance, double t) const;

    const Scene& scene_;
    const std::vector<Pose>& poses_;
    std::vector<std::vector<glm::vec3>> keys_;
    uint32_t camera_;
    double width_, height_;
    Rounding rounding_;
    double largest_coordinate_ = 0.0;
};

}  // namespace gnomon::oracle
