// SPDX-License-Identifier: Apache-2.0
// `gnomon info`: what is in a scene.
#include <spdlog/fmt/fmt.h>

#include <gnomon/error.hpp>
#include <gnomon/scene.hpp>
#include <memory>
#include <numeric>

#include "command.hpp"

namespace gnomon::cli {

namespace {

using io::Json;

constexpr double kDegrees = 57.29577951308232;

Json vector_json(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Json camera_json(const Camera& camera) {
    Json json = {{"name", camera.name}, {"node", camera.node}};
    if (camera.kind == CameraKind::perspective) {
        json["kind"] = "perspective";
        json["yfov_degrees"] = camera.yfov * kDegrees;
    } else {
        json["kind"] = "orthographic";
        json["width"] = 2.0 * camera.xmag;
        json["height"] = 2.0 * camera.ymag;
    }
    return json;
}

Json light_json(const Light& light) {
    Json json = {{"name", light.name}, {"node", light.node}};
    switch (light.kind) {
        case LightKind::directional:
            json["kind"] = "directional";
            break;
        case LightKind::spot:
            json["kind"] = "spot";
            json["inner_cone_degrees"] = light.inner_cone * kDegrees;
            json["outer_cone_degrees"] = light.outer_cone * kDegrees;
            break;
        case LightKind::point:
            json["kind"] = "point";
            break;
    }
    json["intensity"] = light.intensity;
    json["unit"] = light.kind == LightKind::directional ? "lx" : "cd";
    json["color"] = vector_json(light.color);
    json["range"] = light.range > 0.0f ? Json(light.range) : Json(nullptr);
    return json;
}

/// The document "gnomon.info". Lengths are in metres, times in seconds; warnings name what would be ignored.
Json scene_json(const Scene& scene) {
    Json json = io::document("info");
    json["scene"] = scene.path.string();
    json["triangles"] = scene.triangles.size();
    json["vertices"] = scene.vertices.size();
    json["nodes"] = scene.node_count;
    json["meshes"] = scene.mesh_count;
    json["materials"] = scene.materials.size();
    json["skins"] = scene.skin_count;
    json["morph_targets"] = std::accumulate(scene.morphs.begin(), scene.morphs.end(), uint64_t{0},
                                            [](uint64_t sum, const Morph& morph) { return sum + morph.target_count; });
    std::vector<std::string> warnings = scene.warnings;
    json["bounds"] = nullptr;
    try {
        const Bounds bounds = bounds_of(scene, pose_scene(scene, AnimationChoice{}, 0.0, 0.0, 1));
        json["bounds"] = {{"lower", vector_json(bounds.lower)}, {"upper", vector_json(bounds.upper)}};
    } catch (const Error& error) {  // Such a scene can be described, if not rendered.
        warnings.push_back(std::string("no bounds at 0 s: ") + error.what());
    }
    json["images"] = Json::array();
    for (const Image& image : scene.images)
        json["images"].push_back({{"name", image.name}, {"width", image.width}, {"height", image.height}});
    json["animations"] = Json::array();
    for (const AnimationInfo& animation : scene.animations)
        json["animations"].push_back({{"name", animation.name},
                                      {"start", animation.start},
                                      {"end", animation.end},
                                      {"duration", animation.end - animation.start},
                                      {"channels", animation.channels}});
    json["cameras"] = Json::array();
    for (const Camera& camera : scene.cameras) json["cameras"].push_back(camera_json(camera));
    json["lights"] = Json::array();
    for (const Light& light : scene.lights) json["lights"].push_back(light_json(light));
    json["warnings"] = warnings;
    return json;
}

std::string vector_text(const Json& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

/// A line for each member of the list, or "none".
template <class Text>
void print_list(const std::string& label, const Json& list, Text text) {
    if (list.empty()) print_row(label, "none");
    for (size_t i = 0; i < list.size(); ++i)
        print_row(i == 0 ? label : "", fmt::format("{} '{}' {}", i, list[i]["name"].get<std::string>(), text(list[i])));
}

void print_scene(const Json& json) {
    print_row("scene", json["scene"].get<std::string>());
    for (const char* name : {"triangles", "vertices", "nodes", "meshes", "materials", "skins"})
        print_row(name, json[name].dump());
    print_row("morph targets", json["morph_targets"].dump());
    const Json& bounds = json["bounds"];
    print_row("bounds at 0 s",
              bounds.is_null() ? "none" : vector_text(bounds["lower"]) + " to " + vector_text(bounds["upper"]) + " m");
    print_list("images", json["images"],
               [](const Json& image) { return fmt::format("{}x{}", image["width"].dump(), image["height"].dump()); });
    print_list("animations", json["animations"], [](const Json& animation) {
        return fmt::format("{:.6g} s, from {:.6g} to {:.6g} s, {} channels", animation["duration"].get<double>(),
                           animation["start"].get<double>(), animation["end"].get<double>(), animation["channels"].dump());
    });
    print_list("cameras", json["cameras"], [](const Json& camera) {
        return camera["kind"] == "perspective"
                   ? fmt::format("perspective, {:.6g} degrees high", camera["yfov_degrees"].get<double>())
                   : fmt::format("orthographic, {:.6g} x {:.6g} m", camera["width"].get<double>(),
                                 camera["height"].get<double>());
    });
    print_list("lights", json["lights"], [](const Json& light) {
        std::string text = fmt::format("{}, {:.6g} {}", light["kind"].get<std::string>(), light["intensity"].get<double>(),
                                       light["unit"].get<std::string>());
        if (light["kind"] == "spot")
            text += fmt::format(", {:.6g} degrees from the axis", light["outer_cone_degrees"].get<double>());
        return text;
    });
    if (json["warnings"].empty()) print_row("ignored", "nothing");
    for (size_t i = 0; i < json["warnings"].size(); ++i)
        print_row(i == 0 ? "warnings" : "", json["warnings"][i].get<std::string>());
}

}  // namespace

void add_info(CLI::App& app, Invocation& invocation) {
    struct Options {
        std::string scene;
        std::string json;
    };
    CLI::App* command = add_command(app, invocation, "info", "Say what is in a scene, and what of it would be ignored");
    auto options = std::make_shared<Options>();
    command->add_option("SCENE", options->scene, "Scene, .gltf or .glb")->required()->type_name("");
    command->add_option("--json", options->json, "Write it as JSON; - for stdout, instead of the text")->type_name("FILE.json");
    command->callback([&invocation, options] {
        invocation.run = [options] {
            const Json json = scene_json(load_scene(options->scene));
            if (!options->json.empty()) write_json(options->json, json);
            if (options->json != "-") print_scene(json);
            return static_cast<int>(kDone);
        };
    });
}

}  // namespace gnomon::cli
