// SPDX-License-Identifier: Apache-2.0
// From bytes to a checked document. tinygltf parses what our checks have passed, without its file access and image decoding:
// those follow any path, and its parser trusts sizes and indices.
#include "scene/gltf_document.hpp"

#include <array>
#include <cmath>
#include <new>

#include "scene/gltf_check.hpp"
#include "scene/gltf_file.hpp"
#include "text/json_bounds.hpp"

namespace gnomon::gltf {

using nlohmann::json;

namespace {

constexpr const char* kHint = "repair or export the file again";

[[noreturn]] void fail(const std::string& what, const std::string& name) {
    throw Error(ErrorKind::input, what, "in " + name, kHint);
}

json parse_json(const SceneFile& file) {
    if (file.json.starts_with("\xEF\xBB\xBF")) fail("the JSON text starts with a byte order mark", file.name);
    check_json(file.json, "in " + file.name, kHint);
    return json::parse(file.json);
}

// Integers may be written as 1.0 (glTF 2.0, 2.7), which tinygltf rejects.
void make_integers(json& value) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number >= 0.0 && number < kExact && number == std::floor(number)) value = static_cast<uint64_t>(number);
    } else if (value.is_structured()) {
        for (json& element : value) make_integers(element);
    }
}

// Leaves out what gnomon does not read: extras, and extensions except the named ones.
void strip(json& value) {
    if (value.is_object()) {
        value.erase("extras");
        if (const auto it = value.find("extensions"); it != value.end()) {
            json kept = json::object();
            for (const char* name : {"KHR_lights_punctual", "KHR_texture_transform"}) {
                if (it->is_object() && it->contains(name)) kept[name] = (*it)[name];
            }
            *it = std::move(kept);
        }
    }
    if (value.is_structured()) {
        for (json& element : value) strip(element);
    }
}

// The document as tinygltf can take it: no addresses, and a view for every accessor (the one behind the last is none).
json parser_input(const json& document, const std::vector<AccessorInfo>& accessors) {
    json input = json::object();
    for (const auto& [key, value] : document.items()) {
        if (key != "buffers" && key != "images") input[key] = value;
    }
    strip(input);
    // tinygltf copies an animation's extensions into each of its samplers, and gnomon reads none.
    if (const auto animations = input.find("animations"); animations != input.end()) {
        for (json& animation : *animations) animation.erase("extensions");
    }
    if (accessors.empty()) return input;
    json& views = input["bufferViews"];
    if (views.is_null()) views = json::array();
    const size_t no_view = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    size_t i = 0;
    for (json& accessor : input["accessors"]) {
        if (accessors[i].columns == 0) accessor = {{"type", "SCALAR"}, {"componentType", kFloat}, {"count", 1}};
        if (!accessor.contains("bufferView")) accessor["bufferView"] = no_view;
        ++i;
    }
    return input;
}

// Callbacks of a file system without files. tinygltf 2.9 has one more than 2.8, and takes none if one is missing.
template <class Callbacks>
Callbacks no_files() {
    Callbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return false; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; };
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
    if constexpr (requires { callbacks.GetFileSizeInBytes; })
        callbacks.GetFileSizeInBytes = [](size_t*, std::string*, const std::string&, void*) { return false; };
    return callbacks;
}

tinygltf::Model parse_model(const json& document, const std::vector<AccessorInfo>& accessors, const std::string& name) {
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(no_files<tinygltf::FsCallbacks>());
    std::string messages;
    std::string unused;
    bool done = false;
    try {
        const std::string text = parser_input(document, accessors).dump();
        done = parser.LoadASCIIFromString(&model, &messages, &unused, text.data(), static_cast<unsigned int>(text.size()), "",
                                          tinygltf::NO_REQUIRE);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        messages = e.what();
    }
    if (!done) {
        for (char& c : messages) c = c == '\n' ? ' ' : c;
        fail("tinygltf cannot parse the scene (" + messages + ")", name);
    }
    const int no_view = static_cast<int>(model.bufferViews.size()) - 1;
    for (tinygltf::Accessor& accessor : model.accessors) {
        if (accessor.bufferView == no_view) accessor.bufferView = -1;
    }
    if (!accessors.empty()) model.bufferViews.pop_back();
    return model;
}

void load_buffers(Document& document, SceneFile& file) {
    document.root().for_each("buffers", [&](const Cursor& buffer, size_t i) {
        tinygltf::Buffer loaded;
        const uint64_t bytes = buffer.get("byteLength").integer();
        if (const auto uri = buffer.find("uri")) {
            loaded.data = read_uri(document.folder, *uri, bytes, kMaxBufferBytes, bytes);
        } else if (i == 0 && file.has_binary) {
            if (file.binary.size() < bytes) {
                buffer.fail(std::to_string(bytes) + " bytes are declared, the BIN chunk has " +
                            std::to_string(file.binary.size()));
            }
            loaded.data = std::move(file.binary);
        } else if (i == 0 && file.is_glb) {
            buffer.fail("the GLB has no BIN chunk for this buffer");
        }
        document.model.buffers.push_back(std::move(loaded));
    });
}

}  // namespace

Document read_document(const std::filesystem::path& path, std::vector<std::string>& warnings) {
    SceneFile file = read_scene_file(path, warnings);
    Document document{file.folder, file.name, parse_json(file), {}, 0};
    file.json = {};
    make_integers(document.json);
    check_document(document.root());
    warn_of_extensions(document.root(), warnings);
    document.model = parse_model(document.json, check_data(document.root()), document.name);
    load_buffers(document, file);
    return document;
}

}  // namespace gnomon::gltf
