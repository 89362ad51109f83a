// SPDX-License-Identifier: Apache-2.0
// The oracle of visibility: every sample against every triangle, in double, no acceleration.
#include "brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/sample.h"

namespace gnomon::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double largest_coordinate(const glm::dvec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

Channel& add_channel(Frame& frame, const std::string& name) {
    return frame.channels.emplace_back(Channel{name, std::vector<float>(static_cast<size_t>(frame.width) * frame.height)});
}

}  // namespace

BruteForce::BruteForce(const Scene& scene, const std::vector<Pose>& poses, uint32_t camera, uint32_t width, uint32_t height)
    : scene_(scene), poses_(poses), camera_(camera), width_(width), height_(height) {
    for (const Pose& pose : poses) keys_.push_back(posed_positions(scene, pose));
}

Rigid BruteForce::placement(const std::vector<Rigid> Pose::*list, size_t ix, double t) const {
    const size_t segments = poses_.size() - 1;
    const size_t k = std::min(static_cast<size_t>(t * static_cast<double>(segments)), segments - 1);
    const double s = t * static_cast<double>(segments) - static_cast<double>(k);
    const Rigid& a = (poses_[k].*list)[ix];
    const Rigid& b = (poses_[k + 1].*list)[ix];
    return {glm::mix(a.translation, b.translation, s), glm::slerp(a.rotation, b.rotation, s)};
}

glm::dvec3 BruteForce::corner(uint32_t vertex, double t) const {
    const size_t segments = keys_.size() - 1;
    const size_t k = std::min(static_cast<size_t>(t * static_cast<double>(segments)), segments - 1);
    const double s = t * static_cast<double>(segments) - static_cast<double>(k);
    return glm::mix(glm::dvec3(keys_[k][vertex]), glm::dvec3(keys_[k + 1][vertex]), s);
}

// Moller and Trumbore 1997. Infinity where the ray misses; either facing counts; edges belong to the triangle.
double BruteForce::distance_to(uint32_t triangle, const Ray& ray) const {
    const uint32_t* vertex = scene_.triangles[triangle].vertex;
    const glm::dvec3 a = corner(vertex[0], ray.t);
    const glm::dvec3 to_b = corner(vertex[1], ray.t) - a, to_c = corner(vertex[2], ray.t) - a;
    const glm::dvec3 p = glm::cross(ray.direction, to_c);
    const double determinant = glm::dot(to_b, p);
    if (determinant == 0.0) return kInfinity;
    const glm::dvec3 from_a = ray.origin - a;
    const double u = glm::dot(from_a, p) / determinant;
    const glm::dvec3 q = glm::cross(from_a, to_b);
    const double v = glm::dot(ray.direction, q) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 ? glm::dot(to_c, q) / determinant : kInfinity;
}

glm::dvec3 BruteForce::unit_normal(uint32_t triangle, double t) const {
    const uint32_t* vertex = scene_.triangles[triangle].vertex;
    const glm::dvec3 a = corner(vertex[0], t);
    return glm::normalize(glm::cross(corner(vertex[1], t) - a, corner(vertex[2], t) - a));
}

BruteForce::Ray BruteForce::camera_ray(double x, double y, double t) const {
    const Camera& camera = scene_.cameras[camera_];
    const Rigid place = placement(&Pose::cameras, camera_, t);
    const double right = (2.0 * x - width_) / height_, up = (height_ - 2.0 * y) / height_;  // In half heights of the image.
    if (camera.kind == CameraKind::orthographic) {
        const glm::dvec3 start(right * camera.ymag, up * camera.ymag, 0.0);
        return {place.translation + place.rotation * start, place.rotation * glm::dvec3(0.0, 0.0, -1.0), t};
    }
    const double half_height = std::tan(camera.yfov / 2.0);
    return {place.translation, place.rotation * glm::dvec3(right * half_height, up * half_height, -1.0), t};
}

bool BruteForce::lit(size_t light_ix, uint32_t triangle, const glm::dvec3& point, double t) const {
    const Light& light = scene_.lights[light_ix];
    const Rigid place = placement(&Pose::lights, light_ix, t);
    const glm::dvec3 shines = place.rotation * glm::dvec3(0.0, 0.0, -1.0);
    Ray ray{point, -shines, t};
    double end = kInfinity;
    if (light.kind != LightKind::directional) {
        const glm::dvec3 from_light = point - place.translation;
        // The angle from the axis by its tangent, which is accurate at every angle.
        const double angle = std::atan2(glm::length(glm::cross(shines, from_light)), glm::dot(shines, from_light));
        if (light.kind == LightKind::spot && angle > double{light.outer_cone}) return true;
        ray.direction = glm::normalize(-from_light);
        end = glm::length(from_light);
    }
    const double least = std::ldexp(largest_coordinate(point), -20);
    const double climb = std::abs(glm::dot(ray.direction, unit_normal(triangle, t)));
    for (uint32_t other = 0; other < scene_.triangles.size(); ++other) {
        if (other == triangle) continue;
        const double distance = distance_to(other, ray);
        if (distance > 0.0 && distance < end && distance * climb >= least) return false;
    }
    return true;
}

SampleRecord BruteForce::sample(double x, double y, double t) const {
    const Camera& camera = scene_.cameras[camera_];
    const Ray ray = camera_ray(x, y, t);
    const double far = camera.zfar > 0.0 ? camera.zfar : kInfinity;
    SampleRecord record;
    double nearest = kInfinity;
    for (uint32_t triangle = 0; triangle < scene_.triangles.size(); ++triangle) {
        const double distance = distance_to(triangle, ray);
        if (distance < camera.znear || distance > far || distance >= nearest) continue;
        nearest = distance;
        record.triangle = triangle;
    }
    if (record.triangle == SampleRecord::kMiss) return record;
    record.depth = static_cast<float>(nearest);
    const glm::dvec3 point = ray.origin + nearest * ray.direction;
    for (size_t light = 0; light < scene_.lights.size(); ++light) {
        if (lit(light, record.triangle, point, t)) record.lit |= 1u << light;
    }
    return record;
}

Frame brute_force_trace(const Scene& scene, const std::vector<Pose>& poses, const RenderSettings& settings) {
    const BruteForce tracer(scene, poses, settings.camera, settings.width, settings.height);
    Frame frame;
    frame.width = settings.width;
    frame.height = settings.height;
    frame.light_count = static_cast<uint32_t>(scene.lights.size());
    for (uint32_t y = 0; y < settings.height; ++y) {
        for (uint32_t x = 0; x < settings.width; ++x) {
            const uint32_t hash = shared::pixel_hash(x, y, settings.seed);
            for (uint32_t s = 0; s < settings.spp; ++s) {
                const glm::vec3 p = shared::sample_point(hash, x, y, s, shared::stratum_length(settings.spp));
                frame.samples.push_back(tracer.sample(p.x, p.y, p.z));
            }
        }
    }

    const auto hits_of = [&](size_t pixel, auto&& of) {
        double sum = 0.0;
        for (size_t i = pixel * settings.spp; i < (pixel + 1) * settings.spp; ++i) {
            if (frame.samples[i].triangle != SampleRecord::kMiss) sum += of(frame.samples[i]);
        }
        return sum;
    };
    const auto fill = [&](const std::string& name, auto&& value) {
        Channel& channel = add_channel(frame, name);
        for (size_t pixel = 0; pixel < channel.values.size(); ++pixel) {
            const double hits = hits_of(pixel, [](const SampleRecord&) { return 1.0; });
            channel.values[pixel] = hits > 0.0 ? static_cast<float>(value(pixel, hits)) : 0.0f;
        }
    };
    fill("A", [&](size_t, double hits) { return hits / settings.spp; });
    fill("Z", [&](size_t pixel, double hits) {
        return hits_of(pixel, [](const SampleRecord& r) { return double{r.depth}; }) / hits;
    });
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        const auto mean = [&, light](size_t pixel, double hits) {
            return hits_of(pixel, [light](const SampleRecord& r) { return double(r.lit >> light & 1u); }) / hits;
        };
        fill("visibility." + std::to_string(light), mean);
        fill("visibility_var." + std::to_string(light), [&](size_t pixel, double hits) {
            const double p = mean(pixel, hits);
            return std::sqrt(p * (1.0 - p) / std::max(hits - 1.0, 1.0));
        });
    }
    return frame;
}

}  // namespace gnomon::oracle
