// SPDX-License-Identifier: Apache-2.0
// The steps from a checked glTF document to a scene and its rig, in the order in which load_scene takes them.
#pragma once

#include <gnomon/scene.hpp>
#include <string>
#include <vector>

#include "scene/gltf_document.hpp"
#include "scene/gltf_material.hpp"
#include "scene/rig.hpp"

namespace gnomon::gltf {

/// The name of node `number` for messages: "node 3 'Hips'".
std::string node_label(const tinygltf::Model& model, size_t number);

/// All nodes, and their order. Returns which of them the scene shows: the default scene, else the first, else all.
std::vector<bool> build_nodes(const Document& document, Scene& scene, Rig& rig);

/// Cameras and lights of the shown nodes, in node order.
void build_cameras(const Document& document, const std::vector<bool>& shown, Scene& scene, Rig& rig);
void build_lights(const Document& document, const std::vector<bool>& shown, Scene& scene, Rig& rig);

/// Vertices, triangles, influences and morphs of all shown meshes, and the palette and morph weights that move them. Reads
/// meshes that are not shown, too, so that a broken file is found out. Errors: ErrorKind::input.
void build_meshes(const Document& document, const std::vector<bool>& shown, const Materials& materials, Scene& scene, Rig& rig);

/// Animations, samplers and channels. Errors: ErrorKind::input where key frames are not in order.
void build_animations(const Document& document, Scene& scene, Rig& rig);

}  // namespace gnomon::gltf
