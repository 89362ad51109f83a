// SPDX-License-Identifier: Apache-2.0
// Checks of the document as a whole, and of what refers to nodes: the graph, scenes, skins, animations.
#include "scene/gltf_check.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::gltf {

namespace {

using Accessors = std::vector<AccessorInfo>;

void check_asset(const Cursor& root) {
    const Cursor asset = root.get("asset");
    const std::string& version = asset.get("version").string();
    if (!version.starts_with("2.")) asset.fail("glTF version '" + version + "' is not supported", "convert it to glTF 2.0");
    if (const auto least = asset.find("minVersion"); least && least->string() != "2.0") {
        least->fail("the file needs glTF " + least->string() + ", gnomon reads 2.0", "export it as glTF 2.0");
    }
}

void check_transform(const Cursor& node) {
    if (const auto matrix = node.find("matrix")) matrix->numbers(16);
    if (const auto translation = node.find("translation")) translation->numbers(3);
    if (const auto scale = node.find("scale")) scale->numbers(3);
    if (const auto rotation = node.find("rotation")) {
        double length2 = 0.0;
        for (const double x : rotation->numbers(4)) length2 += x * x;
        if (!(length2 > 0.0) || !std::isfinite(length2)) rotation->fail("the rotation is not a quaternion of length 1");
    }
}

void check_node(const Cursor& root, const Cursor& node) {
    check_transform(node);
    node.index("camera", root.count("cameras"), "cameras");
    node.index("skin", root.count("skins"), "skins");
    const std::optional<size_t> mesh = node.index("mesh", root.count("meshes"), "meshes");
    if (const auto weights = node.find("weights"); weights && mesh) {
        if (weights->numbers().size() != target_count(root, *mesh)) {
            weights->fail("the node's mesh has " + std::to_string(target_count(root, *mesh)) + " morph targets");
        }
    }
    const auto extensions = node.find("extensions");
    if (!extensions) return;
    if (const auto carried = extensions->find("KHR_lights_punctual")) {
        const auto of_root = root.find("extensions");
        const auto lights = of_root ? of_root->find("KHR_lights_punctual") : std::nullopt;
        carried->get("light").as_index(lights ? lights->count("lights") : 0, "lights");
    }
}

// The parent of each node, -1 for roots. Checks that the nodes are a forest.
std::vector<int64_t> check_graph(const Cursor& root) {
    const size_t count = root.count("nodes");
    std::vector<int64_t> parent(count, -1);
    root.for_each("nodes", [&](const Cursor& node, size_t n) {
        node.for_each("children", [&](const Cursor& child, size_t) {
            const size_t c = child.as_index(count, "nodes");
            if (parent[c] != -1) child.fail("node " + std::to_string(c) + " has two parents", "instance it as two nodes");
            parent[c] = static_cast<int64_t>(n);
        });
    });
    // Walk up from every node; a walk that meets its own mark is a cycle.
    std::vector<size_t> walk(count, 0);
    for (size_t n = 0; n < count; ++n) {
        int64_t at = static_cast<int64_t>(n);
        while (at != -1 && walk[static_cast<size_t>(at)] == 0) {
            walk[static_cast<size_t>(at)] = n + 1;
            at = parent[static_cast<size_t>(at)];
        }
        if (at != -1 && walk[static_cast<size_t>(at)] == n + 1) {
            root.fail("node " + std::to_string(at) + " is its own ancestor");
        }
    }
    return parent;
}

void check_nodes(const Cursor& root) {
    root.for_each("nodes", [&](const Cursor& node, size_t) { check_node(root, node); });
    const std::vector<int64_t> parent = check_graph(root);
    root.for_each("scenes", [&](const Cursor& scene, size_t) {
        scene.for_each("nodes", [&](const Cursor& node, size_t) {
            const size_t n = node.as_index(parent.size(), "nodes");
            if (parent[n] != -1) node.fail("node " + std::to_string(n) + " is not a root", "name the root of its tree");
        });
    });
    root.index("scene", root.count("scenes"), "scenes");
}

void check_skin(const Cursor& root, const Cursor& skin, const Accessors& accessors) {
    const size_t nodes = root.count("nodes");
    skin.get("joints");
    skin.for_each("joints", [&](const Cursor& joint, size_t) { joint.as_index(nodes, "nodes"); });
    skin.index("skeleton", nodes, "nodes");
    if (const auto index = skin.index("inverseBindMatrices", accessors.size(), "accessors")) {
        const AccessorInfo& info = accessors[*index];
        if (info.columns != 4 || info.component_type != kFloat) skin.fail("inverseBindMatrices must be 4 x 4 float matrices");
        if (info.count < skin.count("joints")) {
            skin.fail("there are " + std::to_string(info.count) + " inverse bind matrices for " +
                      std::to_string(skin.count("joints")) + " joints");
        }
    }
}

struct SamplerInfo {
    AccessorInfo output;
    uint64_t groups = 0;  // Values that the output must have for each of the things animated.
};

SamplerInfo check_sampler(const Cursor& sampler, const Accessors& accessors) {
    const AccessorInfo& input = accessors[sampler.get("input").as_index(accessors.size(), "accessors")];
    if (input.columns != 1 || input.rows != 1 || input.component_type != kFloat) {
        sampler.fail("the input of an animation sampler must be float scalars");
    }
    const auto interpolation = sampler.find("interpolation");
    const std::string name = interpolation ? interpolation->string() : "LINEAR";
    const bool cubic = name == "CUBICSPLINE";
    if (!cubic && name != "LINEAR" && name != "STEP") interpolation->fail("unknown interpolation '" + name + "'");
    if (cubic && input.count < 2) sampler.fail("a cubic spline needs two key frames at least");
    return {accessors[sampler.get("output").as_index(accessors.size(), "accessors")], input.count * (cubic ? 3 : 1)};
}

void check_channel(const Cursor& root, const Cursor& channel, const std::vector<SamplerInfo>& samplers) {
    const SamplerInfo& sampler = samplers[channel.get("sampler").as_index(samplers.size(), "samplers of this animation")];
    const Cursor target = channel.get("target");
    const std::string& path = target.get("path").string();
    const std::optional<size_t> node = target.index("node", root.count("nodes"), "nodes");
    if (!node) return;
    const nlohmann::json& animated = root.value()["nodes"][*node];
    uint64_t things = 1;
    uint32_t rows = 1;
    if (path == "weights") {
        if (!animated.contains("mesh")) target.fail("node " + std::to_string(*node) + " has no mesh, so no morph weights");
        things = target_count(root, animated["mesh"].get<size_t>());
        if (things == 0) target.fail("the mesh of node " + std::to_string(*node) + " has no morph targets");
    } else if (path == "translation" || path == "scale" || path == "rotation") {
        rows = path == "rotation" ? 4 : 3;
        if (animated.contains("matrix")) {
            target.fail("node " + std::to_string(*node) + " has a matrix, so its " + path + " cannot be animated",
                        "export it with translation, rotation and scale");
        }
    } else {
        return;  // Of an extension: the loader ignores it and says so.
    }
    const AccessorInfo& output = sampler.output;
    if (output.columns != 1 || output.rows != rows) channel.fail("the sampler's output does not fit the path '" + path + "'");
    if (output.component_type != kFloat && !output.normalized) {
        channel.fail("the sampler's output must be float or normalized integers");
    }
    if (output.count != sampler.groups * things) {
        channel.fail("the sampler's output has " + std::to_string(output.count) + " values, " +
                     std::to_string(sampler.groups * things) + " are needed");
    }
}

void check_animations(const Cursor& root, const Accessors& accessors) {
    root.for_each("animations", [&](const Cursor& animation, size_t) {
        std::vector<SamplerInfo> samplers;
        animation.for_each("samplers",
                           [&](const Cursor& sampler, size_t) { samplers.push_back(check_sampler(sampler, accessors)); });
        animation.for_each("channels", [&](const Cursor& channel, size_t) { check_channel(root, channel, samplers); });
    });
}

void check_collections(const Cursor& root) {
    for (const char* key : {"accessors", "animations", "bufferViews", "buffers", "cameras", "images", "materials", "meshes",
                            "nodes", "samplers", "scenes", "skins", "textures"}) {
        root.for_each(key, [](const Cursor& item, size_t) {
            item.require_object();
            if (const auto name = item.find("name")) name->string();
            if (const auto extensions = item.find("extensions")) extensions->require_object();
        });
    }
    if (const auto extensions = root.find("extensions")) {
        extensions->require_object();
        for (const auto& [name, value] : extensions->value().items()) extensions->get(name).require_object();
    }
}

}  // namespace

size_t target_count(const Cursor& root, size_t mesh) {
    const nlohmann::json& primitives = root.value()["meshes"][mesh]["primitives"];
    const auto targets = primitives[0].find("targets");
    return targets == primitives[0].end() ? 0 : targets->size();
}

void check_document(const Cursor& root) {
    root.require_object();
    check_asset(root);
    check_extensions(root);
    check_collections(root);
    const Accessors accessors = check_data(root);
    check_content(root, accessors);
    check_nodes(root);
    root.for_each("skins", [&](const Cursor& skin, size_t) { check_skin(root, skin, accessors); });
    check_animations(root, accessors);
}

}  // namespace gnomon::gltf
