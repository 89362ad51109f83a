// SPDX-License-Identifier: Apache-2.0
// Is the answer of one sample right but for rounding? Every triangle at the sample's time, in double.
#include "oracle/sample_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Along the ray to the plane of the triangle; infinity where the ray is parallel to it.
double plane_distance(const std::array<glm::dvec3, 3>& c, const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double speed = glm::dot(n, direction);
    return speed != 0.0 ? glm::dot(n, c[0] - origin) / speed : kInfinity;
}

// Does the line pass through the triangle? The three volumes have one sign; an edge belongs to both of its triangles.
bool pierces(const std::array<glm::dvec3, 3>& c, const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 a = c[0] - origin, b = c[1] - origin, d = c[2] - origin;
    const double u = glm::dot(direction, glm::cross(b, d)), v = glm::dot(direction, glm::cross(d, a)),
                 w = glm::dot(direction, glm::cross(a, b));
    if (u == 0.0 && v == 0.0 && w == 0.0) return false;  // Without area, or seen from its edge.
    return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

}  // namespace

SampleJudge::SampleJudge(const Scene& scene, const std::vector<Pose>& poses, uint32_t camera, uint32_t width, uint32_t height,
                         const Rounding& rounding)
    : scene_(scene), poses_(poses), camera_(camera), width_(width), height_(height), rounding_(rounding) {
    for (const Pose& pose : poses) keys_.push_back(posed_positions(scene, pose));
    for (const std::vector<glm::vec3>& key : keys_) {
        for (const Triangle& triangle : scene.triangles) {
            for (const uint32_t v : triangle.vertex) {
                const glm::dvec3 p = glm::abs(glm::dvec3(key[v]));
                largest_coordinate_ = std::max({largest_coordinate_, p.x, p.y, p.z});
            }
        }
    }
}

Rigid SampleJudge::placement(const std::vector<Rigid> Pose::*list, size_t ix, double t) const {
    const double keys = t * static_cast<double>(poses_.size() - 1);
    const size_t k = std::min(static_cast<size_t>(keys), poses_.size() - 2);
    const double s = keys - static_cast<double>(k);
    const Rigid& a = (poses_[k].*list)[ix];
    const Rigid& b = (poses_[k + 1].*list)[ix];
    return {glm::mix(a.translation, b.translation, s), glm::slerp(a.rotation, b.rotation, s)};
}

SampleJudge::Corners SampleJudge::corners(uint32_t triangle, double t) const {
    const double keys = t * static_cast<double>(keys_.size() - 1);
    const size_t k = std::min(static_cast<size_t>(keys), keys_.size() - 2);
    const double s = keys - static_cast<double>(k);
    Corners result;
    for (size_t i = 0; i < 3; ++i) {
        const uint32_t v = scene_.triangles[triangle].vertex[i];
        result[i] = glm::mix(glm::dvec3(keys_[k][v]), glm::dvec3(keys_[k + 1][v]), s);
    }
    return result;
}

// The direction is one metre along the view axis: distances along the ray are depths.
SampleJudge::Ray SampleJudge::camera_ray(const SamplePoint& sample) const {
    const Camera& camera = scene_.cameras[camera_];
    const Rigid place = placement(&Pose::cameras, camera_, sample.t);
    const double right = (2.0 * sample.x - width_) / height_, up = (height_ - 2.0 * sample.y) / height_;
    if (camera.kind == CameraKind::orthographic) {
        return {place.translation + place.rotation * glm::dvec3(right * camera.ymag, up * camera.ymag, 0.0),
                place.rotation * glm::dvec3(0.0, 0.0, -1.0)};
    }
    const double half = std::tan(0.5 * camera.yfov);
    return {place.translation, place.rotation * glm::dvec3(right * half, up * half, -1.0)};
}

// Triangles whose bounding spheres come near to the line: nearer than margin + spread * distance from the ray's origin.
std::vector<SampleJudge::Candidate> SampleJudge::near_line(const Ray& ray, double spread, double margin, double t) const {
    const glm::dvec3 axis = glm::normalize(ray.direction);
    std::vector<Candidate> found;
    for (uint32_t i = 0; i < scene_.triangles.size(); ++i) {
        const Corners c = corners(i, t);
        const glm::dvec3 centre = (c[0] + c[1] + c[2]) / 3.0;
        const double radius = std::max({glm::length(c[0] - centre), glm::length(c[1] - centre), glm::length(c[2] - centre)});
        const glm::dvec3 to_centre = centre - ray.origin;
        const double reach = radius + margin + spread * (glm::length(to_centre) + radius);
        if (glm::length(glm::cross(axis, to_centre)) <= reach) found.push_back({i, c});
    }
    return found;
}

bool SampleJudge::coincident(uint32_t a, uint32_t b, const SamplePoint& sample) const {
    const Ray ray = camera_ray(sample);
    const Corners p = corners(a, sample.t), q = corners(b, sample.t);
    if (!pierces(p, ray.origin, ray.direction) || !pierces(q, ray.origin, ray.direction)) return false;
    const double depth = plane_distance(p, ray.origin, ray.direction), other = plane_distance(q, ray.origin, ray.direction);
    return std::abs(depth - other) <= rounding_.depth * std::min(depth, other);
}

SampleJudge::Verdict SampleJudge::primary(uint32_t triangle, const SamplePoint& sample) const {
    const Camera& camera = scene_.cameras[camera_];
    const double far = camera.zfar > 0.0 ? camera.zfar : kInfinity;
    const bool perspective = camera.kind == CameraKind::perspective;
    const double pixel = (perspective ? 2.0 * std::tan(0.5 * camera.yfov) : 2.0 * camera.ymag) / height_;  // At depth 1.
    const std::vector<Candidate> candidates = near_line(camera_ray(sample), perspective ? 2.0 * pixel * rounding_.pixels : 0.0,
                                                        perspective ? 0.0 : 2.0 * pixel * rounding_.pixels, sample.t);
    // `slack`: what lies this much deeper or nearer, or beyond the clip planes by that much, may be what is seen.
    const auto is_nearest = [&](const SamplePoint& at, double slack) {
        const Ray ray = camera_ray(at);
        double nearest = kInfinity, own = kInfinity;
        for (const Candidate& c : candidates) {
            if (!pierces(c.corners, ray.origin, ray.direction)) continue;
            const double depth = plane_distance(c.corners, ray.origin, ray.direction);
            const bool mine = c.triangle == triangle;
            const double widen = mine ? slack : -slack;
            if (depth < camera.znear * (1.0 - widen) || depth > far * (1.0 + widen)) continue;
            nearest = std::min(nearest, depth);
            if (mine) own = depth;
        }
        if (triangle == SampleRecord::kMiss) return nearest == kInfinity;
        return own < kInfinity && own <= nearest * (1.0 + slack);
    };
    if (is_nearest(sample, 0.0)) return Verdict::right;
    if (is_nearest(sample, rounding_.depth)) return Verdict::tie;
    constexpr int kSteps = 4;
    for (int i = -kSteps; i <= kSteps; ++i) {
        for (int j = -kSteps; j <= kSteps; ++j) {
            const double step = rounding_.pixels / kSteps;
            if (is_nearest({sample.x + i * step, sample.y + j * step, sample.t}, rounding_.depth)) return Verdict::border;
        }
    }
    return Verdict::wrong;
}

glm::dvec3 SampleJudge::normal(uint32_t triangle, double t) const {
    const Corners c = corners(triangle, t);
    return glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
}

glm::dvec3 SampleJudge::hit_point(uint32_t triangle, const SamplePoint& sample) const {
    const Ray ray = camera_ray(sample);
    return ray.origin + plane_distance(corners(triangle, sample.t), ray.origin, ray.direction) * ray.direction;
}

glm::dvec3 SampleJudge::toward_light(uint32_t light, const glm::dvec3& point, double t) const {
    const Rigid place = placement(&Pose::lights, light, t);
    if (scene_.lights[light].kind != LightKind::directional) return place.translation - point;
    return place.rotation * glm::dvec3(0.0, 0.0, 1.0);
}

bool SampleJudge::light_reaches(const glm::dvec3& point, const std::vector<Candidate>& occluders, uint32_t triangle,
                                const glm::dvec3& normal, uint32_t light_ix, double tolerance, double t) const {
    const Light& light = scene_.lights[light_ix];
    const glm::dvec3 to_light = toward_light(light_ix, point, t);
    const double end = light.kind == LightKind::directional ? kInfinity : 1.0;
    if (light.kind == LightKind::spot) {
        const glm::dvec3 axis = placement(&Pose::lights, light_ix, t).rotation * glm::dvec3(0.0, 0.0, 1.0);
        const double angle = std::atan2(glm::length(glm::cross(axis, to_light)), glm::dot(axis, to_light));
        if (angle > double{light.outer_cone}) return true;
    }
    for (const Candidate& c : occluders) {
        if (c.triangle == triangle || !pierces(c.corners, point, to_light)) continue;
        const double distance = plane_distance(c.corners, point, to_light);
        if (distance > 0.0 && distance < end && distance * std::abs(glm::dot(normal, to_light)) >= tolerance) return false;
    }
    return true;
}

SampleJudge::Verdict SampleJudge::shadow(uint32_t triangle, uint32_t light, bool lit, const SamplePoint& sample) const {
    const glm::dvec3 point = hit_point(triangle, sample), n = normal(triangle, sample.t);
    const double step = rounding_.scene * largest_coordinate_;
    const glm::dvec3 far_end = point + toward_light(light, point, sample.t);
    const std::vector<Candidate> occluders = near_line({point, far_end - point}, 0.0, 4.0 * step, sample.t);
    const double at_hit = std::ldexp(std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}), -20);
    const double at_least = std::max(at_hit, std::ldexp(largest_coordinate_, -23));
    if (light_reaches(point, occluders, triangle, n, light, at_hit, sample.t) == lit) return Verdict::right;
    if (light_reaches(point, occluders, triangle, n, light, at_least, sample.t) == lit) return Verdict::tolerance;
    if (!lit && !light_reaches(point, occluders, triangle, n, light, 0.0, sample.t)) return Verdict::closer;
    for (const double tolerance : {at_hit, at_least}) {
        for (int i = 0; i < 125; ++i) {
            const glm::dvec3 shift(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
            if (light_reaches(point + 0.5 * step * shift, occluders, triangle, n, light, tolerance, sample.t) == lit)
                return Verdict::border;
        }
    }
    return Verdict::wrong;
}

}  // namespace gnomon::oracle
