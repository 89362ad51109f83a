// SPDX-License-Identifier: Apache-2.0
// Writes inputs for the fuzzers to begin with, and dictionaries of the words in them: fuzz_seeds FOLDER.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <cstdio>
#include <numeric>

#include "io/exr.hpp"
#include "io/png.hpp"
#include "io/report.hpp"
#include "rich_document.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace {

namespace fs = std::filesystem;
using namespace gnomon;
using test::json;

constexpr uint32_t kSide = 8;

void put(const fs::path& path, std::string_view content) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

std::string content_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string little_endian(uint32_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(value >> shift & 0xffu));
    return bytes;
}

std::string padded(std::string chunk, char with) {
    chunk.resize((chunk.size() + 3) / 4 * 4, with);
    return chunk;
}

std::string glb(const json& document, const std::string& binary) {
    const std::string text = padded(document.dump(), ' '), data = padded(binary, '\0');
    const auto chunk = [](const std::string& content, const char* type) {
        return little_endian(static_cast<uint32_t>(content.size())) + std::string(type, 4) + content;
    };
    const std::string chunks = chunk(text, "JSON") + chunk(data, "BIN\0");
    return "glTF" + little_endian(2) + little_endian(static_cast<uint32_t>(chunks.size() + 12)) + chunks;
}

std::vector<uint8_t> gradient(size_t values) {
    std::vector<uint8_t> bytes(values);
    std::iota(bytes.begin(), bytes.end(), uint8_t{0});
    return bytes;
}

std::string png() {
    const std::vector<std::byte> file = io::encode_png(kSide, kSide, gradient(kSide * kSide * 3));
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

std::string jpeg(int channels, int quality) {
    std::string file;
    const auto append = [](void* to, void* data, int bytes) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<size_t>(bytes));
    };
    stbi_write_jpg_to_func(append, &file, kSide, kSide, channels, gradient(kSide * kSide * 4).data(), quality);
    return file;
}

// Each key and each text of a document.
void words_of(const json& value, std::set<std::string>& words) {
    const bool is_word = value.is_string() && !value.get<std::string>().empty() && value.get<std::string>().size() < 40;
    if (is_word) words.insert(value);
    if (value.is_object()) {
        for (const auto& [key, member] : value.items()) words.insert(key);
    }
    if (value.is_structured()) {
        for (const json& element : value) words_of(element, words);
    }
}

void put_dictionary(const fs::path& path, const std::vector<json>& documents) {
    std::set<std::string> words;
    for (const json& document : documents) words_of(document, words);
    std::string lines;
    for (const std::string& word : words) lines += json(word).dump() + "\n";
    put(path, lines);
}

void make_scenes(const fs::path& folder) {
    test::Gltf gltf;
    json document = test::rich_document(gltf);
    const std::string binary = content_of(gltf.folder.path() / "data.bin");
    put_dictionary(folder / "scene.dict", {document});
    document["buffers"][0].erase("uri");
    put(folder / "scene" / "rich.glb", glb(document, binary));
    const std::string image = png();
    document["buffers"][0]["byteLength"] = binary.size() + image.size();
    document["images"] = {{{"bufferView", document["bufferViews"].size()}, {"mimeType", "image/png"}}};
    document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", image.size()}});
    put(folder / "scene" / "textured.glb", glb(document, binary + image));

    test::Gltf triangle;
    triangle.add_triangle();
    triangle.write();
    triangle.doc["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    put(folder / "scene" / "triangle.gltf", triangle.doc.dump());
}

void make_images(const fs::path& folder) {
    put(folder / "image" / "rgb.png", png());
    put(folder / "image" / "rgb.jpg", jpeg(3, 90));
    put(folder / "image" / "rgb_halved.jpg", jpeg(3, 50));
    put(folder / "image" / "grey.jpg", jpeg(1, 90));
}

void make_exrs(const fs::path& folder) {
    fs::create_directories(folder / "exr");
    std::vector<float> values(kSide * kSide);
    std::iota(values.begin(), values.end(), 0.5f);
    io::write_exr(folder / "exr" / "two_channels.exr", kSide, kSide,
                  std::vector<Channel>{{"R", values}, {"visibility.0", values}}, {{"gnomon:method", "exact"}});
    for (int compression = Imf::NO_COMPRESSION; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
        for (const bool tiled : {false, true}) {
            Imf::Header header(kSide, kSide);
            header.compression() = static_cast<Imf::Compression>(compression);
            header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
            Imf::FrameBuffer frame_buffer;
            frame_buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), Imath::V2i(0, 0), kSide, kSide));
            const std::string name = "compression" + std::to_string(compression) + (tiled ? "_tiled.exr" : ".exr");
            const std::string path = (folder / "exr" / name).string();
            if (tiled) {
                header.setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
                Imf::TiledOutputFile file(path.c_str(), header);
                file.setFrameBuffer(frame_buffer);
                file.writeTiles(0, 1, 0, 1);
            } else {
                Imf::OutputFile file(path.c_str(), header);
                file.setFrameBuffer(frame_buffer);
                file.writePixels(kSide);
            }
        }
    }
}

void make_documents(const fs::path& folder) {
    Frame frame;
    frame.width = frame.height = kSide;
    frame.effective = {{"method", "exact"}, {"layout", "array"}};
    frame.stats.stages = {{"sample/trace", 0.5, 3, 0.25}};
    frame.stats.counts = {{"ranges", 7}};
    const io::Json render = io::render_json(frame, io::settings_json({}), {"a.exr"}, {"a warning"});
    put(folder / "render_json" / "render.json", io::to_text(render));
    put(folder / "json" / "render.json", io::to_text(render));
    put(folder / "json" / "values.json", R"([{"a": [1, -2.5e3, true, null, "\u00e9\ud83d\ude00\n"]}, "\u001b"])");

    const json layout = {
        {"name", "list"},
        {"summary", "one line"},
        {"source", "a paper"},
        {"lossless", true},
        {"bands", false},
        {"texels", "morton"},
        {"iterator", "uvec4"},
        {"constants", {{"PAGE", 4}}},
        {"counters", {"lost"}},
        {"prepare", "tile"},
        {"finish", "list"},
        {"sizes",
         {{{"name", "ranges"}, {"as", "offsets"}},
          {{"name", "pages"}, {"as", "allocated"}},
          {{"name", "longest"}, {"per", "tile"}, {"as", "values"}}}},
        {"buffers",
         {{{"name", "heads"}, {"type", "uint"}, {"per", "list"}, {"initial", "none"}},
          {{"name", "pages"}, {"type", "vec4"}, {"per", "pages"}, {"elements", "PAGE"}},
          {{"name", "table"}, {"type", "uvec2"}, {"length", "max(2 * ranges, lists / (PAGE - 1)) + min(tiles, 7)"}},
          {{"name", "exits"}, {"type", "float"}, {"per", "ranges"}, {"when", "exit"}, {"initial", 7}}}}};
    put(folder / "layout" / "layout.json", layout.dump());
    put_dictionary(folder / "layout.dict", {layout});
    put_dictionary(folder / "render_json.dict", {json::parse(io::to_text(render))});
}

void make_command_lines(const fs::path& folder) {
    const std::vector<std::vector<std::string>> lines = {
        {"render", "a.glb", "-o", "a_####.exr", "--frames=0-9", "--fps", "24", "--shutter-angle=180", "--size", "64x48",
         "--spp=4"},
        {"render", "a.gltf", "-oa.exr", "--png=a.png", "--json", "-", "--camera", "close up", "--memory-budget", "512M",
         "--shutter=0:0.5", "--animation=all", "--time-steps=16", "--method", "dsm", "--ground=auto", "--exposure=-1.5"},
        {"compare", "a.exr", "b.exr", "--metric", "flip", "--threshold", "0.1", "--channels", "R", "--again", "c.exr",
         "--diff-png=d.png"},
        {"compare", "a.json", "b.json", "c.exr", "--after", "1.5", "2", "--to=0.1", "--by", "method", "spp"},
        {"info", "a.glb", "--json"},
        {"ranges", "a.glb", "--shadow-res", "64"},
        {"devices"},
        {"methods"},
        {"--version"},
        {"render", "--help"}};
    std::set<std::string> words;
    for (size_t i = 0; i < lines.size(); ++i) {
        std::string text;
        for (const std::string& word : lines[i]) {
            text += word + "\n";
            words.insert(word.substr(0, word.find('=')));
        }
        put(folder / "command_line" / std::to_string(i), text);
    }
    put_dictionary(folder / "command_line.dict", {json(words)});
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "fuzz_seeds FOLDER\n");
        return 2;
    }
    const fs::path folder = argv[1];
    make_scenes(folder);
    make_images(folder);
    make_exrs(folder);
    make_documents(folder);
    make_command_lines(folder);
    return 0;
}
