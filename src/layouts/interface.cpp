// SPDX-License-Identifier: Apache-2.0
#include "layouts/interface.hpp"

#include <algorithm>

namespace gnomon {
namespace {

// Bindings of common/s_buffer.glsl, then these.
constexpr uint32_t kSizesBinding = 20;
constexpr uint32_t kBuffersBinding = 24;

// "fetch_@(uint i)" with the name for @.
std::string named(std::string text, const std::string& name) {
    for (size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at + name.size())) text.replace(at, 1, name);
    return text;
}

std::string stored_reads(uint32_t binding, const LayoutBuffer& buffer) {
    const std::string parts = buffer.type == "uint" ? "x" : buffer.type == "uvec2" ? "xy" : "xyzw";
    return "GN_READ_AS(" + std::to_string(binding) + ", usamplerBuffer, " + buffer.stored + ", " + buffer.type + ", @, " +
           parts + ")\n";
}

std::string reads(uint32_t binding, const std::string& type, const std::string& name) {
    std::string macro = "READ_";
    for (const char c : type) macro += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return macro + "(" + std::to_string(binding) + ", " + name + ")\n";
}

// The number of the first element that is bound: a part of a band writes through bindings of its own.
std::string first_bound(const LayoutBuffer& buffer) {
    const std::string times = buffer.elements == 1 ? "" : " * " + std::to_string(buffer.elements) + "u";
    switch (buffer.per) {
        case LayoutBuffer::Per::list:
            return "part_first_tile() * kTileTexels" + times;
        case LayoutBuffer::Per::size:
            return "params.place_first[" + std::to_string(buffer.size) + "]" + times;
        default:
            return "0u";
    }
}

constexpr const char* kAtomics[] = {"Add", "Min", "Max", "And", "Or", "Exchange"};

std::string atomic_name(const std::string& operation) {
    std::string name = operation;
    name[0] = static_cast<char>(name[0] - 'A' + 'a');
    return name + "_@";
}

// What checks accesses, in stages that see buffers.
constexpr const char* kChecks = R"(#if defined(LAYOUT_WRITE) || defined(LAYOUT_READ)
#define LAYOUT_CHECKED
layout(binding = 18, scalar) buffer LayoutFaults { uvec2 layout_faults[]; };  // Of each buffer, and of walks: how often, the index of one.
void count_fault(uint number, uint i) {
    if (atomicAdd(layout_faults[number].x, 1u) == 0u) layout_faults[number].y = i;
}
uint checked_place(uint number, uint place, uint count, uint i) {
    if (place >= count) count_fault(number, i);
    return place < count ? place : 0u;
}
#endif
)";

// What counts accesses. Hits of a group are those that a device with subgroups of 32 tests in one.
constexpr const char* kCounts = R"(#ifdef LAYOUT_READ
#define LAYOUT_NOTED
layout(binding = 18, scalar) buffer LayoutReads { ReadsHead reads_head; LayoutRead layout_reads[]; };
bool read_is_kept = false;
uint reading_hit = 0u, read_when = 0u;
void note_read(uint what, uint i) {
    if (read_is_kept) {
        uint at = atomicAdd(reads_head.count, 1u);
        if (at < reads_head.most) layout_reads[at] = LayoutRead(reading_hit, read_when, what, i);
    }
}
#endif
#ifdef LAYOUT_WRITE
layout(binding = 19, scalar) buffer LayoutAtomics { uint layout_atomics[]; };  // Where each one's counts begin, then these: of each element.
void count_atomic(uint number, uint i) { atomicAdd(layout_atomics[layout_atomics[number] + i], 1u); }
#endif
)";

// What is read through fetch_@ is noted.
std::string noted(size_t number, const std::string& type, const std::string& name) {
    return named("#ifdef LAYOUT_NOTED\n" + type + " noted_@(uint i) {\n    note_read(" + std::to_string(number) +
                     "u, i);\n    return fetch_@(i);\n}\n#define fetch_@(i) noted_@(i)\n#endif\n",
                 name);
}

// The place of element i, if it is one of so many; else the first.
std::string checked_place(size_t number, const std::string& place, const std::string& count) {
    return "checked_place(" + std::to_string(number) + "u, " + place + ", " + count + ", i)";
}

std::string write_accessors(const Layout& layout, size_t number, uint32_t binding) {
    const LayoutBuffer& buffer = layout.buffers[number];
    const bool same = buffer.stored == buffer.type;
    const std::string relative = "i - " + first_bound(buffer), type = buffer.type;
    const std::string checked = checked_place(number, relative, "uint(@_elements.length())");
    const std::string place = "@_elements[" + (layout.watch == Layout::Watch::faults ? checked : relative) + "]";
    const std::string counted =
        layout.watch == Layout::Watch::accesses ? "count_atomic(" + std::to_string(number) + "u, i); " : "";
    std::string text = "layout(binding = " + std::to_string(binding) + ", scalar) buffer " + written_name(buffer) + " { " +
                       buffer.stored + " @_elements[]; };\n" + type + " fetch_@(uint i) { return " +
                       (same ? place : type + "(" + place + ")") + "; }\n" + "void set_@(uint i, " + type + " value) { " +
                       place + " = " + (same ? "value" : buffer.stored + "(value)") + "; }\n";
    if (buffer.has_atomics()) {
        for (const char* operation : kAtomics)
            text += "uint " + atomic_name(operation) + "(uint i, uint value) { " + counted + "return atomic" + operation + "(" +
                    place + ", value); }\n";
        text += "uint compare_exchange_@(uint i, uint expected, uint value) { " + counted + "return atomicCompSwap(" + place +
                ", expected, value); }\n";
    }
    return text;
}

// Only what is bound as a whole knows its length everywhere.
std::string length_accessor(const LayoutBuffer& buffer, const std::string& length) {
    return buffer.per == LayoutBuffer::Per::band ? "uint length_@() { return " + length + "; }\n" : "";
}

// In stages that do not write.
std::string no_writes(const LayoutBuffer& buffer) {
    std::string text = "#define set_@(i, value)\n";
    if (buffer.has_atomics()) {
        for (const char* operation : kAtomics) text += "#define " + atomic_name(operation) + "(i, value) 0u\n";
        text += "#define compare_exchange_@(i, expected, value) 0u\n";
    }
    return text;
}

std::string read_accessors(const Layout& layout, size_t number, uint32_t binding) {
    const LayoutBuffer& buffer = layout.buffers[number];
    const std::string& type = buffer.type;
    const std::string text = buffer.stored == type ? reads(binding, type, "@") : stored_reads(binding, buffer);
    if (layout.watch == Layout::Watch::accesses) return text + noted(number, type, "@");
    if (layout.watch == Layout::Watch::nothing) return text;
    return text + type + " checked_fetch_@(uint i) { return fetch_@(" + checked_place(number, "i", "READ_COUNT(@)") +
           "); }\n#define fetch_@(i) checked_fetch_@(i)\n";
}

std::string buffer_text(const Layout& layout, size_t number, uint32_t binding) {
    const LayoutBuffer& buffer = layout.buffers[number];
    const std::string exists = buffer.exit_only ? " && defined(GN_RANGE_EXIT)" : "";
    return named("#if defined(LAYOUT_WRITE)" + exists + "\n" + write_accessors(layout, number, binding) +
                     length_accessor(buffer, "uint(@_elements.length())") + "#elif defined(LAYOUT_READ)" + exists + "\n" +
                     read_accessors(layout, number, binding) + length_accessor(buffer, "READ_COUNT(@)") + no_writes(buffer) +
                     "#else\n" + buffer.type + " fetch_@(uint i) { return " + buffer.type + "(0); }\n" +
                     length_accessor(buffer, "1u") + no_writes(buffer) + "#endif\n",
                 buffer.name);
}

std::string size_text(const Layout& layout, size_t index, uint32_t binding) {
    const LayoutSize& size = layout.sizes[index];
    const bool counts = layout.watch == Layout::Watch::accesses;
    const size_t number = layout.buffers.size() + index;
    const bool of_tiles = size.per == LayoutSize::Per::tile;
    const std::string of = of_tiles ? "Tile of" : "List of";
    const std::string read = "#if defined(LAYOUT_WRITE) || defined(LAYOUT_READ)\n" + reads(binding, "uint", read_name(size)) +
                             (counts ? noted(number, "uint", read_name(size)) : "");
    const std::string nothing = "#else\n";
    switch (size.as) {
        case LayoutSize::As::values:
            return named(read + "uint size_@(" + of + ") { return fetch_size_of_@(of.index); }\n" + nothing +
                             "#define size_@(of) 0u\n#endif\n",
                         size.name);
        case LayoutSize::As::offsets:
            return named(read + "uint first_@(" + of + ") { return fetch_offsets_of_@(of.index); }\n" + "uint end_@(" + of +
                             ") { return fetch_offsets_of_@(of.index + 1u); }\n" + nothing +
                             "#define first_@(of) 0u\n#define end_@(of) 0u\n#endif\n",
                         size.name);
        case LayoutSize::As::allocated: {
            const std::string counter = "layout_counters[" + std::to_string(index) + "]";
            const std::string counted = counts ? "count_atomic(" + std::to_string(number) + "u, 0u); " : "";
            return named("#ifdef LAYOUT_WRITE\nuint allocate_@(uint n) { " + counted + "return atomicAdd(" + counter +
                             ", n); }\n#else\n#define allocate_@(n) 0u\n#endif\n",
                         size.name);
        }
        default:
            return "";
    }
}

// For sbuffer/size: each size that the layout computes, with its index.
std::string size_lists(const Layout& layout) {
    std::string lists, tiles;
    for (size_t i = 1; i < layout.sizes.size(); ++i) {
        if (layout.sizes[i].listed) continue;
        const std::string entry = " VISIT(" + layout.sizes[i].name + ", " + std::to_string(i) + "u)";
        (layout.sizes[i].per == LayoutSize::Per::tile ? tiles : lists) += entry;
    }
    return "#define LAYOUT_LIST_SIZES" + lists + "\n#define LAYOUT_TILE_SIZES" + tiles + "\n";
}

std::string of_tiles(const std::string& macro, Layout::Pass pass) {
    return "#define " + macro + (pass == Layout::Pass::tile ? " 1\n" : " 0\n");
}

}  // namespace

std::string written_name(const LayoutBuffer& buffer) { return "Written_" + buffer.name; }

std::string read_name(const LayoutSize& size) {
    return (size.as == LayoutSize::As::values ? "size_of_" : "offsets_of_") + size.name;
}

std::string layout_interface(const Layout& layout) {
    std::string text = "// From layout.json.\n#define Iterator " + layout.iterator + "\n";
    text += "#ifdef LAYOUT_WRITE\n// What one dispatch writes is a part of the band.\n";
    text += "uint part_first_tile() { return params.item_first - params.band_first; }\n#endif\n";
    for (const char* bits : {"8", "16"}) {
        const auto small = [&](const LayoutBuffer& buffer) { return std::to_string(component_bits(buffer)) == bits; };
        if (std::any_of(layout.buffers.begin(), layout.buffers.end(), small))
            text += std::string("#extension GL_EXT_shader_") + bits + "bit_storage : require\n";
    }
    if (layout.keeps_counts()) text += "#define LAYOUT_COUNTS\n";
    if (layout.watch == Layout::Watch::faults)
        text += kChecks + ("const uint kWalks = " + std::to_string(layout.buffers.size()) + "u;\n");
    if (layout.watch == Layout::Watch::accesses) text += kCounts;
    text += of_tiles("LAYOUT_PREPARES_TILES", layout.prepare) + of_tiles("LAYOUT_FINISHES_TILES", layout.finish);
    if (layout.morton) text += "#define LAYOUT_MORTON\n";
    for (const auto& [name, value] : layout.constants) text += "const uint " + name + " = " + std::to_string(value) + "u;\n";
    if (layout.counts_up())
        text +=
            "#ifdef LAYOUT_WRITE\nlayout(binding = 17, scalar) buffer LayoutCounters { uint layout_counters[]; };\n#endif\n";
    for (size_t i = 0; i < layout.sizes.size(); ++i) text += size_text(layout, i, kSizesBinding + static_cast<uint32_t>(i));
    for (size_t i = 0; i < layout.counters.size(); ++i) {
        const std::string counter = "layout_counters[kMostSizes + " + std::to_string(i) + "u]";
        const std::string counted =
            layout.watch == Layout::Watch::accesses
                ? "count_atomic(" + std::to_string(layout.buffers.size() + layout.sizes.size() + i) + "u, 0u); "
                : "";
        text += named("#ifdef LAYOUT_WRITE\nvoid count_@(uint n) { " + counted + "atomicAdd(" + counter +
                          ", n); }\n#else\n#define count_@(n)\n#endif\n",
                      layout.counters[i]);
    }
    for (size_t i = 0; i < layout.buffers.size(); ++i)
        text += buffer_text(layout, i, kBuffersBinding + static_cast<uint32_t>(i));
    return text + size_lists(layout);
}

}  // namespace gnomon
