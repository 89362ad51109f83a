// SPDX-License-Identifier: Apache-2.0
// Materials of a glTF document: the base colour of each, and how its texture coordinates are made.
#pragma once

#include <gnomon/scene.hpp>
#include <string>
#include <vector>

#include "scene/gltf_document.hpp"

namespace gnomon::gltf {

/// Which TEXCOORD set a texture reads, and KHR_texture_transform.
struct UvTransform {
    uint32_t set = 0;
    glm::dvec2 offset{0.0};
    glm::dvec2 scale{1.0};
    double rotation = 0.0;  ///< Radians.

    glm::vec2 operator()(glm::vec2 uv) const;
};

struct Materials {
    std::vector<Material> materials;  ///< As in the document, then the default material.
    std::vector<UvTransform> uv;      ///< One for each material.
    std::vector<Image> images;
};

/// Errors: ErrorKind::input for images that are missing or broken.
Materials read_materials(const Document& document, std::vector<std::string>& warnings);

}  // namespace gnomon::gltf
