// SPDX-License-Identifier: Apache-2.0
// Files: GLB, addresses, buffers, limits on what a document may hold.
#include "gltf_builder.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

std::string error_of(const std::filesystem::path& path) {
    try {
        load_scene(path);
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::input);
        return e.what();
    }
    return "";
}

std::string u32(uint64_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xffu));
    return bytes;
}

std::string chunk(const std::string& type, const std::string& data) { return u32(data.size()) + type + data; }

std::string glb(const std::string& chunks, uint32_t version = 2, int64_t extra_length = 0) {
    return "glTF" + u32(version) + u32(static_cast<uint64_t>(static_cast<int64_t>(chunks.size()) + 12 + extra_length)) + chunks;
}

const std::string kEmpty = R"({"asset":{"version":"2.0"}}  )";

TEST(File, MissingFilesAndFolders) {
    TempFolder folder;
    EXPECT_THAT(error_of(folder.path() / "no.gltf"), HasSubstr("does not exist"));
    EXPECT_THAT(error_of(folder.path()), HasSubstr("not a regular file"));
    EXPECT_THAT(error_of("/dev/zero"), HasSubstr("not a regular file"));
    EXPECT_THAT(error_of(folder.write("a.gltf", "")), HasSubstr("not valid JSON"));
    EXPECT_THAT(error_of(folder.write("a.gltf", "{\"asset\":")), HasSubstr("not valid JSON"));
    EXPECT_THAT(error_of(folder.write("a.gltf", "[]")), HasSubstr("an object is expected"));
    EXPECT_THAT(error_of(folder.write("a.gltf", "\xEF\xBB\xBF" + kEmpty)), HasSubstr("byte order mark"));
    EXPECT_EQ(error_of(folder.write("a.gltf", kEmpty)), "");
}

TEST(File, RelativePathInTheWorkingFolder) {
    TempFolder folder;
    folder.write("a.gltf", kEmpty);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    EXPECT_EQ(error_of("a.gltf"), "");
    std::filesystem::current_path(before);
}

TEST(File, Glb) {
    TempFolder folder;
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["buffers"] = json::array({{{"byteLength", 36}}});
    std::string numbers(36, '\0');
    std::memcpy(numbers.data(), Gltf::kTriangle.data(), 36);
    const std::string text = chunk("JSON", gltf.doc.dump());
    const std::string binary = chunk(std::string("BIN\0", 4), numbers);
    EXPECT_EQ(load_scene(folder.write("a.glb", glb(text + binary))).vertices[1].position, glm::vec3(1, 0, 0));

    EXPECT_THAT(load_scene(folder.write("a.glb", glb(text + binary) + "tail")).warnings, has_warning("4 bytes behind the end"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(text))), HasSubstr("no BIN chunk"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(text + binary + binary))), HasSubstr("more than one BIN"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(text + text))), HasSubstr("one JSON chunk"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(binary + text))), HasSubstr("one JSON chunk"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(text + binary, 1))), HasSubstr("GLB version 1"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(text + binary, 2, 4))), HasSubstr("header states"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(""))), HasSubstr("header states"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(text + u32(0xffffffff) + "BIN"))), HasSubstr("cut off"));
    EXPECT_THAT(error_of(folder.write("a.glb", glb(text + u32(0xffffffff) + "BIN" + '\0'))),
                HasSubstr("states 4294967295 bytes"));
    gltf.doc["buffers"][0]["byteLength"] = 40;
    EXPECT_THAT(error_of(folder.write("a.glb", glb(chunk("JSON", gltf.doc.dump()) + binary))),
                HasSubstr("40 bytes are declared"));
}

// The error of a triangle whose buffer has this address.
std::string error_with_uri(const std::string& uri, Gltf&& gltf = {}) {
    gltf.add_triangle();
    gltf.doc["buffers"] = json::array({{{"byteLength", 36}, {"uri", uri}}});
    return gltf.error();
}

TEST(File, AddressesInsideTheFolder) {
    const std::string data(36, '\0');
    for (const auto& [name, uri] : std::vector<std::pair<std::string, std::string>>{{"my data.bin", "my data.bin"},
                                                                                    {"my data.bin", "my%20data.bin"},
                                                                                    {"50%.bin", "50%25.bin"},
                                                                                    {"k\xC3\xA4se.bin", "k\xC3\xA4se.bin"},
                                                                                    {"k\xC3\xA4se.bin", "k%C3%a4se.bin"},
                                                                                    {"..bin", "./..bin"}}) {
        Gltf gltf;
        gltf.folder.write(name, data);
        EXPECT_EQ(error_with_uri(uri, std::move(gltf)), "") << uri;
    }
    Gltf gltf;
    std::filesystem::create_directory(gltf.folder.path() / "sub");
    gltf.folder.write("sub/data.bin", data);
    std::filesystem::create_symlink("sub/data.bin", gltf.folder.path() / "link.bin");
    EXPECT_EQ(error_with_uri("link.bin", std::move(gltf)), "");
}

TEST(File, AddressesOutsideTheFolder) {
    TempFolder outside;
    const std::string secret = outside.write("secret.bin", std::string(36, '\0')).string();
    const std::string name = outside.path().filename().string() + "/secret.bin";
    EXPECT_THAT(error_with_uri("../" + name), HasSubstr("leaves the scene's folder"));
    EXPECT_THAT(error_with_uri("%2e%2e/" + name), HasSubstr("leaves the scene's folder"));
    EXPECT_THAT(error_with_uri("./../" + name), HasSubstr("leaves the scene's folder"));
    EXPECT_THAT(error_with_uri(secret), HasSubstr("absolute path"));
    EXPECT_THAT(error_with_uri("file://" + secret), HasSubstr("not a file name"));
    EXPECT_THAT(error_with_uri("http://example.com/a.bin"), HasSubstr("not a file name"));
    Gltf gltf;
    std::filesystem::create_symlink(secret, gltf.folder.path() / "link.bin");
    EXPECT_THAT(error_with_uri("link.bin", std::move(gltf)), HasSubstr("by a link"));
    Gltf folder_link;
    std::filesystem::create_directory_symlink(outside.path(), folder_link.folder.path() / "sub");
    EXPECT_THAT(error_with_uri("sub/secret.bin", std::move(folder_link)), HasSubstr("by a link"));
}

TEST(File, AddressesThatAreNoFiles) {
    EXPECT_THAT(error_with_uri("."), HasSubstr("not a regular file"));
    EXPECT_THAT(error_with_uri(""), HasSubstr("empty"));
    EXPECT_THAT(error_with_uri("none.bin"), HasSubstr("cannot be found"));
    EXPECT_THAT(error_with_uri("%zz.bin"), HasSubstr("hexadecimal"));
    EXPECT_THAT(error_with_uri("a%00.bin"), HasSubstr("zero character"));
    EXPECT_THAT(error_with_uri(std::string(100000, 'a')), HasSubstr("cannot be found"));
}

TEST(File, DataAddresses) {
    Gltf gltf;
    const json triangle = {{"byteLength", 36},
                           {"uri", "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}};
    gltf.add_triangle();
    gltf.doc["buffers"] = json::array({triangle});
    EXPECT_EQ(gltf.load().vertices[2].position, glm::vec3(0, 1, 0));

    EXPECT_THAT(error_with_uri("data:;base64,AAAA"), HasSubstr("36 bytes are declared, the address holds 3"));
    EXPECT_THAT(error_with_uri("data:;base64,A*AA"), HasSubstr("invalid character"));
    EXPECT_THAT(error_with_uri("data:;base64,AAAAA"), HasSubstr("cut off"));
    EXPECT_THAT(error_with_uri("data:"), HasSubstr("no data"));
    EXPECT_THAT(error_with_uri("data:,%00"), HasSubstr("the address holds 1"));
    EXPECT_EQ(error_with_uri("data:," + std::string(36, 'a')), "");
}

TEST(File, BuffersMustHoldWhatTheyDeclare) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["buffers"] = json::array({{{"byteLength", 100}, {"uri", "data.bin"}}});
    EXPECT_THAT(gltf.error(), HasSubstr("100 bytes are declared, the address holds 36"));
    gltf.doc["buffers"][0]["byteLength"] = 1000000000;
    EXPECT_THAT(gltf.error(), HasSubstr("1000000000 bytes are declared"));
    gltf.doc["buffers"][0]["byteLength"] = 35;
    EXPECT_THAT(gltf.error(), HasSubstr("the view ends at byte 36 of a buffer of 35 bytes"));
    gltf.doc["buffers"] = json::array({{{"byteLength", 36}}});
    EXPECT_THAT(gltf.error(), HasSubstr("buffer 0 has no data"));
    gltf.doc.erase("meshes");
    gltf.doc.erase("nodes");
    EXPECT_EQ(gltf.error(), "");  // Nothing reads it.
}

TEST(File, ViewsMustLieInTheirBuffers) {
    const auto error_with = [](const std::string& key, const json& value) {
        Gltf gltf;
        gltf.add_triangle();
        gltf.doc["bufferViews"][0][key] = value;
        return gltf.error();
    };
    EXPECT_THAT(error_with("byteLength", 37), HasSubstr("the view ends at byte 37 of a buffer of 36 bytes"));
    EXPECT_THAT(error_with("byteOffset", 4), HasSubstr("/bufferViews/0"));
    EXPECT_THAT(error_with("byteOffset", uint64_t{18446744073709551580u}), HasSubstr("/bufferViews/0/byteOffset"));
    EXPECT_THAT(error_with("byteStride", 8), HasSubstr("do not fit a stride of 8"));
    EXPECT_THAT(error_with("byteStride", 10), HasSubstr("not a multiple of 4"));
    EXPECT_THAT(error_with("byteStride", 256), HasSubstr("/bufferViews/0/byteStride"));
    EXPECT_THAT(error_with("buffer", 1), HasSubstr("/bufferViews/0/buffer"));
    EXPECT_THAT(error_with("buffer", "0"), HasSubstr("/bufferViews/0/buffer"));
}

TEST(File, Versions) {
    Gltf gltf;
    gltf.doc["asset"]["version"] = "1.0";
    EXPECT_THAT(gltf.error(), HasSubstr("glTF version '1.0'"));
    gltf.doc["asset"] = {{"version", "2.9"}};
    EXPECT_EQ(gltf.error(), "");
    gltf.doc["asset"] = {{"version", "2.9"}, {"minVersion", "2.1"}};
    EXPECT_THAT(gltf.error(), HasSubstr("needs glTF 2.1"));
    gltf.doc.erase("asset");
    EXPECT_THAT(gltf.error(), HasSubstr("'asset' is missing"));
}

TEST(File, JsonThatWouldExhaustParsers) {
    TempFolder folder;
    const std::string deep =
        R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_THAT(error_of(folder.write("a.gltf", deep)), HasSubstr("nested more than"));
    std::string many = R"({"asset":{"version":"2.0"},"materials":[{})";
    for (int i = 0; i < 600000; ++i) many += ",{}";
    EXPECT_THAT(error_of(folder.write("a.gltf", many + "]}")), HasSubstr("objects"));
    EXPECT_THAT(error_of(folder.write("a.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1e999,1,1]}]})")),
                HasSubstr("JSON"));
    EXPECT_THAT(error_of(folder.write("a.gltf", "{\"asset\":{\"version\":\"2.0\xff\"}}")), HasSubstr("JSON"));
}

TEST(File, CollectionsOfTheWrongKind) {
    for (const char* key : {"accessors", "animations", "bufferViews", "buffers", "cameras", "images", "materials", "meshes",
                            "nodes", "samplers", "scenes", "skins", "textures"}) {
        Gltf gltf;
        gltf.doc[key] = json::object();
        EXPECT_THAT(gltf.error(), HasSubstr(key));
        gltf.doc[key] = json::array({1});
        EXPECT_THAT(gltf.error(), HasSubstr(std::string(key) + "/0"));
        gltf.doc[key] = nullptr;
        EXPECT_THAT(gltf.error(), HasSubstr(key));
    }
}

}  // namespace
}  // namespace gnomon::test
