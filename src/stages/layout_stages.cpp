// SPDX-License-Identifier: Apache-2.0
#include "stages/layout_stages.hpp"

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
    for (const std::string& stage : all) {
        const std::string name = layout.stage(stage);
        // What lies in a folder may be another by now.
        if (!layout.folder.empty() || !programs.has(name))
            programs.add(name, compile_stage(stage, layout, device.limits().storage_reads(), bound_by(stage)));
    }
}

}  // namespace gnomon
