// SPDX-License-Identifier: Apache-2.0
#include "pipeline/programs.hpp"

#include <gnomon/error.hpp>

#include "shader_table.h"

namespace gnomon {

gpu::Shader find_shader(const std::string& name) {
    for (const auto& entry : kShaderTable) {
        if (name == entry.name) return {name, {entry.words, entry.word_count}};
    }
    throw Error(ErrorKind::internal, "no such stage", name, "report this as a bug");
}

const gpu::Program& Programs::get(const std::string& name, std::initializer_list<uint32_t> constants) {
    auto key = std::make_pair(name, std::vector<uint32_t>(constants));
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        std::vector<gpu::Constant> values;
        for (uint32_t value : constants) values.push_back({static_cast<uint32_t>(values.size()), value});
        found = programs_.emplace(key, device_.program(find_shader(name), values)).first;
    }
    return found->second;
}

}  // namespace gnomon
