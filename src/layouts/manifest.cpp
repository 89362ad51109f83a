// SPDX-License-Identifier: Apache-2.0
#include "layouts/manifest.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gnomon/error.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "shared/params.h"
#include "text/json_bounds.hpp"
#include "text/json_line.hpp"

namespace gnomon {
namespace {

constexpr const char* kHint = "see docs/layouts.md";
constexpr const char* kTriangles = "triangles";
constexpr size_t kMostName = 40;
constexpr size_t kMostBuffers = 12;  // Bindings from 16 to 39, beside those of the sizes.

struct Element {
    gpu::Texel texel;
    uint32_t bytes;
    const char* type;
    const char* stored;
};

const std::map<std::string, Element> kTypes = {
    {"float", {gpu::Texel::r32_float, 4, "float", "float"}},       {"vec2", {gpu::Texel::rg32_float, 8, "vec2", "vec2"}},
    {"vec4", {gpu::Texel::rgba32_float, 16, "vec4", "vec4"}},      {"uint", {gpu::Texel::r32_uint, 4, "uint", "uint"}},
    {"uvec2", {gpu::Texel::rg32_uint, 8, "uvec2", "uvec2"}},       {"uvec4", {gpu::Texel::rgba32_uint, 16, "uvec4", "uvec4"}},
    {"uint16", {gpu::Texel::r16_uint, 2, "uint", "uint16_t"}},     {"u16vec2", {gpu::Texel::rg16_uint, 4, "uvec2", "u16vec2"}},
    {"u16vec4", {gpu::Texel::rgba16_uint, 8, "uvec4", "u16vec4"}}, {"uint8", {gpu::Texel::r8_uint, 1, "uint", "uint8_t"}},
    {"u8vec2", {gpu::Texel::rg8_uint, 2, "uvec2", "u8vec2"}},      {"u8vec4", {gpu::Texel::rgba8_uint, 4, "uvec4", "u8vec4"}},
};
const std::map<std::string, bool> kExitOnly = {{"always", false}, {"exit", true}};
const std::map<std::string, LayoutSize::Per> kSizePer = {{"list", LayoutSize::Per::list}, {"tile", LayoutSize::Per::tile}};
const std::map<std::string, LayoutSize::As> kAs = {{"total", LayoutSize::As::total},
                                                   {"values", LayoutSize::As::values},
                                                   {"offsets", LayoutSize::As::offsets},
                                                   {"allocated", LayoutSize::As::allocated}};
const std::map<std::string, Layout::Pass> kPasses = {
    {"none", Layout::Pass::none}, {"list", Layout::Pass::list}, {"tile", Layout::Pass::tile}};
const std::map<std::string, bool> kMorton = {{"rows", false}, {"morton", true}};
const std::map<std::string, std::string> kIterators = {
    {"uint", "uint"}, {"uvec2", "uvec2"}, {"uvec3", "uvec3"}, {"uvec4", "uvec4"}};

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

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
        std::vector<std::string> known;
        for (const auto& entry : table) known.push_back(entry.first);
        fail(member, "is '" + key + "'", "use one of " + listed(known));
    }

    /// What GLSL can have as a part of a name.
    std::string identifier(const std::string& member) {
        const std::string name = string(member);
        check_identifier(member, name);
        return name;
    }
    void check_identifier(const std::string& member, const std::string& name) const {
        const auto fits = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
        };
        const bool all = std::all_of(name.begin(), name.end(), fits);
        if (name.empty() || name.size() > kMostName || !all || (name[0] >= '0' && name[0] <= '9') ||
            name.find("__") != name.npos)
            fail(member, "is not a name",
                 "use letters, digits and single _, at most " + std::to_string(kMostName) + ", no digit first");
    }

    uint32_t number(const std::string& member, const nlohmann::json& value) const {
        if (!value.is_number_unsigned() || value.get<uint64_t>() > std::numeric_limits<uint32_t>::max())
            fail(member, "is not an integer from 0 to 4294967295");
        return value.get<uint32_t>();
    }

    /// Each object of an array, with a Members of its own; none where there is no such member.
    template <class Visit>
    void each(const std::string& member, const Visit& visit) {
        const nlohmann::json* array = find(member);
        if (array == nullptr) return;
        if (!array->is_array()) fail(member, "is not an array");
        for (size_t i = 0; i < array->size(); ++i) {
            Members one((*array)[i], text_, where_, pointer_ + "/" + member + "/" + std::to_string(i));
            visit(one);
            one.check_known();
        }
    }

    size_t line() const { return json_line(text_, pointer_); }

    void check_known() const {
        for (const auto& [member, value] : object_.items()) {
            if (known_.count(member) > 0) continue;
            fail(member, "is not known", "use one of " + listed({known_.begin(), known_.end()}));
        }
    }

private:
    const nlohmann::json& object_;
    std::string_view text_;
    const std::string& where_;
    std::string pointer_;
    std::set<std::string> known_;
};

// Of a word, which components of fewer bits share.
uint32_t initial_bits(const Members& members, const nlohmann::json& value, const LayoutBuffer& buffer) {
    if (!is_float(buffer.format)) {
        if (value == "none") return shared::kNone;
        const uint32_t number = members.number("initial", value), bits = component_bits(buffer);
        if (bits < 32 && number >> bits != 0) members.fail("initial", "is more than " + std::to_string(bits) + " bits hold");
        return bits == 32 ? number : bits == 16 ? number * 0x10001u : number * 0x1010101u;
    }
    const auto number = value.is_number() ? static_cast<float>(value.get<double>()) : 0.0f;
    if (!value.is_number() || !std::isfinite(number)) members.fail("initial", "is not a number that a 32-bit float holds");
    return std::bit_cast<uint32_t>(number);
}

size_t size_named(const Layout& layout, const std::string& name) {
    const auto named = [&](const LayoutSize& size) { return size.name == name; };
    return static_cast<size_t>(std::find_if(layout.sizes.begin(), layout.sizes.end(), named) - layout.sizes.begin());
}

const uint32_t* constant_named(const Layout& layout, const std::string& name) {
    for (const auto& [known, value] : layout.constants) {
        if (known == name) return &value;
    }
    return nullptr;
}

void parse_size(Members& members, Layout& layout) {
    LayoutSize size;
    size.line = members.line();
    size.name = members.identifier("name");
    size.listed = size.name == kTriangles;
    size.per = members.one_of("per", kSizePer, size.listed ? "tile" : "list");
    if (size.listed && size.per != LayoutSize::Per::tile) members.fail("per", "of the triangles is not 'tile'");
    size.as = members.one_of("as", kAs);
    const size_t same = size_named(layout, size.name);
    if (same == layout.sizes.size()) {
        if (layout.sizes.size() == shared::kMostSizes)
            members.fail("", "is one size more than " + std::to_string(shared::kMostSizes) + " with the ranges");
        layout.sizes.push_back(std::move(size));
        return;
    }
    if (same > 0 || layout.sizes[0].line > 0) members.fail("name", "is '" + size.name + "', as another's");
    if (size.per != LayoutSize::Per::list) members.fail("per", "of the ranges is not 'list'");
    layout.sizes[0].as = size.as;
    layout.sizes[0].line = size.line;
}

void parse_per(Members& members, const Layout& layout, LayoutBuffer& buffer) {
    const std::string per = members.string("per");
    if (per == "list" || per == "tile") {
        buffer.per = per == "list" ? LayoutBuffer::Per::list : LayoutBuffer::Per::tile;
    } else {
        buffer.per = LayoutBuffer::Per::size;
        buffer.size = size_named(layout, per);
        std::vector<std::string> known = {"list", "tile"};
        for (const LayoutSize& size : layout.sizes) known.push_back(size.name);
        if (buffer.size == layout.sizes.size()) members.fail("per", "is '" + per + "'", "use one of " + listed(known));
        const LayoutSize& size = layout.sizes[buffer.size];
        if (size.as != LayoutSize::As::offsets && size.as != LayoutSize::As::allocated) {
            members.fail("per", "is '" + per + "', which have no places",
                         "give the size '" + per + R"( "as": "offsets" or "allocated" among the 'sizes')");
        }
    }
    if (const nlohmann::json* elements = members.find("elements")) {
        const uint32_t* constant = elements->is_string() ? constant_named(layout, elements->get<std::string>()) : nullptr;
        buffer.elements = constant != nullptr ? *constant : members.number("elements", *elements);
        if (buffer.elements == 0 || buffer.elements > 65536) members.fail("elements", "is not from 1 to 65536");
    }
}

void parse_length(Members& members, const Layout& layout, LayoutBuffer& buffer) {
    try {
        buffer.length = Length(members.string("length"));
    } catch (const std::invalid_argument& error) {
        members.fail("length", std::string("is not an expression: ") + error.what());
    }
    std::vector<std::string> known = {"lists", "tiles"};
    for (const LayoutSize& size : layout.sizes) known.push_back(size.name);
    for (const auto& constant : layout.constants) known.push_back(constant.first);
    for (const std::string& name : buffer.length.names()) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            members.fail("length", "names '" + name + "', which there is not", "use " + listed(known));
    }
}

void parse_buffer(Members& members, Layout& layout) {
    LayoutBuffer buffer;
    buffer.line = members.line();
    buffer.name = members.identifier("name");
    for (const LayoutBuffer& other : layout.buffers) {
        if (other.name == buffer.name) members.fail("name", "is '" + buffer.name + "', as another's");
    }
    const auto element = members.one_of("type", kTypes);
    buffer.type = element.type;
    buffer.stored = element.stored;
    buffer.format = element.texel;
    buffer.element_bytes = element.bytes;
    if ((members.find("per") != nullptr) == (members.find("length") != nullptr))
        members.fail("", "has both 'per' and 'length', or neither", "give one of them");
    if (members.find("per") != nullptr) {
        parse_per(members, layout, buffer);
    } else {
        parse_length(members, layout, buffer);
    }
    buffer.exit_only = members.one_of("when", kExitOnly, "always");
    if (const nlohmann::json* initial = members.find("initial")) buffer.initial = initial_bits(members, *initial, buffer);
    if (layout.buffers.size() == kMostBuffers) members.fail("", "is one buffer more than " + std::to_string(kMostBuffers));
    layout.buffers.push_back(std::move(buffer));
}

void parse_names(Members& members, Layout& layout) {
    if (const nlohmann::json* constants = members.find("constants")) {
        if (!constants->is_object()) members.fail("constants", "is not an object");
        for (const auto& [name, value] : constants->items()) {
            members.check_identifier("constants/" + name, name);
            layout.constants.emplace_back(name, members.number("constants/" + name, value));
        }
    }
    if (const nlohmann::json* counters = members.find("counters")) {
        if (!counters->is_array()) members.fail("counters", "is not an array");
        for (const nlohmann::json& counter : *counters) {
            if (!counter.is_string() || counter != "lost") members.fail("counters", "holds what is not 'lost'");
            if (!layout.counters.empty()) members.fail("counters", "names 'lost' twice");
            layout.counters.push_back(counter.get<std::string>());
        }
    }
}

}  // namespace

bool is_float(gpu::Texel format) {
    return format == gpu::Texel::r32_float || format == gpu::Texel::rg32_float || format == gpu::Texel::rgba32_float;
}

uint32_t component_bits(const LayoutBuffer& buffer) {
    const uint32_t components = buffer.type.ends_with('4') ? 4 : buffer.type.ends_with('2') ? 2 : 1;
    return buffer.element_bytes / components * 8;
}

bool Layout::keeps_counts() const {
    const auto computed = [](const LayoutSize& size) { return !size.listed; };
    return std::any_of(sizes.begin() + 1, sizes.end(), computed) || sizes[0].as == LayoutSize::As::values ||
           sizes[0].as == LayoutSize::As::offsets;
}

bool Layout::lists_triangles() const {
    return std::any_of(sizes.begin(), sizes.end(), [](const LayoutSize& size) { return size.listed; });
}

bool Layout::counts_up() const {
    const auto given_out = [](const LayoutSize& size) { return size.as == LayoutSize::As::allocated; };
    return !counters.empty() || std::any_of(sizes.begin(), sizes.end(), given_out);
}

std::string Layout::stage(const std::string& name_without) const {
    constexpr const char* kWatched[] = {"", " checked", " counted"};
    return name_without + "@" + (folder.empty() ? name : folder.string()) + kWatched[static_cast<size_t>(watch)];
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
    layout.bands = members.boolean("bands", true);
    layout.morton = members.one_of("texels", kMorton, "rows");
    layout.iterator = members.one_of("iterator", kIterators, "uvec2");
    layout.prepare = members.one_of("prepare", kPasses, "none");
    layout.finish = members.one_of("finish", kPasses, "none");
    parse_names(members, layout);
    members.find("sizes");
    if (members.find("buffers") == nullptr) members.fail("buffers", "is missing");
    // First: what is misspelt may be what others are missing.
    members.check_known();
    members.each("sizes", [&](Members& size) { parse_size(size, layout); });
    members.each("buffers", [&](Members& buffer) { parse_buffer(buffer, layout); });
    return layout;
}

}  // namespace gnomon
