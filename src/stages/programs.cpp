// SPDX-License-Identifier: Apache-2.0
#include "stages/programs.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "shader_table.h"
#include "shared/params.h"

namespace gnomon {

bool has_shader(const std::string& name) {
    const auto named = [&](const ShaderEntry& entry) { return name == entry.name; };
    return std::any_of(std::begin(kShaderTable), std::end(kShaderTable), named);
}

gpu::Shader find_shader(const std::string& name) {
    for (const auto& entry : kShaderTable) {
        if (name == entry.name) return {name, {entry.words, entry.word_count}};
    }
    throw Error(ErrorKind::internal, "no such stage", name, "report this as a bug");
}

bool Programs::has(const std::string& name, const std::string& source) const {
    const auto found = added_.find(name);
    return found != added_.end() && found->second.source == source;
}

void Programs::add(const std::string& name, std::vector<uint32_t> spirv, std::string source) {
    Added& known = added_[name];
    known.source = std::move(source);
    if (known.spirv == spirv) return;
    known.spirv = std::move(spirv);
    std::erase_if(programs_, [&](const auto& program) { return program.first.first == name; });
}

const gpu::Program& Programs::get(const std::string& name, const std::vector<uint32_t>& constants) {
    auto key = std::make_pair(name, constants);
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        std::vector<gpu::Constant> values;
        for (uint32_t value : constants) values.push_back({static_cast<uint32_t>(values.size()), value});
        values.push_back({shared::kThreadsConstant, device_.limits().threads});
        auto added = added_.find(name);
        const char* variant = device_.limits().storage_reads() ? "+storage" : "";
        gpu::Shader shader = added == added_.end() ? find_shader(name + variant) : gpu::Shader{name, added->second.spirv};
        found = programs_.emplace(key, device_.program(shader, values)).first;
    }
    return found->second;
}

}  // namespace gnomon
