// SPDX-License-Identifier: Apache-2.0
// The compiled stages, by name, made on first use.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "gpu/gpu.hpp"

namespace gnomon {

/// SPIR-V embedded at build time under a stage's name: "sample/trace", or "sample/shadow@array" where the stage depends on the
/// layout; with "+storage" behind it, the variant whose read-only data are storage buffers. Errors: ErrorKind::internal if
/// there is none.
gpu::Shader find_shader(const std::string& name);
bool has_shader(const std::string& name);

class Programs {
public:
    explicit Programs(gpu::Device& device) : device_(device) {}

    /// A stage that is not embedded, or another version of one that was added before. source: what it was compiled from.
    void add(const std::string& name, std::vector<uint32_t> spirv, std::string source = {});
    /// The stage was added, and compiled from this.
    bool has(const std::string& name, const std::string& source) const;

    /// Of a stage that was added.
    std::span<const uint32_t> spirv(const std::string& name) const { return added_.at(name).spirv; }

    /// The stage specialised with constant_id 0, 1, ... = constants. Valid as long as this object, or until the stage is added
    /// anew.
    const gpu::Program& get(const std::string& name, const std::vector<uint32_t>& constants = {});

    /// The specialization constant of stages whose invocations work in crews (common/crew.glsl).
    uint32_t crew() const { return device_.limits().crew; }

private:
    gpu::Device& device_;
    struct Added {
        std::vector<uint32_t> spirv;
        std::string source;
    };
    std::map<std::string, Added> added_;
    std::map<std::pair<std::string, std::vector<uint32_t>>, gpu::Program> programs_;
};

}  // namespace gnomon
