// SPDX-License-Identifier: Apache-2.0
// What a compute shader's SPIR-V declares: resources, push constants, specialization constants, local size.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/gpu.hpp"

namespace gnomon::gpu {

enum class ResourceKind { storage_buffer, uniform_buffer, float_texels, uint_texels };

struct Resource {
    std::string name;  ///< The block's type name; for texel buffers the variable's name.
    ResourceKind kind = ResourceKind::storage_buffer;
    uint32_t binding = 0;    ///< In descriptor set 0.
    uint64_t min_bytes = 0;  ///< Of the block without a trailing unsized array; 0 for texel buffers.
    bool writable = false;   ///< A storage block that is not readonly as a whole.
};

struct Reflection {
    std::vector<Resource> resources;  ///< Names and binding numbers are unique.
    uint32_t push_constant_bytes = 0;
    std::array<uint32_t, 3> local_size{1, 1, 1};  ///< Invocations per workgroup, with the given constants.
    std::vector<uint32_t> capabilities;           ///< spv::Capability
    uint64_t local_bytes = 0;  ///< Of all variables of its functions, of an invocation and of a workgroup, without padding.
};

/// Errors (ErrorKind::internal, naming the shader): broken SPIR-V; an entry point other than one compute "main"; resources
/// other than storage buffers, uniform buffers and float or uint uniform texel buffers, all in set 0; a constant that the
/// shader does not have, that is given twice, or that is not of 32 bits.
Reflection reflect(const Shader& shader, std::span<const Constant> constants);

}  // namespace gnomon::gpu
