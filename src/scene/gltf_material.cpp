// SPDX-License-Identifier: Apache-2.0
// Materials of a glTF document.
#include "scene/gltf_material.hpp"

#include <cmath>
#include <map>

#include "scene/gltf_image.hpp"

namespace gnomon::gltf {

namespace {

Wrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirrored_repeat;
    return Wrap::repeat;
}

glm::dvec2 pair_of(const tinygltf::Value& value, glm::dvec2 fallback) {
    if (!value.IsArray()) return fallback;
    return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

UvTransform uv_of(const tinygltf::TextureInfo& info) {
    UvTransform uv;
    uv.set = static_cast<uint32_t>(info.texCoord);
    const auto it = info.extensions.find("KHR_texture_transform");
    if (it == info.extensions.end()) return uv;
    const tinygltf::Value& transform = it->second;
    uv.offset = pair_of(transform.Get("offset"), uv.offset);
    uv.scale = pair_of(transform.Get("scale"), uv.scale);
    if (transform.Has("rotation")) uv.rotation = transform.Get("rotation").GetNumberAsDouble();
    if (transform.Has("texCoord")) uv.set = static_cast<uint32_t>(transform.Get("texCoord").GetNumberAsInt());
    return uv;
}

// Decodes each image once, and remembers which there are in the scene.
class ImageSet {
public:
    ImageSet(const Document& document, std::vector<Image>& images, std::vector<std::string>& warnings)
        : document_(document), images_(images), warnings_(warnings) {}

    // Index into the scene's images of a texture's image, or -1.
    int32_t image_of(const tinygltf::Texture& texture, const std::string& material) {
        if (texture.source < 0) {
            warnings_.push_back("material " + material +
                                ": its texture has no image in PNG or JPEG, its base colour factor is used");
            return -1;
        }
        const auto source = static_cast<size_t>(texture.source);
        const auto known = loaded_.find(source);
        if (known != loaded_.end()) return known->second;
        int32_t index = -1;
        if (std::optional<Image> image = read_image(document_, source, decoded_bytes_, warnings_)) {
            index = static_cast<int32_t>(images_.size());
            images_.push_back(std::move(*image));
        }
        loaded_[source] = index;
        return index;
    }

private:
    const Document& document_;
    std::vector<Image>& images_;
    std::vector<std::string>& warnings_;
    std::map<size_t, int32_t> loaded_;
    uint64_t decoded_bytes_ = 0;
};

void warn_of(const std::string& what, const std::string& names, std::vector<std::string>& warnings) {
    if (!names.empty()) warnings.push_back(what + ": materials" + names);
}

}  // namespace

glm::vec2 UvTransform::operator()(glm::vec2 uv) const {
    const glm::dvec2 scaled = scale * glm::dvec2(uv);
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    return {offset + glm::dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x)};
}

Materials read_materials(const Document& document, std::vector<std::string>& warnings) {
    check_images(document);
    Materials result;
    ImageSet images(document, result.images, warnings);
    const tinygltf::Model& model = document.model;
    std::string masked;
    std::string blended;
    std::string nearest;
    std::string outside;
    for (size_t i = 0; i < model.materials.size(); ++i) {
        const tinygltf::Material& from = model.materials[i];
        const std::string label = std::to_string(i) + (from.name.empty() ? "" : " '" + from.name + "'");
        Material material;
        material.name = from.name;
        const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
        const glm::dvec4 base_color(factor[0], factor[1], factor[2], factor[3]);
        const glm::dvec4 clamped = glm::clamp(base_color, 0.0, 1.0);
        material.base_color = clamped;
        if (clamped != base_color) outside += " " + label;
        const tinygltf::TextureInfo& info = from.pbrMetallicRoughness.baseColorTexture;
        if (info.index >= 0) {
            const tinygltf::Texture& texture = model.textures[static_cast<size_t>(info.index)];
            material.image = images.image_of(texture, label);
            if (texture.sampler >= 0) {
                const tinygltf::Sampler& sampler = model.samplers[static_cast<size_t>(texture.sampler)];
                material.wrap_u = wrap_of(sampler.wrapS);
                material.wrap_v = wrap_of(sampler.wrapT);
                if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) nearest += " " + label;
            }
        }
        if (from.alphaMode == "MASK") masked += " " + label;
        if (from.alphaMode == "BLEND") blended += " " + label;
        result.materials.push_back(std::move(material));
        result.uv.push_back(uv_of(info));
    }
    warn_of("alpha masks are ignored, surfaces are opaque", masked, warnings);
    warn_of("alpha blending is ignored, surfaces are opaque", blended, warnings);
    warn_of("base colour factors outside 0 to 1 are clamped", outside, warnings);
    warn_of("nearest filtering is ignored, textures are filtered bilinearly", nearest, warnings);
    result.materials.push_back({});
    result.materials.back().name = "default";
    result.uv.push_back({});
    return result;
}

}  // namespace gnomon::gltf
