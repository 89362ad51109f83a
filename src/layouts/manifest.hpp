// SPDX-License-Identifier: Apache-2.0
// What a layout's manifest, layout.json, says: the sizes of its lists, its buffers and its passes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/gpu.hpp"
#include "layouts/length.hpp"

namespace gnomon {

/// What a list or a tile takes of something. The first of a layout is always "ranges", the number of a list's ranges, which is
/// counted; "triangles" are listed; the others its layout_size_<name> computes.
struct LayoutSize {
    enum class Per { list, tile };
    enum class As {
        total,      ///< Only the sum over a band is known.
        values,     ///< size_<name>(list) gives it.
        offsets,    ///< Lists have places one behind the other, from first_<name>(list) to end_<name>(list).
        allocated,  ///< allocate_<name>(n) gives out the next n places.
    };

    std::string name;
    Per per = Per::list;
    As as = As::total;
    bool listed = false;  ///< "triangles", those of each tile's list: known before anything is counted.
    size_t line = 0;      ///< Of the manifest; likewise below.
};

struct LayoutBuffer {
    enum class Per {
        band,  ///< `length` elements.
        list,  ///< `elements` for each list,
        tile,  ///< each tile, or
        size,  ///< each place of a size.
    };

    std::string name;
    std::string type;    ///< Of an element, in GLSL.
    std::string stored;  ///< The same, or, of components of 8 or 16 bits, what is in memory: "u8vec2" for uvec2.
    gpu::Texel format = gpu::Texel::r32_uint;
    uint32_t element_bytes = 4;
    Per per = Per::band;
    size_t size = 0;  ///< Index of the size.
    uint32_t elements = 1;
    Length length;
    bool exit_only = false;           ///< Only for methods whose ranges have a depth at their exit.
    std::optional<uint32_t> initial;  ///< The bits of each component before the fill; without, they may be anything.
    size_t line = 0;

    bool has_atomics() const { return stored == "uint"; }
};

constexpr uint32_t kPoison = 0xcdcdcdcd;

struct Layout {
    enum class Pass { none, list, tile };

    std::string name;
    std::string summary;
    std::string source;  ///< Paper and section.
    bool lossless = true;
    bool bands = true;    ///< Any run of tiles can be in memory alone.
    bool morton = false;  ///< Texels of a tile in Morton order; else in rows.
    std::string iterator = "uvec2";
    std::vector<std::pair<std::string, uint32_t>> constants;
    std::vector<LayoutSize> sizes = {LayoutSize{"ranges", {}, {}, 0}};
    std::vector<LayoutBuffer> buffers;
    std::vector<std::string> counters;
    Pass prepare = Pass::none;
    Pass finish = Pass::none;
    std::filesystem::path folder;  ///< Absolute; empty: built in.
    bool exit_depth = false;       ///< Its ranges have a depth at their exit: the method's wish, not the manifest's.

    /// What is watched while it is used, as somebody wishes: faults, or what is accessed. What it does not initialise then
    /// holds kPoison.
    enum class Watch { nothing, faults, accesses } watch = Watch::nothing;

    /// The name among the programs of a stage compiled for this layout.
    std::string stage(const std::string& name_without) const;
    /// Counts of single lists are kept: a size needs them.
    bool keeps_counts() const;
    /// What it gives contains the ranges, but may be longer and nearer; nothing is lost.
    bool only_contains() const { return !lossless && counters.empty(); }
    /// The buffer exists, for such ranges.
    bool has(const LayoutBuffer& buffer) const { return exit_depth || !buffer.exit_only; }
    /// It numbers the triangles of a tile's list, which only raster/conservative does.
    bool lists_triangles() const;
    /// Places or counters are given out by atomics.
    bool counts_up() const;
};

bool is_float(gpu::Texel format);

/// Bits of a component of an element: 8, 16 or 32.
uint32_t component_bits(const LayoutBuffer& buffer);

/// Parse a manifest. Errors: ErrorKind::input naming `where`, the line and the member.
Layout parse_layout(std::string_view json, const std::string& where);

}  // namespace gnomon
