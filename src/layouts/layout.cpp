// SPDX-License-Identifier: Apache-2.0
#include "layouts/layout.hpp"

#include <gnomon/error.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "shader_table.h"
#include "text/json_bounds.hpp"
#include "text/read_text.hpp"

namespace gnomon {
namespace {

constexpr const char* kHint = "see CONTRIBUTING.md, A new layout";

struct Format {
    gpu::Texel texel;
    uint32_t bytes;
};

const std::map<std::string, Format> kFormats = {
    {"r32_float", {gpu::Texel::r32_float, 4}},        {"rg32_float", {gpu::Texel::rg32_float, 8}},
    {"rgba32_float", {gpu::Texel::rgba32_float, 16}}, {"r32_uint", {gpu::Texel::r32_uint, 4}},
    {"rg32_uint", {gpu::Texel::rg32_uint, 8}},        {"rgba32_uint", {gpu::Texel::rgba32_uint, 16}},
};

const std::map<std::string, bool> kExitOnly = {{"always", false}, {"exit", true}};

const std::map<std::string, LayoutBuffer::Per> kPer = {
    {"once", LayoutBuffer::Per::once}, {"list", LayoutBuffer::Per::list}, {"range", LayoutBuffer::Per::range}};

template <class Value>
Value lookup(const std::map<std::string, Value>& table, const std::string& key, const std::string& member,
             const std::string& where) {
    auto found = table.find(key);
    if (found != table.end()) return found->second;
    std::string known;
    for (const auto& entry : table) known += (known.empty() ? "" : ", ") + entry.first;
    throw Error(ErrorKind::input, "'" + member + "' is '" + key + "'", where, "use one of " + known);
}

LayoutBuffer parse_buffer(const nlohmann::json& json, const std::string& where) {
    LayoutBuffer buffer;
    buffer.block = json.at("block").get<std::string>();
    buffer.texel = json.value("texel", "");
    Format format = lookup(kFormats, json.value("format", "r32_uint"), "format", where);
    buffer.format = format.texel;
    buffer.element_bytes = format.bytes;
    buffer.per = lookup(kPer, json.at("per").get<std::string>(), "per", where);
    buffer.exit_only = lookup(kExitOnly, json.value("when", "always"), "when", where);
    buffer.scan = json.value("scan", false);
    buffer.copy_of = json.value("copy_of", "");
    if (json.contains("clear")) {
        if (json["clear"] == "range_first") {
            buffer.clear = LayoutBuffer::Clear::range_first;
        } else {
            buffer.clear = LayoutBuffer::Clear::value;
            buffer.clear_value = json["clear"].get<uint32_t>();
        }
    }
    if (buffer.scan && (buffer.per != LayoutBuffer::Per::list || buffer.element_bytes != 4)) {
        throw Error(ErrorKind::input, "'scan' needs one r32_uint per list", where,
                    "change 'per' or 'format' of " + buffer.block);
    }
    return buffer;
}

// Of a layout's folder.
std::string read_part(const std::filesystem::path& path) {
    std::string reason;
    if (std::optional<std::string> text = read_text(path, reason)) return *text;
    throw Error(ErrorKind::input, "a layout's file is missing or cannot be read: " + reason, path.string(),
                "name a folder with layout.glsl and layout.json");
}

Layout load_layout(const std::filesystem::path& given) {
    std::error_code ignored;  // Of a path that cannot be made canonical no file can be read, which is said.
    std::filesystem::path folder = std::filesystem::weakly_canonical(std::filesystem::absolute(given, ignored), ignored);
    if (folder.empty()) folder = given;
    const std::filesystem::path manifest = folder / "layout.json";
    Layout layout = parse_layout(read_part(manifest), manifest.string());
    read_part(folder / "layout.glsl");
    layout.folder = folder;
    return layout;
}

}  // namespace

std::string Layout::stage(const std::string& name_without) const {
    return name_without + "@" + (folder.empty() ? name : folder.string());
}

Layout parse_layout(std::string_view text, const std::string& where) {
    check_json(text, where, kHint);
    try {
        nlohmann::json json = nlohmann::json::parse(text);
        Layout layout;
        layout.name = json.at("name").get<std::string>();
        layout.summary = json.value("summary", "");
        layout.source = json.value("source", "");
        layout.lossless = json.value("lossless", true);
        for (const auto& buffer : json.at("buffers")) layout.buffers.push_back(parse_buffer(buffer, where));
        return layout;
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorKind::input, std::string("not a layout's manifest: ") + e.what(), where, kHint);
    }
}

std::vector<std::string> layout_names() {
    std::vector<std::string> names;
    for (const auto& entry : kLayoutTable) names.emplace_back(entry.name);
    return names;
}

Layout find_layout(const std::string& name_or_folder) {
    std::string known;
    for (const auto& entry : kLayoutTable) {
        if (name_or_folder == entry.name) return parse_layout(entry.manifest, name_or_folder + "/layout.json");
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    std::error_code ignored;
    if (name_or_folder.find('/') != std::string::npos || std::filesystem::is_directory(name_or_folder, ignored))
        return load_layout(name_or_folder);
    throw Error(ErrorKind::usage, "no S-buffer layout '" + name_or_folder + "'", "--layout",
                "use one of " + known + ", or a folder with layout.glsl and layout.json");
}

Layout with_ranges(Layout layout, bool exit_depth) {
    if (!exit_depth) std::erase_if(layout.buffers, [](const LayoutBuffer& buffer) { return buffer.exit_only; });
    return layout;
}

}  // namespace gnomon
