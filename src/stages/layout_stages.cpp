// SPDX-License-Identifier: Apache-2.0
#include "stages/layout_stages.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <tuple>

#include "gpu/reflection.hpp"
#include "layouts/compile_layout.hpp"

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

// All that a folder's layout is compiled from, which stays where it is; empty where that is too much to compare.
std::string content_of(const std::filesystem::path& folder) {
    constexpr size_t kMostBytes = size_t{4} << 20, kMostFiles = 256;
    std::string content;
    size_t files = 0;
    std::error_code error;
    std::filesystem::recursive_directory_iterator entry(folder, error), end;
    for (; !error && entry != end; entry.increment(error)) {
        if (!entry->is_regular_file(error)) continue;
        std::error_code unknown;
        if (++files > kMostFiles || entry->file_size(unknown) > kMostBytes - content.size()) return "";
        std::ifstream file(entry->path(), std::ios::binary);
        content += entry->path().string() + '\0';
        content.append(std::istreambuf_iterator<char>(file), {});
        if (!file || content.size() > kMostBytes) return "";
    }
    return error ? "" : content;
}

// As compile_stage, of a folder's layout. What was compiled of the same content is taken again: to compile takes longer than
// many a frame.
std::vector<uint32_t> compile_again(const std::string& stage, const Layout& layout, bool storage_reads,
                                    const std::string& content) {
    if (content.empty()) return compile_stage(stage, layout, storage_reads, bound_by(stage));
    struct Compiled {
        std::string content;
        std::vector<uint32_t> spirv;
    };
    static std::mutex mutex;
    static std::map<std::tuple<std::string, bool, bool>, Compiled> all;
    const std::tuple key(layout.stage(stage), layout.exit_depth, storage_reads);
    {
        const std::lock_guard lock(mutex);
        const auto found = all.find(key);
        if (found != all.end() && found->second.content == content) return found->second.spirv;
    }
    std::vector<uint32_t> spirv = compile_stage(stage, layout, storage_reads, bound_by(stage));
    const std::lock_guard lock(mutex);
    all[key] = {content, spirv};
    return spirv;
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
    std::vector<std::string> all = s_buffer_stages(layout);
    all.insert(all.end(), stages.begin(), stages.end());
    const bool storage_reads = device.limits().storage_reads();
    const std::string content = layout.folder.empty() ? "" : content_of(layout.folder);
    for (const std::string& stage : all) {
        const std::string name = layout.stage(stage);
        if (!layout.folder.empty()) {  // What lies there may be another by now.
            programs.add(name, compile_again(stage, layout, storage_reads, content));
        } else if (!programs.has(name)) {
            programs.add(name, compile_stage(stage, layout, storage_reads, bound_by(stage)));
        }
    }
}

}  // namespace gnomon
