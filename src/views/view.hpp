// SPDX-License-Identifier: Apache-2.0
// Views: a projection with motion. The camera and the faces of lights become the same thing here.
#pragma once

#include <algorithm>
#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <string>
#include <vector>

#include "math/face.h"
#include "shared/params.h"

namespace gnomon {

/// From world to raster space (comp_shaders/math/cover.h) at one key: raster = rows * (p - origin, 1).
struct ViewKey {
    glm::vec4 row_x, row_y, row_z, row_w;
    glm::vec3 origin;
    bool operator==(const ViewKey&) const = default;
};

struct View {
    uint32_t width = 0;  ///< Texels.
    uint32_t height = 0;
    bool orthographic = false;
    float depth_near = 0.0f;  ///< Surfaces are seen where depth_near < depth < depth_far.
    float depth_far = 0.0f;
    float scale_x = 1.0f;  ///< Raster units per metre (orthographic) or per unit slope (perspective).
    float scale_y = 1.0f;
    uint32_t face = shared::kOnlyFace;  ///< Of its light's faces (comp_shaders/math/face.h).
    float cone = 0.0f;  ///< Spots: squared tangent of the outer half angle; of several faces its cosine, points: less than -1.
    std::vector<ViewKey> keys;

    /// It neither moves nor turns.
    bool still() const {
        return std::all_of(keys.begin(), keys.end(), [&](const ViewKey& key) { return key == keys.front(); });
    }
    /// kPerspectiveView, kOrthographicView or kFaceView.
    uint32_t projection() const {
        if (orthographic) return shared::kOrthographicView;
        return face == shared::kOnlyFace ? shared::kPerspectiveView : shared::kFaceView;
    }
};

/// The camera's view. Its horizontal field is that of the image's aspect.
View camera_view(const Camera& camera, const std::vector<Pose>& poses, uint32_t camera_ix, uint32_t width, uint32_t height);

/// The views that a light's shadows are looked up in; each hit belongs to exactly one. A directional light has one, whose map
/// holds `bounds` at every key; so has a spot, whose map holds the outer cone. A spot of a half angle of 89 degrees or more,
/// which no plane holds, has five, all but that behind it; a point light has six, which do not turn with it.
std::vector<View> light_faces(const Light& light, const std::vector<Pose>& poses, uint32_t light_ix, const Bounds& bounds,
                              uint32_t resolution);

/// Raster units.
struct ViewBox {
    glm::vec2 lower{0.0f};
    glm::vec2 upper{0.0f};
};

/// An orthographic view of so many texels along a side that shows at key k boxes[k] of `view`, and little else: between keys
/// its window moves as the boxes do.
View fitted(const View& view, uint32_t resolution, const std::vector<ViewBox>& boxes);

/// That 32-bit floats hold what is computed of a scene with these bounds in a view. `whose`, as "the camera", and the scene's
/// file are for the message; a scene has to reach `least_metres` far at least. Errors: ErrorKind::input.
void check_reach(const View& view, const Bounds& bounds, const std::string& whose, const std::string& file,
                 double least_metres = 0.0);

/// The least metres along a hit's normal within which nothing occludes it: 2^-23 of the scene's largest coordinate, the
/// rounding of a light's space. At most hits 2^-20 of their own largest coordinate is more, and taken.
float least_tolerance(const Bounds& bounds);

}  // namespace gnomon
