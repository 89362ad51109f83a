// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: what every shader is to say of itself, put into its SPIR-V.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/gpu.hpp"

namespace gnomon::gpu {

/// The shader's SPIR-V in which every floating-point arithmetic instruction is decorated with NoContraction: else a
/// specialization constant or the expression around it may decide whether a product is fused with a sum, and two shaders differ
/// in the bits of what both compute. Instructions of GLSL.std.450 (mix, normalize) are not arithmetic instructions and stay as
/// they are. With `uniform_control_flow`, a shader with subgroup operations is declared to have SubgroupUniformControlFlowKHR
/// (SPV_KHR_subgroup_uniform_control_flow): a subgroup that enters a construct whole leaves it whole.
/// Doing it again changes nothing. Errors: ErrorKind::internal, naming the shader, for broken SPIR-V.
std::vector<uint32_t> rewrite_spirv(const Shader& shader, bool uniform_control_flow);

}  // namespace gnomon::gpu
