// SPDX-License-Identifier: Apache-2.0
#include "layouts/layout.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "layouts/sources.hpp"
#include "shader_table.h"
#include "text/read_text.hpp"

namespace gnomon {
namespace {

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

Layout built_in(const std::string& name) {
    const std::string manifest = "layouts/" + name + "/layout.json";
    const std::optional<std::string_view> text = find_source(manifest);
    if (!text) throw Error(ErrorKind::internal, "a layout has no manifest", manifest, "report this as a bug");
    return parse_layout(*text, manifest);
}

}  // namespace

std::vector<std::string> layout_names() {
    std::vector<std::string> names;
    for (const auto& entry : kLayoutTable) names.emplace_back(entry.name);
    return names;
}

Layout find_layout(const std::string& name_or_folder) {
    std::string known;
    for (const auto& entry : kLayoutTable) {
        if (name_or_folder == entry.name) return built_in(name_or_folder);
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    std::error_code ignored;
    if (name_or_folder.find('/') != std::string::npos || std::filesystem::is_directory(name_or_folder, ignored))
        return load_layout(name_or_folder);
    throw Error(ErrorKind::usage, "no S-buffer layout '" + name_or_folder + "'", "--layout",
                "use one of " + known + ", or a folder with layout.glsl and layout.json");
}

LayoutFiles layout_files(const std::string& name_or_folder) {
    const Layout layout = find_layout(name_or_folder);
    if (!layout.folder.empty()) return {read_part(layout.folder / "layout.json"), read_part(layout.folder / "layout.glsl")};
    const std::string folder = "layouts/" + layout.name + "/";
    return {std::string(find_source(folder + "layout.json").value()), std::string(find_source(folder + "layout.glsl").value())};
}

bool is_compiled(const Layout& layout) {
    const auto named = [&](const LayoutEntry& entry) { return entry.compiled && entry.name == layout.name; };
    return layout.folder.empty() && layout.watch == Layout::Watch::nothing &&
           std::any_of(std::begin(kLayoutTable), std::end(kLayoutTable), named);
}

Layout with_ranges(Layout layout, bool exit_depth) {
    layout.exit_depth = exit_depth;
    return layout;
}

}  // namespace gnomon
