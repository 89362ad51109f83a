// SPDX-License-Identifier: Apache-2.0
// Loading a scene: the order of the steps.
#include <gnomon/error.hpp>
#include <gnomon/scene.hpp>
#include <new>

#include "scene/gltf_build.hpp"

namespace gnomon {

namespace {

Scene load(const std::filesystem::path& path) {
    Scene scene;
    scene.path = path;
    const auto rig = std::make_shared<Rig>();
    const gltf::Document document = gltf::read_document(path, scene.warnings);
    gltf::Materials materials = gltf::read_materials(document, scene.warnings);
    const std::vector<bool> shown = gltf::build_nodes(document, scene, *rig);
    gltf::build_meshes(document, shown, materials, scene, *rig);
    gltf::build_cameras(document, shown, scene, *rig);
    gltf::build_lights(document, shown, scene, *rig);
    gltf::build_animations(document, scene, *rig);
    scene.materials = std::move(materials.materials);
    scene.images = std::move(materials.images);
    scene.skin_count = static_cast<uint32_t>(document.model.skins.size());
    scene.node_count = static_cast<uint32_t>(document.model.nodes.size());
    scene.mesh_count = static_cast<uint32_t>(document.model.meshes.size());
    scene.rig = rig;
    return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path) {
    try {
        return load(path);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::out_of_memory, "there is not enough memory to load the scene", "in " + path.string(),
                    "use a smaller scene");
    } catch (const std::filesystem::filesystem_error& e) {
        throw Error(ErrorKind::input, "the scene's folder cannot be read (" + e.code().message() + ")", "in " + path.string(),
                    "check the path and its permissions");
    }
}

}  // namespace gnomon
