// SPDX-License-Identifier: Apache-2.0
// A scene as gnomon renders it: flat arrays of triangles, and the poses that move them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

/// A bilinear-filtered sRGB image, 4 bytes per texel (R, G, B, A), row 0 at v = 0 (the top row of the file).
struct Image {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
};

/// Texture wrap modes; the values are those of the shaders.
enum class Wrap : uint32_t { repeat = 0, clamp_to_edge = 1, mirrored_repeat = 2 };

/// A diffuse surface. albedo = base_color * texture * vertex colour.
struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};
    int32_t image = -1;  ///< Index into Scene::images, or -1.
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
};

/// `weight` of the palette matrix `matrix` in the pose of one vertex. A rigid vertex has one influence of weight 1.
struct Influence {
    uint32_t matrix = 0;
    float weight = 1.0f;
};

/// One vertex before posing: world = sum_i weight_i * palette[matrix_i] * (position + sum_j morph_weight_j * delta_j).
struct Vertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< Unit length, or zero: then the triangle's own normal is used.
    glm::vec2 uv{0.0f};
    glm::vec4 color{1.0f};
    uint32_t influence_first = 0;
    uint32_t influence_count = 0;
    uint32_t morph = 0;  ///< Index into Scene::morphs. morphs[0] has no targets.
    uint32_t morph_vertex =
        0;  ///< This vertex's number within its morph: delta j is at delta_first + j * vertex_count + morph_vertex.
};

/// Displacements of one primitive instance by its morph targets.
struct Morph {
    uint32_t target_count = 0;
    uint32_t vertex_count = 0;
    uint32_t delta_first = 0;   ///< Into Scene::morph_positions and Scene::morph_normals.
    uint32_t weight_first = 0;  ///< Into Pose::morph_weights.
};

struct Triangle {
    uint32_t vertex[3] = {0, 0, 0};
    uint32_t material = 0;
};

enum class CameraKind : uint32_t { perspective, orthographic };

/// A camera looks along -Z of its node, +Y up.
struct Camera {
    std::string name;
    int32_t node = -1;
    CameraKind kind = CameraKind::perspective;
    double yfov = 0.8;              ///< Radians, perspective.
    double aspect = 0.0;            ///< Width over height, perspective; 0: the image's.
    double xmag = 1.0, ymag = 1.0;  ///< Half sizes in metres, orthographic.
    double znear = 0.01;            ///< Metres along the view axis, > 0.
    double zfar = 0.0;              ///< Metres; 0: infinite.
};

enum class LightKind : uint32_t { directional = 0, spot = 1, point = 2 };

/// A light shines along -Z of its node (KHR_lights_punctual).
struct Light {
    std::string name;
    int32_t node = -1;
    LightKind kind = LightKind::directional;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;   ///< Lux (directional) or candela (spot, point).
    float range = 0.0f;       ///< Metres; 0: unlimited.
    float inner_cone = 0.0f;  ///< Radians from the axis, spot.
    float outer_cone = 0.785398163f;
};

/// Duration in seconds, from the earliest to the latest key frame of its channels.
struct AnimationInfo {
    std::string name;
    double start = 0.0;
    double end = 0.0;
    uint32_t channels = 0;
};

/// The node graph and the animation samplers, in the loader's own form. Defined in src/scene.
struct Rig;

/// Everything that a glTF scene holds, ready to be posed. Indices are checked by the loader: users may trust them.
struct Scene {
    std::filesystem::path path;
    std::vector<Vertex> vertices;
    std::vector<Influence> influences;
    std::vector<Morph> morphs;
    std::vector<glm::vec3> morph_positions;
    std::vector<glm::vec3> morph_normals;
    std::vector<Triangle> triangles;
    std::vector<Material> materials;  ///< Never empty.
    std::vector<Image> images;
    std::vector<Camera> cameras;  ///< In the order of their nodes.
    std::vector<Light> lights;    ///< In the order of their nodes.
    std::vector<AnimationInfo> animations;
    uint32_t skin_count = 0;
    uint32_t node_count = 0;
    uint32_t mesh_count = 0;
    std::vector<std::string> warnings;  ///< What was ignored or repaired, one line each.
    std::shared_ptr<const Rig> rig;
};

/// A rigid motion: p -> rotation * p + translation, world from local.
struct Rigid {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
};

/// The scene at one instant.
struct Pose {
    double seconds = 0.0;
    std::vector<glm::vec4> palette;  ///< Three rows (x, y, z) of each matrix.
    std::vector<float> morph_weights;
    std::vector<Rigid> cameras;  ///< As Scene::cameras.
    std::vector<Rigid> lights;   ///< As Scene::lights.
};

/// Which animations drive the scene.
struct AnimationChoice {
    enum class Kind { none, all, one } kind = Kind::one;
    uint32_t index = 0;  ///< For Kind::one. A scene without animations is still.
};

/// Read a .gltf or .glb. Errors: ErrorKind::input for everything that is wrong with the file or the files that it names.
Scene load_scene(const std::filesystem::path& path);

/// `option`: a name, an index, "all" or "none". Errors: ErrorKind::usage, naming what exists.
AnimationChoice choose_animation(const Scene& scene, const std::string& option);

/// The poses at segments + 1 equally spaced times from open_s to close_s (seconds on the animation clock).
/// Errors: ErrorKind::input where a matrix or weight is not finite.
std::vector<Pose> pose_scene(const Scene& scene, const AnimationChoice& animation, double open_s, double close_s,
                             uint32_t segments);

/// World positions of all vertices in one pose, in float, bit for bit as the pose stage computes them.
std::vector<glm::vec3> posed_positions(const Scene& scene, const Pose& pose);

struct Bounds {
    glm::vec3 lower{0.0f};
    glm::vec3 upper{0.0f};
};

/// Bounds of all vertices that a triangle uses, over all poses. Errors: ErrorKind::input if there is no triangle or a position
/// is not finite.
Bounds bounds_of(const Scene& scene, const std::vector<Pose>& poses);

/// Add a camera that frames `bounds` in an image of this aspect (width / height); it does not move. Says so in a warning.
void add_default_camera(Scene& scene, std::vector<Pose>& poses, const Bounds& bounds, double aspect);

/// Add a directional light from above and beside; it does not move. Says so in a warning.
void add_default_light(Scene& scene, std::vector<Pose>& poses);

/// Add a square of side 2 * half_size metres at height y, centred below `center`, its own material, standing still.
void add_ground(Scene& scene, std::vector<Pose>& poses, glm::vec2 center_xz, float y, float half_size);

}  // namespace gnomon
