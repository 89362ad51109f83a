// SPDX-License-Identifier: Apache-2.0
// S-buffer layouts: a folder with layout.json and layout.glsl (docs/layouts.md). No C++ belongs to a layout.
#pragma once

#include "layouts/manifest.hpp"

namespace gnomon {

/// Names of the layouts that are built in.
std::vector<std::string> layout_names();

/// A built-in layout by its name, else the one in a folder: a path with a '/', or of a folder that exists.
/// Errors: ErrorKind::usage, naming those that exist; input, for a folder without layout.glsl and a layout.json that parses.
Layout find_layout(const std::string& name_or_folder);

/// The text of layout.json and layout.glsl.
struct LayoutFiles {
    std::string manifest, glsl;
};
/// Errors: as find_layout.
LayoutFiles layout_files(const std::string& name_or_folder);

/// Its stages were compiled with gnomon; all others are when they are needed (layouts/compile_layout.hpp).
bool is_compiled(const Layout& layout);

/// For ranges with a depth at their exit, or without.
Layout with_ranges(Layout layout, bool exit_depth);

}  // namespace gnomon
