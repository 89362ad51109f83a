// SPDX-License-Identifier: Apache-2.0
// Nodes of a glTF document, and the cameras and lights that they carry.
#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <gnomon/error.hpp>
#include <numbers>

#include "scene/gltf_build.hpp"

namespace gnomon::gltf {

namespace {

glm::dvec3 vector_of(const std::vector<double>& numbers, glm::dvec3 fallback) {
    return numbers.empty() ? fallback : glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

Rig::Node node_of(const tinygltf::Node& from, std::string name) {
    Rig::Node node;
    node.name = std::move(name);
    node.has_matrix = !from.matrix.empty();
    if (node.has_matrix) node.matrix = glm::make_mat4(from.matrix.data());
    node.transform.translation = vector_of(from.translation, glm::dvec3(0.0));
    node.transform.scale = vector_of(from.scale, glm::dvec3(1.0));
    const std::vector<double>& q = from.rotation;
    if (!q.empty()) node.transform.rotation = glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
    return node;
}

bool is_unit(const std::vector<double>& quaternion) {
    if (quaternion.empty()) return true;
    double length2 = 0.0;
    for (const double x : quaternion) length2 += x * x;
    return std::abs(length2 - 1.0) < 1e-3;  // Quantized rotations are off by less.
}

// All nodes below the given ones, parents first.
std::vector<uint32_t> descendants(const tinygltf::Model& model, std::vector<uint32_t> nodes) {
    for (size_t i = 0; i < nodes.size(); ++i) {
        const std::vector<int>& children = model.nodes[nodes[i]].children;
        for (const int child : children) nodes.push_back(static_cast<uint32_t>(child));
    }
    return nodes;
}

}  // namespace

std::string node_label(const tinygltf::Model& model, size_t number) {
    const std::string& name = model.nodes[number].name;
    return "node " + std::to_string(number) + (name.empty() ? "" : " '" + name + "'");
}

std::vector<bool> build_nodes(const Document& document, Scene& scene, Rig& rig) {
    const tinygltf::Model& model = document.model;
    const auto is_repaired = [](const tinygltf::Node& node) { return !is_unit(node.rotation); };
    if (const auto repaired = std::count_if(model.nodes.begin(), model.nodes.end(), is_repaired); repaired != 0) {
        scene.warnings.push_back(std::to_string(repaired) + " nodes have a rotation that is not a unit quaternion: normalized");
    }
    for (size_t i = 0; i < model.nodes.size(); ++i) rig.nodes.push_back(node_of(model.nodes[i], node_label(model, i)));
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            rig.nodes[static_cast<size_t>(child)].parent = static_cast<int32_t>(i);
        }
    }
    std::vector<uint32_t> roots;
    for (size_t i = 0; i < rig.nodes.size(); ++i) {
        if (rig.nodes[i].parent == Rig::kNoNode) roots.push_back(static_cast<uint32_t>(i));
    }
    rig.order = descendants(model, roots);

    std::vector<uint32_t> scene_roots = roots;
    if (!model.scenes.empty()) {
        const std::vector<int>& chosen = model.scenes[static_cast<size_t>(std::max(model.defaultScene, 0))].nodes;
        scene_roots.assign(chosen.begin(), chosen.end());
        std::sort(scene_roots.begin(), scene_roots.end());
        scene_roots.erase(std::unique(scene_roots.begin(), scene_roots.end()), scene_roots.end());
    }
    std::vector<bool> shown(model.nodes.size(), false);
    for (const uint32_t node : descendants(model, scene_roots)) shown[node] = true;
    return shown;
}

void build_cameras(const Document& document, const std::vector<bool>& shown, Scene& scene, Rig& rig) {
    const tinygltf::Model& model = document.model;
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        if (!shown[n] || model.nodes[n].camera < 0) continue;
        const tinygltf::Camera& from = model.cameras[static_cast<size_t>(model.nodes[n].camera)];
        Camera camera;
        camera.name = model.nodes[n].name.empty() ? from.name : model.nodes[n].name;
        camera.node = static_cast<int32_t>(n);
        if (from.type == "orthographic") {
            const tinygltf::OrthographicCamera& o = from.orthographic;
            camera.kind = CameraKind::orthographic;
            camera.xmag = std::abs(o.xmag);
            camera.ymag = std::abs(o.ymag);
            camera.zfar = o.zfar;
            camera.znear = o.znear;
            if (o.xmag < 0.0 || o.ymag < 0.0) {
                scene.warnings.push_back("the camera of " + node_label(model, n) + " has a negative size: its sign is ignored");
            }
            if (o.znear == 0.0) {
                camera.znear = 1e-6 * o.zfar;
                scene.warnings.push_back("the camera of " + node_label(model, n) + " has znear 0: zfar / 1,000,000 is used");
            }
        } else {
            const tinygltf::PerspectiveCamera& p = from.perspective;
            if (!(p.yfov < std::numbers::pi)) {
                throw Error(ErrorKind::input, "the camera of " + node_label(model, n) + " has an angle of 180 degrees or more",
                            "in " + document.name, "make its yfov less than pi");
            }
            camera.yfov = p.yfov;
            camera.aspect = p.aspectRatio;
            camera.znear = p.znear;
            camera.zfar = p.zfar;
        }
        scene.cameras.push_back(std::move(camera));
        rig.cameras.push_back({static_cast<int32_t>(n), {}});
    }
}

void build_lights(const Document& document, const std::vector<bool>& shown, Scene& scene, Rig& rig) {
    const tinygltf::Model& model = document.model;
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        const auto carried = model.nodes[n].extensions.find("KHR_lights_punctual");
        if (!shown[n] || carried == model.nodes[n].extensions.end()) continue;
        const tinygltf::Light& from = model.lights[static_cast<size_t>(carried->second.Get("light").GetNumberAsInt())];
        Light light;
        light.name = model.nodes[n].name.empty() ? from.name : model.nodes[n].name;
        light.node = static_cast<int32_t>(n);
        if (from.type == "spot") light.kind = LightKind::spot;
        if (from.type == "point") light.kind = LightKind::point;
        light.color = vector_of(from.color, glm::dvec3(1.0));
        light.intensity = static_cast<float>(from.intensity);
        light.range = static_cast<float>(from.range);
        if (light.kind == LightKind::spot) {
            light.inner_cone = static_cast<float>(from.spot.innerConeAngle);
            light.outer_cone = static_cast<float>(from.spot.outerConeAngle);
        }
        scene.lights.push_back(std::move(light));
        rig.lights.push_back({static_cast<int32_t>(n), {}});
    }
}

}  // namespace gnomon::gltf
