// SPDX-License-Identifier: Apache-2.0
#include "layouts/layout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gnomon/error.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "shader_table.h"
#include "text/json_bounds.hpp"
#include "text/json_line.hpp"
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

// A manifest's object, read member by member. What is not read is unknown.
class Members {
public:
    Members(const nlohmann::json& object, std::string_view text, const std::string& where, const std::string& pointer)
        : object_(object), text_(text), where_(where), pointer_(pointer) {
        if (!object.is_object()) fail("", "is not an object");
    }

    [[noreturn]] void fail(const std::string& member, const std::string& what, const std::string& hint = kHint) const {
        const std::string pointer = pointer_ + (member.empty() ? "" : "/" + member);
        throw Error(ErrorKind::input, (pointer.empty() ? "the manifest" : "'" + pointer.substr(1) + "'") + " " + what,
                    where_ + ":" + std::to_string(json_line(text_, pointer)), hint);
    }

    const nlohmann::json* find(const std::string& member) {
        known_.insert(member);
        const auto found = object_.find(member);
        return found == object_.end() ? nullptr : &*found;
    }

    std::string string(const std::string& member, const std::optional<std::string>& fallback = std::nullopt) {
        const nlohmann::json* value = find(member);
        if (value == nullptr && !fallback) fail(member, "is missing");
        if (value != nullptr && !value->is_string()) fail(member, "is not a string");
        return value == nullptr ? *fallback : value->get<std::string>();
    }

    bool boolean(const std::string& member, bool fallback) {
        const nlohmann::json* value = find(member);
        if (value != nullptr && !value->is_boolean()) fail(member, "is neither true nor false");
        return value == nullptr ? fallback : value->get<bool>();
    }

    template <class Value>
    Value one_of(const std::string& member, const std::map<std::string, Value>& table,
                 const std::optional<std::string>& fallback = std::nullopt) {
        const std::string key = string(member, fallback);
        const auto found = table.find(key);
        if (found != table.end()) return found->second;
        std::string known;
        for (const auto& entry : table) known += (known.empty() ? "" : ", ") + entry.first;
        fail(member, "is '" + key + "'", "use one of " + known);
    }

    void check_known() const {
        for (const auto& [member, value] : object_.items()) {
            if (known_.count(member) > 0) continue;
            std::string known;
            for (const std::string& name : known_) known += (known.empty() ? "" : ", ") + name;
            fail(member, "is not known", "use one of " + known);
        }
    }

private:
    const nlohmann::json& object_;
    std::string_view text_;
    const std::string& where_;
    std::string pointer_;
    std::set<std::string> known_;
};

// The bits of a component of the format.
uint32_t clear_bits(Members& members, const nlohmann::json& value, gpu::Texel format) {
    if (is_float(format)) {
        const auto number = value.is_number() ? static_cast<float>(value.get<double>()) : 0.0f;
        if (!value.is_number() || !std::isfinite(number)) members.fail("clear", "is not a number that a 32-bit float holds");
        return std::bit_cast<uint32_t>(number);
    }
    if (!value.is_number_unsigned() || value.get<uint64_t>() > std::numeric_limits<uint32_t>::max())
        members.fail("clear", "is neither 'range_first' nor an integer from 0 to 4294967295");
    return value.get<uint32_t>();
}

LayoutBuffer parse_buffer(const nlohmann::json& json, std::string_view text, const std::string& where, size_t index) {
    const std::string pointer = "/buffers/" + std::to_string(index);
    Members members(json, text, where, pointer);
    LayoutBuffer buffer;
    buffer.line = json_line(text, pointer);
    buffer.block = members.string("block");
    buffer.texel = members.string("texel", "");
    const auto format = members.one_of("format", kFormats, "r32_uint");
    buffer.format = format.texel;
    buffer.element_bytes = format.bytes;
    buffer.per = members.one_of("per", kPer);
    buffer.exit_only = members.one_of("when", kExitOnly, "always");
    buffer.scan = members.boolean("scan", false);
    buffer.copy_of = members.string("copy_of", "");
    if (const nlohmann::json* clear = members.find("clear")) {
        if (*clear == "range_first" && buffer.element_bytes == 4 && !is_float(buffer.format)) {
            buffer.clear = LayoutBuffer::Clear::range_first;
        } else {
            buffer.clear = LayoutBuffer::Clear::value;
            buffer.clear_value = clear_bits(members, *clear, buffer.format);
        }
    }
    if (buffer.block.empty()) members.fail("block", "is empty");
    if (buffer.scan && (buffer.per != LayoutBuffer::Per::list || buffer.format != gpu::Texel::r32_uint))
        members.fail("scan", "needs one r32_uint per list", "change 'per' or 'format'");
    if (!buffer.copy_of.empty() && (buffer.scan || buffer.clear != LayoutBuffer::Clear::no))
        members.fail("copy_of", "does not go with 'scan' or 'clear'", "leave one of them out");
    members.check_known();
    return buffer;
}

// What a buffer says of others.
void check_names(const std::vector<LayoutBuffer>& buffers, const std::string& where) {
    for (const LayoutBuffer& buffer : buffers) {
        const auto fail = [&](const std::string& what) {
            throw Error(ErrorKind::input, "buffer '" + buffer.block + "' " + what, where + ":" + std::to_string(buffer.line),
                        kHint);
        };
        for (const LayoutBuffer& other : buffers) {
            if (&other == &buffer) break;
            if (other.block == buffer.block) fail("is named twice");
            if (!buffer.texel.empty() && other.texel == buffer.texel) fail("is read as '" + buffer.texel + "', as another is");
        }
        if (buffer.copy_of.empty()) continue;
        const auto copied =
            std::find_if(buffers.begin(), buffers.end(), [&](const auto& b) { return b.block == buffer.copy_of; });
        if (copied == buffers.end()) fail("is a copy of '" + buffer.copy_of + "', which there is not");
        if (copied->block == buffer.block) fail("is a copy of itself");
        if (!copied->copy_of.empty()) fail("is a copy of '" + buffer.copy_of + "', which is a copy");
        if (copied->per != buffer.per || copied->element_bytes != buffer.element_bytes || copied->exit_only != buffer.exit_only)
            fail("is a copy of '" + buffer.copy_of + "', which has other 'per', 'format' or 'when'");
    }
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

bool is_float(gpu::Texel format) {
    return format == gpu::Texel::r32_float || format == gpu::Texel::rg32_float || format == gpu::Texel::rgba32_float;
}

std::string Layout::stage(const std::string& name_without) const {
    return name_without + "@" + (folder.empty() ? name : folder.string());
}

Layout parse_layout(std::string_view text, const std::string& where) {
    check_json(text, where, kHint);
    const nlohmann::json json = nlohmann::json::parse(text);
    Members members(json, text, where, "");
    Layout layout;
    layout.name = members.string("name");
    layout.summary = members.string("summary", "");
    layout.source = members.string("source", "");
    layout.lossless = members.boolean("lossless", true);
    const nlohmann::json* buffers = members.find("buffers");
    if (buffers == nullptr) members.fail("buffers", "is missing");
    if (!buffers->is_array()) members.fail("buffers", "is not an array");
    for (const auto& buffer : *buffers) layout.buffers.push_back(parse_buffer(buffer, text, where, layout.buffers.size()));
    members.check_known();
    check_names(layout.buffers, where);
    return layout;
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
