// SPDX-License-Identifier: Apache-2.0
// S-buffer layouts: a folder with layout.glsl (count, emit, begin, next) and layout.json (its buffers). No C++ belongs to a
// layout.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/gpu.hpp"

namespace gnomon {

/// One buffer of a layout, as its manifest declares it.
struct LayoutBuffer {
    enum class Per { once, list, range };
    enum class Clear { no, value, range_first };

    std::string block = {};  ///< The storage block that writes it.
    std::string texel = {};  ///< The texel buffer that reads it; empty: not read by the shadow test.
    gpu::Texel format = gpu::Texel::r32_uint;
    uint32_t element_bytes = 4;
    Per per = Per::once;       ///< One element for the view, per list (texel and cell), or per range.
    bool exit_only = false;    ///< Only for methods whose ranges have a depth at their exit.
    bool scan = false;         ///< After the count pass: replaced by its exclusive prefix sum.
    std::string copy_of = {};  ///< After that: a copy of this buffer.
    Clear clear = Clear::no;   ///< Before the fill pass.
    uint32_t clear_value = 0;  ///< The bits of one component.
    size_t line = 0;           ///< Of the manifest.
};

struct Layout {
    std::string name;
    std::string summary;
    std::string source;  ///< Paper and section.
    bool lossless = true;
    std::vector<LayoutBuffer> buffers;
    std::filesystem::path folder;  ///< Absolute; empty: built in.

    /// The name among the programs of a stage compiled for this layout.
    std::string stage(const std::string& name_without) const;
};

bool is_float(gpu::Texel format);

/// Names of the layouts that are built in.
std::vector<std::string> layout_names();

/// A built-in layout by its name, else the one in a folder: a path with a '/', or of a folder that exists.
/// Errors: ErrorKind::usage, naming those that exist; input, for a folder without layout.glsl and a layout.json that parses.
Layout find_layout(const std::string& name_or_folder);

/// Without the buffers that only an exit depth needs, where there is none.
Layout with_ranges(Layout layout, bool exit_depth);

/// Parse a manifest. Errors: ErrorKind::input naming `where`, the line and the member.
Layout parse_layout(std::string_view json, const std::string& where);

}  // namespace gnomon
