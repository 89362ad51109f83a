// SPDX-License-Identifier: Apache-2.0
#include "stages/layout_stages.hpp"

#include <filesystem>
#include <gnomon/error.hpp>
#include <optional>

#include "gpu/reflection.hpp"
#include "layouts/compile_layout.hpp"
#include "text/read_text.hpp"

namespace gnomon {
namespace {

// What a stage binds with any layout; of those that only some layouts go through, what sbuffer/size does.
std::set<std::string> bound_by(const std::string& stage) {
    std::set<std::string> names = {"counts", "Sizes", "SizeTotals"};
    const std::string compiled = stage + "@array";
    if (!has_shader(compiled)) return names;
    for (const gpu::Resource& resource : gpu::reflect(find_shader(compiled), {}).resources) names.insert(resource.name);
    return names;
}

// All that a folder's layout is compiled from; nothing, where that is too much to keep.
std::optional<std::string> source_of(const std::filesystem::path& folder) {
    constexpr size_t kMostBytes = size_t{4} << 20, kMostFiles = 256;
    std::string source, reason;
    size_t files = 0;
    std::error_code error;
    std::filesystem::recursive_directory_iterator entry(folder, error), end;
    for (; !error && entry != end; entry.increment(error)) {
        if (!entry->is_regular_file(error)) continue;
        const std::optional<std::string> text = read_text(entry->path(), reason);
        if (!text || ++files > kMostFiles || text->size() > kMostBytes - source.size()) return std::nullopt;
        source += entry->path().string() + '\0' + *text;
        if (source.size() > kMostBytes) return std::nullopt;
    }
    return error ? std::nullopt : std::optional(std::move(source));
}

void check_elements(const gpu::Limits& limits, const Layout& layout) {
    for (const LayoutBuffer& buffer : layout.buffers) {
        const uint32_t bits = component_bits(buffer);
        if (bits == 32 || (bits == 16 ? limits.storage_16bit : limits.storage_8bit)) continue;
        throw Error(ErrorKind::usage,
                    "layout '" + layout.name + "' has elements of " + std::to_string(bits) + " bits in its buffer '" +
                        buffer.name + "', which this device cannot store",
                    "--layout", "use another layout, or another --device");
    }
}

}  // namespace

std::vector<std::string> s_buffer_stages(const Layout& layout) {
    std::vector<std::string> stages;
    const std::string exits = layout.exit_depth ? "_exits" : "";
    if (layout.sizes.size() > 1) stages.emplace_back("sbuffer/size");
    if (layout.prepare != Layout::Pass::none) stages.push_back("sbuffer/prepare" + exits);
    if (layout.finish != Layout::Pass::none) stages.push_back("sbuffer/finish" + exits);
    return stages;
}

void add_layout_stages(gpu::Device& device, Programs& programs, const Layout& layout, const std::vector<std::string>& stages) {
    if (is_compiled(layout)) return;
    check_elements(device.limits(), layout);
    std::vector<std::string> all = s_buffer_stages(layout);
    all.insert(all.end(), stages.begin(), stages.end());
    const std::optional<std::string> source = layout.folder.empty() ? std::string() : source_of(layout.folder);
    for (const std::string& stage : all) {
        const std::string name = layout.stage(stage);
        // What lies in a folder may be another by now. To compile takes longer than many a frame.
        if (source && programs.has(name, *source)) continue;
        programs.add(name, compile_stage(stage, layout, device.limits().storage_reads(), bound_by(stage)), source.value_or(""));
    }
}

}  // namespace gnomon
