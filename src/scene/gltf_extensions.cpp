// SPDX-License-Identifier: Apache-2.0
// Which glTF extensions gnomon reads, which it ignores and says so, and which it cannot do without.
#include <array>
#include <set>
#include <span>
#include <string>

#include "scene/gltf_check.hpp"
#include "scene/gltf_document.hpp"

namespace gnomon::gltf {

namespace {

constexpr std::array<std::string_view, 3> kRead = {"KHR_lights_punctual", "KHR_mesh_quantization", "KHR_texture_transform"};

struct Ignored {
    std::string_view name;
    std::string_view consequence;
};

// What leaving them out means; other materials' extensions leave only the base colour.
constexpr std::array<Ignored, 10> kIgnored = {{
    {"KHR_materials_unlit", "its surfaces are lit like all others"},
    {"KHR_materials_pbrSpecularGlossiness", "the material's own base colour is used"},
    {"KHR_materials_variants", "the default materials are used"},
    {"EXT_mesh_gpu_instancing", "its instances are left out, each mesh is there once"},
    {"EXT_texture_webp", "its textures are left out where there is no PNG or JPEG in their place"},
    {"KHR_texture_basisu", "its textures are left out where there is no PNG or JPEG in their place"},
    {"KHR_draco_mesh_compression", "the uncompressed copy is used"},
    {"EXT_meshopt_compression", "the uncompressed copy is used"},
    {"KHR_animation_pointer", "what it animates stands still"},
    {"KHR_node_visibility", "all nodes are visible"},
}};

bool is_material(std::string_view name) { return name.starts_with("KHR_materials_"); }

bool is_read(std::string_view name) { return std::find(kRead.begin(), kRead.end(), name) != kRead.end(); }

}  // namespace

bool uses_extension(const Cursor& root, std::string_view name) {
    bool found = false;
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        root.for_each(list, [&](const Cursor& entry, size_t) { found = found || entry.string() == name; });
    }
    return found;
}

void check_extensions(const Cursor& root) {
    root.for_each("extensionsUsed", [](const Cursor& entry, size_t) { entry.string(); });
    root.for_each("extensionsRequired", [](const Cursor& entry, size_t) {
        const std::string& name = entry.string();
        if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression") {
            entry.fail("the scene's geometry is compressed (" + name + "), which is not supported",
                       "decompress it first, for example with: npx @gltf-transform/cli copy IN.glb OUT.glb");
        }
        if (!is_read(name) && !is_material(name)) {
            entry.fail("the scene requires the extension " + name + ", which is not supported",
                       "export it without the extension");
        }
    });
}

void warn_of_extensions(const Cursor& root, std::vector<std::string>& warnings) {
    std::set<std::string> seen;
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        root.for_each(list, [&](const Cursor& entry, size_t) {
            const std::string& name = entry.string();
            if (is_read(name) || !seen.insert(name).second) return;
            const auto known =
                std::find_if(kIgnored.begin(), kIgnored.end(), [&](const Ignored& ignored) { return ignored.name == name; });
            std::string consequence = "it is unknown";
            if (is_material(name)) consequence = "only the base colour of materials is used";
            if (known != kIgnored.end()) consequence = known->consequence;
            warnings.push_back("extension " + name + " is ignored: " + consequence);
        });
    }
}

}  // namespace gnomon::gltf
