// SPDX-License-Identifier: Apache-2.0
// A small valid scene for others to be made of.
#pragma once

#include "unit/scene/gltf_builder.hpp"

namespace gnomon::test {

/// A skinned, morphed, animated, textured mesh with a camera and a light: something of everything.
inline json rich_document(Gltf& gltf) {
    gltf.doc["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform"};
    gltf.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
    gltf.doc["nodes"] = {{{"children", {1, 2}}, {"scale", {1, 2, 1}}},
                         {{"translation", {0, 1, 0}}, {"camera", 0}},
                         {{"rotation", {0, 0, 0, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    gltf.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    const json target = {{"POSITION", gltf.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1})}};
    gltf.add_mesh_node({{"attributes",
                         {{"POSITION", gltf.accessor<float>("VEC3", Gltf::kTriangle)},
                          {"NORMAL", gltf.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1})},
                          {"TEXCOORD_0", gltf.accessor<uint16_t>("VEC2", {0, 0, 65535, 0, 0, 65535}, true)},
                          {"COLOR_0", gltf.accessor<uint8_t>("VEC4", std::vector<uint8_t>(12, 255), true)},
                          {"JOINTS_0", gltf.accessor<uint8_t>("VEC4", {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0})},
                          {"WEIGHTS_0", gltf.accessor<float>("VEC4", std::vector<float>(12, 0.25f))}}},
                        {"indices", gltf.accessor<uint16_t>("SCALAR", {0, 1, 2, 2, 1, 0})},
                        {"targets", {target, target}},
                        {"material", 0}});
    gltf.doc["nodes"][3]["skin"] = 0;
    std::vector<float> matrices(32, 0.0f);
    for (size_t i = 0; i < 32; i += 16) matrices[i] = matrices[i + 5] = matrices[i + 10] = matrices[i + 15] = 1.0f;
    gltf.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", gltf.accessor<float>("MAT4", matrices)}});
    gltf.add("materials",
             {{"pbrMetallicRoughness",
               {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}}}}}});
    gltf.add("textures", {{"source", 0}, {"sampler", 0}});
    gltf.add("samplers", {{"wrapS", 33071}});
    gltf.add("images", {{"uri", "data:image/webp;base64,UklGRgAA"}});  // No PNG or JPEG: a warning.
    const int sparse_indices = gltf.view<uint8_t>({1});
    const int sparse_values = gltf.view<float>({5, 5, 5});
    gltf.doc["accessors"][0]["sparse"] = {{"count", 1},
                                          {"indices", {{"bufferView", sparse_indices}, {"componentType", 5121}}},
                                          {"values", {{"bufferView", sparse_values}}}};
    const int times = gltf.accessor<float>("SCALAR", {0, 1});
    const int rotations = gltf.accessor<int16_t>("VEC4", {0, 0, 0, 32767, 0, 32767, 0, 0}, true);
    const int weights = gltf.accessor<float>("SCALAR", std::vector<float>(12, 0.5f));
    gltf.add("animations", {{"samplers",
                             {{{"input", times}, {"output", rotations}},
                              {{"input", times}, {"output", weights}, {"interpolation", "CUBICSPLINE"}}}},
                            {"channels",
                             {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
                              {{"sampler", 1}, {"target", {{"node", 3}, {"path", "weights"}}}}}}});
    gltf.doc["scenes"] = {{{"nodes", {0, 3}}}};
    gltf.doc["scene"] = 0;
    gltf.write();
    return gltf.doc;
}

}  // namespace gnomon::test
