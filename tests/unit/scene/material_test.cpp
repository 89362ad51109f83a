// SPDX-License-Identifier: Apache-2.0
// Materials, textures, texture coordinates, vertex colours, extensions.
#include <numbers>

#include "gltf_builder.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

// A PNG of 2 x 1 texels, red and half transparent blue: signature, IHDR, IDAT with a stored block, IEND; checksums are not
// checked by the decoder but right all the same.
const std::vector<uint8_t> kPng = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02,
    0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0xf4, 0x22, 0x7f, 0x8a, 0x00, 0x00, 0x00, 0x14, 0x49, 0x44, 0x41,
    0x54, 0x78, 0x01, 0x01, 0x09, 0x00, 0xf6, 0xff, 0x00, 0xff, 0x00, 0x00, 0xff, 0x00, 0x00, 0xff, 0x80, 0x0f, 0x7a, 0x03,
    0x7e, 0x4a, 0x6e, 0x70, 0x0c, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

// A triangle with two sets of texture coordinates, and a material with the texture.
Gltf& with_texture(Gltf& gltf) {
    gltf.add_mesh_node({{"attributes",
                         {{"POSITION", gltf.accessor<float>("VEC3", Gltf::kTriangle)},
                          {"TEXCOORD_0", gltf.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1})},
                          {"TEXCOORD_1", gltf.accessor<uint8_t>("VEC2", {255, 0, 0, 255, 51, 255}, true)}}},
                        {"material", 0}});
    gltf.add("images", {{"bufferView", gltf.view<uint8_t>(kPng)}, {"mimeType", "image/png"}, {"name", "wood"}});
    gltf.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
    gltf.add("textures", {{"source", 0}, {"sampler", 0}});
    gltf.add("materials",
             {{"name", "Floor"},
              {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}}});
    return gltf;
}

json& texture_info(Gltf& gltf) { return gltf.doc["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]; }

TEST(Material, BaseColourAndTexture) {
    Gltf gltf;
    const Scene scene = with_texture(gltf).load();
    const Material& material = scene.materials[scene.triangles[0].material];
    EXPECT_EQ(material.name, "Floor");
    EXPECT_EQ(material.base_color, glm::vec4(0.5, 0.25, 1, 1));
    EXPECT_EQ(material.wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(material.wrap_v, Wrap::mirrored_repeat);
    ASSERT_EQ(material.image, 0);
    const Image& image = scene.images[0];
    EXPECT_EQ(image.name, "wood");
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    EXPECT_THAT(image.rgba, testing::ElementsAre(255, 0, 0, 255, 0, 0, 255, 128));
    EXPECT_EQ(scene.vertices[1].uv, glm::vec2(1, 0));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(Material, PrimitivesWithoutMaterialAreWhite) {
    Gltf gltf;
    gltf.add_triangle();
    const Scene scene = gltf.load();
    const Material& material = scene.materials[scene.triangles[0].material];
    EXPECT_EQ(material.base_color, glm::vec4(1));
    EXPECT_EQ(material.image, -1);
}

TEST(Material, SecondSetOfTextureCoordinates) {
    Gltf gltf;
    with_texture(gltf);
    texture_info(gltf)["texCoord"] = 1;
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.vertices[0].uv, glm::vec2(1, 0));
    EXPECT_FLOAT_EQ(scene.vertices[2].uv.x, 0.2f);
    texture_info(gltf)["texCoord"] = 2;
    EXPECT_THAT(gltf.load().warnings, has_warning("1 textured primitives lack"));
}

TEST(Material, TextureTransform) {
    Gltf gltf;
    with_texture(gltf).doc["extensionsRequired"] = {"KHR_texture_transform"};
    texture_info(gltf)["extensions"]["KHR_texture_transform"] = {
        {"offset", {10, 20}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}};
    const Scene scene = gltf.load();
    // Scaled, then turned counter-clockwise in a picture whose v points down: (u, v) to (v, -u), then shifted.
    EXPECT_THAT(scene.vertices[0].uv, IsNear(glm::vec2(10, 20), 1e-5f));
    EXPECT_THAT(scene.vertices[1].uv, IsNear(glm::vec2(10, 18), 1e-5f));
    EXPECT_THAT(scene.vertices[2].uv, IsNear(glm::vec2(13, 20), 1e-5f));
    texture_info(gltf)["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
    EXPECT_EQ(gltf.load().vertices[0].uv, glm::vec2(1, 0));
}

TEST(Material, VertexColours) {
    const auto color_of = [](const std::string& type, const auto& values, bool normalized) {
        Gltf gltf;
        gltf.add_mesh_node({{"attributes",
                             {{"POSITION", gltf.accessor<float>("VEC3", Gltf::kTriangle)},
                              {"COLOR_0", gltf.accessor(type, values, normalized)}}}});
        const Scene scene = gltf.load();
        return std::pair(scene.vertices[2].color, scene.warnings);
    };
    EXPECT_EQ(color_of("VEC3", std::vector<float>{0, 0, 0, 0, 0, 0, 0.5, 0.25, 1}, false).first, glm::vec4(0.5, 0.25, 1, 1));
    EXPECT_EQ(color_of("VEC4", std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 51, 0}, true).first,
              glm::vec4(1, 0, 51.0f / 255.0f, 0));
    EXPECT_EQ(color_of("VEC4", std::vector<uint16_t>{0, 0, 0, 0, 0, 0, 0, 0, 65535, 0, 0, 0}, true).first,
              glm::vec4(1, 0, 0, 0));
    const auto [color, warnings] = color_of("VEC3", std::vector<float>{0, 0, 0, 0, 0, 0, 2, -1, 0.5}, false);
    EXPECT_EQ(color, glm::vec4(1, 0, 0.5, 1));
    EXPECT_THAT(warnings, has_warning("1 vertex colours are outside 0 to 1"));
}

TEST(Material, AlphaModesAndFiltersAreNamed) {
    Gltf gltf;
    with_texture(gltf).doc["materials"][0]["alphaMode"] = "BLEND";
    gltf.doc["samplers"][0]["magFilter"] = 9728;
    gltf.add("materials", {{"alphaMode", "MASK"}});
    const std::vector<std::string> warnings = gltf.load().warnings;
    EXPECT_THAT(warnings, has_warning("alpha blending is ignored, surfaces are opaque: materials 0 'Floor'"));
    EXPECT_THAT(warnings, has_warning("alpha masks are ignored, surfaces are opaque: materials 1"));
    EXPECT_THAT(warnings, has_warning("nearest filtering is ignored"));
}

TEST(Material, ImagesThatCannotBeDecoded) {
    Gltf gltf;
    with_texture(gltf);
    gltf.doc["images"][0] = {{"uri", "wood.webp"}};
    EXPECT_THAT(gltf.error(), HasSubstr("'wood.webp' cannot be found"));
    gltf.folder.write("wood.webp", "RIFF....WEBP");
    const Scene scene = gltf.load();
    EXPECT_THAT(scene.warnings, has_warning("image 0 is neither PNG nor JPEG"));
    EXPECT_EQ(scene.materials[0].image, -1);
}

TEST(Material, TexturesOfOtherFormatsHaveNoSource) {
    Gltf gltf;
    with_texture(gltf).doc["extensionsUsed"] = {"EXT_texture_webp"};
    gltf.doc["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    const Scene scene = gltf.load();
    EXPECT_THAT(scene.warnings, has_warning("material 0 'Floor': its texture has no image in PNG or JPEG"));
    EXPECT_EQ(scene.materials[0].image, -1);
    gltf.doc["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_THAT(gltf.error(), HasSubstr("EXT_texture_webp"));
}

TEST(Material, BrokenImagesAreErrors) {
    for (const size_t kept : {20u, 45u, 58u}) {
        Gltf gltf;
        with_texture(gltf).doc["images"][0] = {{"uri", "wood.png"}};
        gltf.folder.write("wood.png", std::string(kPng.begin(), kPng.begin() + static_cast<std::ptrdiff_t>(kept)));
        EXPECT_THAT(gltf.error(), HasSubstr("cannot be decoded")) << kept;
    }
}

TEST(Material, HugeImagesAreErrors) {
    std::vector<uint8_t> png = kPng;
    png[18] = 0x40;  // 16384 + 2 texels wide.
    Gltf gltf;
    with_texture(gltf).doc["images"][0] = {{"uri", "wood.png"}};
    gltf.folder.write("wood.png", std::string(png.begin(), png.end()));
    EXPECT_THAT(gltf.error(), HasSubstr("cannot be decoded"));
}

// A few hundred bytes would be decoded to grey texels that take gigabytes.
TEST(Material, HeadersOfImagesThatPromiseTooMuchAreErrors) {
    std::vector<uint8_t> jpeg = {0xff, 0xd8, 0xff, 0xc0, 0, 11, 8, 0x20, 0, 0x20, 0, 1, 1, 0x11, 0};  // 8192 x 8192, grey.
    jpeg.resize(722);
    std::vector<uint8_t> png = kPng;
    png[18] = png[22] = 0x20;
    Gltf gltf;
    with_texture(gltf).doc["images"][0] = {{"uri", "wood.png"}};
    for (const std::vector<uint8_t>& file : {jpeg, png}) {
        gltf.folder.write("wood.png", std::string(file.begin(), file.end()));
        EXPECT_THAT(gltf.error(), HasSubstr("more than the file can hold"));
    }
}

// Also where the table is in a segment that is said to end before it.
TEST(Material, HuffmanTablesOfMoreThan256CodesAreErrors) {
    for (const uint8_t segment_bytes : {uint8_t{19}, uint8_t{3}}) {
        std::vector<uint8_t> jpeg = {0xff, 0xd8, 0xff, 0xe0, 0, 4, 0xff, 0xc4, 0xff, 0xc4, 0, segment_bytes, 0};
        jpeg.resize(jpeg.size() + 16, 17);
        jpeg.resize(800);
        Gltf gltf;
        with_texture(gltf).doc["images"][0] = {{"uri", "wood.png"}};
        gltf.folder.write("wood.png", std::string(jpeg.begin(), jpeg.end()));
        EXPECT_THAT(gltf.error(), HasSubstr("a Huffman table has more than 256 codes"));
    }
}

TEST(Material, ColoursOutsideZeroToOneAreClampedWithAWarning) {
    Gltf gltf;
    with_texture(gltf).doc["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {-1, 3e38, 0.5, 1};
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(0, 1, 0.5, 1));
    EXPECT_THAT(scene.warnings, has_warning("base colour factors outside 0 to 1 are clamped: materials 0 'Floor'"));
    gltf.doc["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][1] = 1e39;
    EXPECT_THAT(gltf.error(), HasSubstr("larger than a 32-bit float can hold"));
    EXPECT_THAT(gltf.error(), HasSubstr("/materials/0/pbrMetallicRoughness/baseColorFactor/1"));
}

TEST(Material, IndicesOutOfRangeAreErrors) {
    Gltf gltf;
    with_texture(gltf).doc["textures"][0]["source"] = 1;
    EXPECT_THAT(gltf.error(), HasSubstr("/textures/0/source"));
    gltf.doc["textures"][0] = {{"source", 0}, {"sampler", 1}};
    EXPECT_THAT(gltf.error(), HasSubstr("/textures/0/sampler"));
    gltf.doc["textures"][0] = {{"source", 0}};
    texture_info(gltf)["index"] = 1;
    EXPECT_THAT(gltf.error(), HasSubstr("/materials/0/pbrMetallicRoughness/baseColorTexture/index"));
}

TEST(Extensions, RequiredAndUsed) {
    const auto load_with = [](const std::string& list, const std::string& name) {
        Gltf gltf;
        gltf.add_triangle();
        gltf.doc[list] = {name};
        try {
            const Scene scene = gltf.load();
            return scene.warnings.empty() ? "" : scene.warnings[0];
        } catch (const Error& e) {
            return "error: " + std::string(e.what());
        }
    };
    EXPECT_EQ(load_with("extensionsRequired", "KHR_lights_punctual"), "");
    EXPECT_EQ(load_with("extensionsRequired", "KHR_mesh_quantization"), "");
    EXPECT_EQ(load_with("extensionsRequired", "KHR_texture_transform"), "");
    EXPECT_THAT(load_with("extensionsRequired", "KHR_materials_unlit"),
                HasSubstr("KHR_materials_unlit is ignored: its surfaces are lit"));
    EXPECT_THAT(load_with("extensionsUsed", "KHR_materials_sheen"), HasSubstr("only the base colour"));
    EXPECT_THAT(load_with("extensionsUsed", "EXT_mesh_gpu_instancing"), HasSubstr("instances are left out"));
    EXPECT_THAT(load_with("extensionsRequired", "EXT_mesh_gpu_instancing"),
                HasSubstr("error: the scene requires the extension EXT_mesh_gpu_instancing"));
    EXPECT_THAT(load_with("extensionsUsed", "ACME_magic"), HasSubstr("ACME_magic is ignored: it is unknown"));
    EXPECT_THAT(load_with("extensionsRequired", "ACME_magic"), HasSubstr("error: the scene requires the extension ACME_magic"));
    EXPECT_THAT(load_with("extensionsRequired", "KHR_draco_mesh_compression"), HasSubstr("decompress it"));
    EXPECT_THAT(load_with("extensionsRequired", "EXT_meshopt_compression"), HasSubstr("decompress it"));
}

}  // namespace
}  // namespace gnomon::test
