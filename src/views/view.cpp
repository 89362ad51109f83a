// SPDX-License-Identifier: Apache-2.0
#include "views/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <gnomon/error.hpp>
#include <limits>

namespace gnomon {
namespace {

struct Axes {
    glm::dvec3 right, up, back;
};

Axes axes_of(const Rigid& frame) {
    glm::dmat3 m = glm::mat3_cast(glm::normalize(frame.rotation));
    return {m[0], m[1], m[2]};
}

// Rows in double for p - origin in double, rounded; the rounding of the origin goes into the constant terms.
ViewKey make_key(const glm::dvec3& origin, const glm::dmat4x3& rows, const glm::dvec4& constants) {
    ViewKey key;
    key.origin = glm::vec3(origin);
    glm::dvec3 rest = glm::dvec3(key.origin) - origin;
    glm::vec4* out[4] = {&key.row_x, &key.row_y, &key.row_z, &key.row_w};
    for (int i = 0; i < 4; ++i) *out[i] = glm::vec4(glm::dvec4(rows[i], glm::dot(rows[i], rest) + constants[i]));
    return key;
}

ViewKey perspective_key(const glm::dvec3& origin, const Axes& a, double scale_x, double scale_y) {
    return make_key(origin, glm::dmat4x3(scale_x * a.right, -scale_y * a.up, glm::dvec3(0.0), -a.back),
                    glm::dvec4(0.0, 0.0, -1.0, 0.0));
}

ViewKey orthographic_key(const Rigid& frame, const glm::dvec3& origin, double scale_x, double scale_y, double x, double y) {
    Axes a = axes_of(frame);
    return make_key(origin, glm::dmat4x3(scale_x * a.right, -scale_y * a.up, -a.back, glm::dvec3(0.0)),
                    glm::dvec4(x, y, 0.0, 1.0));
}

View directional_view(const std::vector<Pose>& poses, uint32_t light_ix, const Bounds& bounds, uint32_t resolution) {
    glm::dvec3 lower(bounds.lower), upper(bounds.upper);
    glm::dvec3 centre = 0.5 * (lower + upper);
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
    for (const Pose& pose : poses) {
        Axes a = axes_of(pose.lights[light_ix]);
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 p(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y, corner & 4 ? upper.z : lower.z);
            glm::dvec2 q(glm::dot(p - centre, a.right), -glm::dot(p - centre, a.up));
            low = glm::min(low, q);
            high = glm::max(high, q);
        }
    }
    View view;
    view.width = view.height = resolution;
    view.orthographic = true;
    view.depth_near = -shared::kFarthest;
    view.depth_far = shared::kFarthest;
    // A little wider than the bounds, whose corners are rounded; never empty, for a flat scene seen from its side.
    glm::dvec2 half = 0.5 * (high - low) * (1.0 + 1e-5) + 1e-6 * (glm::length(upper - lower) + 1e-30);
    glm::dvec2 scale = 0.5 * resolution / half;
    glm::dvec2 offset = -0.5 * (low + high) * scale;
    view.scale_x = static_cast<float>(scale.x);
    view.scale_y = static_cast<float>(scale.y);
    for (const Pose& pose : poses) {
        view.keys.push_back(orthographic_key(pose.lights[light_ix], centre, scale.x, scale.y, offset.x, offset.y));
    }
    return view;
}

View spot_view(const Light& light, const std::vector<Pose>& poses, uint32_t light_ix, const Bounds& bounds,
               uint32_t resolution) {
    double slope = std::tan(static_cast<double>(light.outer_cone));
    double scale = 0.5 * resolution / slope * (1.0 - 1e-5);
    View view;
    view.width = view.height = resolution;
    view.depth_near = -1.0f / least_tolerance(bounds);
    view.depth_far = 0.0f;
    view.scale_x = view.scale_y = static_cast<float>(scale);
    view.cone = static_cast<float>(slope * slope);
    for (const Pose& pose : poses)
        view.keys.push_back(perspective_key(pose.lights[light_ix].translation, axes_of(pose.lights[light_ix]), scale, scale));
    return view;
}

// Of a light's axes. All are right-handed: triangles have the same orientation in each.
Axes face_axes(const Axes& light, uint32_t face) {
    const glm::dvec3 axes[3] = {light.right, light.up, light.back};
    const uint32_t axis = face / 2;
    const glm::dvec3 &next = axes[(axis + 1) % 3], &last = axes[(axis + 2) % 3];
    return face % 2 == 0 ? Axes{last, next, -axes[axis]} : Axes{next, last, axes[axis]};
}

View face_view(const Light& light, const std::vector<Pose>& poses, uint32_t light_ix, const Bounds& bounds, uint32_t resolution,
               uint32_t face) {
    const bool spot = light.kind == LightKind::spot;
    const double scale = 0.5 * resolution * (1.0 - 1e-5);
    View view;
    view.width = view.height = resolution;
    view.depth_near = -1.0f / least_tolerance(bounds);
    view.depth_far = 0.0f;
    view.scale_x = view.scale_y = static_cast<float>(scale);
    view.face = face;
    view.cone = spot ? static_cast<float>(std::cos(static_cast<double>(light.outer_cone))) : -2.0f;
    const Axes world{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (const Pose& pose : poses) {
        const Rigid& frame = pose.lights[light_ix];
        const Axes axes = face_axes(spot ? axes_of(frame) : world, face);
        view.keys.push_back(perspective_key(frame.translation, axes, scale, scale));
    }
    return view;
}

}  // namespace

View camera_view(const Camera& camera, const std::vector<Pose>& poses, uint32_t camera_ix, uint32_t width, uint32_t height) {
    View view;
    view.width = width;
    view.height = height;
    view.orthographic = camera.kind == CameraKind::orthographic;
    double scale = view.orthographic ? 0.5 * height / camera.ymag : 0.5 * height / std::tan(0.5 * camera.yfov);
    view.scale_x = view.scale_y = static_cast<float>(scale);
    if (view.orthographic) {
        view.depth_near = static_cast<float>(camera.znear);
        view.depth_far = camera.zfar > 0.0 ? static_cast<float>(camera.zfar) : shared::kFarthest;
    } else {
        view.depth_near = static_cast<float>(-1.0 / camera.znear);
        view.depth_far = camera.zfar > 0.0 ? static_cast<float>(-1.0 / camera.zfar) : 0.0f;
    }
    for (const Pose& pose : poses) {
        const Rigid& frame = pose.cameras[camera_ix];
        view.keys.push_back(view.orthographic ? orthographic_key(frame, frame.translation, scale, scale, 0.0, 0.0)
                                              : perspective_key(frame.translation, axes_of(frame), scale, scale));
    }
    return view;
}

std::vector<View> light_faces(const Light& light, const std::vector<Pose>& poses, uint32_t light_ix, const Bounds& bounds,
                              uint32_t resolution) {
    constexpr double kWidest = 1.5533430342749532;  // 89 degrees
    constexpr uint32_t kBehind = 4;                 // A light shines along -z.
    if (light.kind == LightKind::directional) return {directional_view(poses, light_ix, bounds, resolution)};
    const bool spot = light.kind == LightKind::spot;
    if (spot && light.outer_cone < kWidest) return {spot_view(light, poses, light_ix, bounds, resolution)};
    std::vector<View> faces;
    for (uint32_t face = 0; face < shared::kFaceCount; ++face) {
        if (spot && face == kBehind) continue;
        faces.push_back(face_view(light, poses, light_ix, bounds, resolution, face));
    }
    return faces;
}

View fitted(const View& view, uint32_t resolution, const std::vector<ViewBox>& boxes) {
    // Texels on either side, beyond which no rounding reaches.
    const float border = std::min(2.0f, 0.25f * static_cast<float>(resolution));
    constexpr float kNarrowest = 1.0f / 64;    // Of the sides' ratio,
    constexpr float kSmallest = 1.0f / 65536;  // and of the view.
    glm::vec2 size(kSmallest * static_cast<float>(std::max(view.width, view.height)));
    for (const ViewBox& box : boxes) size = glm::max(size, box.upper - box.lower);
    size = glm::max(size, kNarrowest * std::max(size.x, size.y));
    const glm::vec2 times = (static_cast<float>(resolution) - 2.0f * border) / size;
    View fit = view;
    fit.width = fit.height = resolution;
    fit.scale_x *= times.x;
    fit.scale_y *= times.y;
    for (size_t k = 0; k < boxes.size(); ++k) {
        const glm::vec2 middle = 0.5f * (boxes[k].lower + boxes[k].upper);
        ViewKey& key = fit.keys[k];
        key.row_x.w -= middle.x;
        key.row_y.w -= middle.y;
        key.row_x *= times.x;
        key.row_y *= times.y;
    }
    return fit;
}

void check_reach(const View& view, const Bounds& bounds, const std::string& whose, const std::string& file,
                 double least_metres) {
    // Of determinants: three raster coordinates, two of them times the scale. Those of small triangles are less.
    constexpr double kLeast = 1e-33, kMost = 1e37;
    double metres = 0.0;
    for (const ViewKey& key : view.keys) {
        const glm::dvec3 origin(key.origin);
        metres = std::max(metres, glm::length(glm::max(glm::abs(glm::dvec3(bounds.lower) - origin),
                                                       glm::abs(glm::dvec3(bounds.upper) - origin))));
    }
    const double raster = metres * static_cast<double>(std::max(view.scale_x, view.scale_y));
    const double determinant = raster * raster * metres;
    const bool is_far = determinant > kMost;
    if (!is_far && (metres == 0.0 || (determinant >= kLeast && metres >= least_metres))) return;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", metres);
    throw Error(ErrorKind::input,
                std::string("the scene reaches ") + text.data() + " m far from " + whose + ", " + (is_far ? "more" : "less") +
                    " than 32-bit floats can render at this size",
                file, is_far ? "scale it down, to metres" : "scale it up, to metres");
}

float least_tolerance(const Bounds& bounds) {
    glm::vec3 largest = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    return std::ldexp(std::max({largest.x, largest.y, largest.z, 1e-30f}), -23);
}

}  // namespace gnomon
