// SPDX-License-Identifier: Apache-2.0
// Checks of what nodes carry: meshes with their materials and textures, cameras, lights.
#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "scene/gltf_check.hpp"

namespace gnomon::gltf {

namespace {

using Accessors = std::vector<AccessorInfo>;

void check_texture_info(const Cursor& root, const Cursor& material, std::string_view key) {
    const auto info = material.find(key);
    if (!info) return;
    info->get("index").as_index(root.count("textures"), "textures");
    info->integer_or("texCoord", 0, 0, 31);
    const auto extensions = info->find("extensions");
    if (!extensions) return;
    if (const auto transform = extensions->find("KHR_texture_transform")) {
        if (const auto offset = transform->find("offset")) offset->numbers(2);
        if (const auto scale = transform->find("scale")) scale->numbers(2);
        transform->number_or("rotation", 0.0);
        transform->integer_or("texCoord", 0, 0, 31);
    }
}

void check_material(const Cursor& root, const Cursor& material) {
    if (const auto pbr = material.find("pbrMetallicRoughness")) {
        if (const auto factor = pbr->find("baseColorFactor")) factor->numbers(4);
        check_texture_info(root, *pbr, "baseColorTexture");
        check_texture_info(root, *pbr, "metallicRoughnessTexture");
    }
    if (const auto factor = material.find("emissiveFactor")) factor->numbers(3);
    if (const auto mode = material.find("alphaMode")) mode->string();
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) check_texture_info(root, material, key);
}

void check_textures(const Cursor& root) {
    root.for_each("images", [&](const Cursor& image, size_t) {
        if (const auto uri = image.find("uri")) uri->string();
        image.index("bufferView", root.count("bufferViews"), "buffer views");
    });
    root.for_each("samplers", [](const Cursor& sampler, size_t) {
        for (const char* key : {"wrapS", "wrapT"}) {
            const uint64_t wrap = sampler.integer_or(key, 10497);
            if (wrap != 10497 && wrap != 33071 && wrap != 33648) sampler.fail("unknown wrap mode " + std::to_string(wrap));
        }
    });
    root.for_each("textures", [&](const Cursor& texture, size_t) {
        texture.index("source", root.count("images"), "images");
        texture.index("sampler", root.count("samplers"), "samplers");
    });
    root.for_each("materials", [&](const Cursor& material, size_t) { check_material(root, material); });
}

bool one_of(uint32_t type, std::initializer_list<ComponentType> types) {
    return std::find(types.begin(), types.end(), static_cast<ComponentType>(type)) != types.end();
}

// Whether an attribute may be stored so (glTF 2.0, 3.7.2.1; KHR_mesh_quantization).
bool attribute_fits(std::string_view name, const AccessorInfo& info, bool is_target, bool quantized) {
    const uint32_t type = info.component_type;
    const uint32_t rows = info.rows;
    if (info.columns != 1) return false;
    const bool is_float = type == kFloat;
    const bool is_signed = one_of(type, {kByte, kShort});
    const bool is_unsigned = one_of(type, {kUByte, kUShort});
    if (name == "POSITION") {
        return rows == 3 && (is_float || (quantized && (is_signed || (is_unsigned && !is_target))));
    }
    if (name == "NORMAL") return rows == 3 && (is_float || (quantized && is_signed && (info.normalized || is_target)));
    if (name.starts_with("TEXCOORD_")) {
        return rows == 2 && (is_float || (is_unsigned && info.normalized) || (quantized && (is_signed || is_unsigned)));
    }
    if (name.starts_with("COLOR_")) {
        return (rows == 3 || rows == 4) && (is_float || (is_unsigned && info.normalized));
    }
    if (name.starts_with("JOINTS_")) return rows == 4 && is_unsigned && !info.normalized;
    if (name.starts_with("WEIGHTS_")) return rows == 4 && (is_float || (is_unsigned && info.normalized));
    return true;  // Nothing that gnomon reads.
}

// All attributes of a primitive or target; `count`: how many vertices each must have, found from the first where it is 0.
void check_attributes(const Cursor& attributes, const Accessors& accessors, bool is_target, bool quantized, uint64_t& count) {
    attributes.require_object();
    for (const auto& [name, unused] : attributes.value().items()) {
        const Cursor attribute = attributes.get(name);
        const AccessorInfo& info = accessors[attribute.as_index(accessors.size(), "accessors")];
        if (!attribute_fits(name, info, is_target, quantized)) {
            attribute.fail(
                "this attribute cannot have the type of its accessor",
                quantized ? "export the file again" : "integer positions need KHR_mesh_quantization in extensionsUsed");
        }
        if (count == 0) count = info.count;
        if (info.count != count) {
            attribute.fail("the attribute has " + std::to_string(info.count) + " vertices, others of the primitive have " +
                           std::to_string(count));
        }
    }
    for (uint32_t set = 0;; ++set) {
        const std::string suffix = std::to_string(set);
        const bool joints = attributes.find("JOINTS_" + suffix).has_value();
        const bool weights = attributes.find("WEIGHTS_" + suffix).has_value();
        if (joints != weights) attributes.fail("JOINTS_" + suffix + " and WEIGHTS_" + suffix + " must come together");
        if (!joints) break;
    }
}

void check_primitive(const Cursor& root, const Cursor& primitive, const Accessors& accessors, bool quantized) {
    uint64_t count = 0;
    check_attributes(primitive.get("attributes"), accessors, false, quantized, count);
    primitive.for_each("targets",
                       [&](const Cursor& target, size_t) { check_attributes(target, accessors, true, quantized, count); });
    primitive.integer_or("mode", 4, 0, 6);
    primitive.index("material", root.count("materials"), "materials");
    if (const auto indices = primitive.index("indices", accessors.size(), "accessors")) {
        const AccessorInfo& info = accessors[*indices];
        if (info.columns != 1 || info.rows != 1 || !one_of(info.component_type, {kUByte, kUShort, kUInt})) {
            primitive.fail("indices must be unsigned integer scalars");
        }
    }
}

void check_mesh(const Cursor& root, const Cursor& mesh, size_t number, const Accessors& accessors, bool quantized) {
    if (mesh.count("primitives") == 0) mesh.fail("the mesh has no primitives");
    const auto targets_of = [](const Cursor& primitive) { return primitive.count("targets"); };
    size_t first_count = 0;
    mesh.for_each("primitives", [&](const Cursor& primitive, size_t i) {
        check_primitive(root, primitive, accessors, quantized);
        if (i == 0) first_count = targets_of(primitive);
        if (targets_of(primitive) != first_count) {
            primitive.fail("all primitives of a mesh must have the same number of morph targets");
        }
    });
    if (const auto weights = mesh.find("weights"); weights && weights->numbers().size() != target_count(root, number)) {
        weights->fail("there must be one weight for each of the " + std::to_string(target_count(root, number)) +
                      " morph targets");
    }
}

void check_camera(const Cursor& camera) {
    const std::string& type = camera.get("type").string();
    const auto require = [&](bool holds, const std::string& what) {
        if (!holds) camera.fail(what);
    };
    if (type == "perspective") {
        const Cursor p = camera.get("perspective");
        const double yfov = p.get("yfov").number();
        const double znear = p.get("znear").number();
        require(yfov > 0.0, "yfov must be above 0");
        require(p.number_or("aspectRatio", 1.0) > 0.0, "aspectRatio must be above 0");
        require(znear > 0.0, "znear must be above 0");
        require(p.number_or("zfar", 2.0 * znear) > znear, "zfar must be above znear");
    } else if (type == "orthographic") {
        const Cursor o = camera.get("orthographic");
        const double znear = o.get("znear").number();
        require(o.get("xmag").number() != 0.0 && o.get("ymag").number() != 0.0, "xmag and ymag must not be 0");
        require(znear >= 0.0, "znear must not be below 0");
        require(o.get("zfar").number() > znear, "zfar must be above znear");
    } else {
        camera.fail("unknown camera type '" + type + "'");
    }
}

void check_light(const Cursor& light) {
    const std::string& type = light.get("type").string();
    if (type != "directional" && type != "point" && type != "spot") light.fail("unknown light type '" + type + "'");
    const double intensity = light.number_or("intensity", 1.0);
    if (intensity < 0.0) light.fail("the intensity must not be negative");
    if (const auto color = light.find("color")) {
        for (const double c : color->numbers(3)) {
            if (c < 0.0) color->fail("a colour must not be negative");
            if (c * intensity > double{std::numeric_limits<float>::max()})
                color->fail("the colour times the intensity is larger than a 32-bit float can hold, 3.4e38");
        }
    }
    if (light.number_or("range", 1.0) <= 0.0) light.fail("the range must be above 0", "leave it out for an unlimited range");
    if (type != "spot") return;
    const Cursor spot = light.get("spot");
    const double inner = spot.number_or("innerConeAngle", 0.0);
    const double outer = spot.number_or("outerConeAngle", std::numbers::pi / 4.0);
    // Exporters write pi/2 as a float, which may be above.
    if (!(inner >= 0.0 && inner < outer && outer <= std::numbers::pi / 2.0 + 1e-6)) {
        spot.fail("the cone angles must fulfil 0 <= inner < outer <= pi/2");
    }
}

}  // namespace

void check_content(const Cursor& root, const Accessors& accessors) {
    check_textures(root);
    const bool quantized = uses_extension(root, "KHR_mesh_quantization");
    root.for_each("meshes", [&](const Cursor& mesh, size_t number) { check_mesh(root, mesh, number, accessors, quantized); });
    root.for_each("cameras", [](const Cursor& camera, size_t) { check_camera(camera); });
    if (const auto extensions = root.find("extensions")) {
        if (const auto lights = extensions->find("KHR_lights_punctual")) {
            lights->for_each("lights", [](const Cursor& light, size_t) { check_light(light); });
        }
    }
}

}  // namespace gnomon::gltf
