// SPDX-License-Identifier: Apache-2.0
// Compute pipelines from SPIR-V and its reflection.
#include <algorithm>
#include <array>
#include <cstddef>

#include "gpu/descriptors.hpp"
#include "gpu/spirv_rewrite.hpp"

namespace gnomon::gpu {
namespace {

void check_at_most(uint64_t count, uint64_t limit, const std::string& what, const std::string& shader) {
    if (count <= limit) return;
    throw Error(ErrorKind::no_device, std::to_string(count) + " " + what + ", the device allows " + std::to_string(limit),
                "shader " + shader, "use another --device");
}

uint64_t invocations(const Reflection& reflection) {
    return uint64_t{reflection.local_size[0]} * reflection.local_size[1] * reflection.local_size[2];
}

void check_limits(const Reflection& reflection, const Device::Impl& device, const std::string& shader) {
    const VkPhysicalDeviceLimits& limits = device.vulkan_limits;
    std::array<uint64_t, 3> counts{};  // storage buffers, uniform buffers, texel buffers
    for (const Resource& resource : reflection.resources) ++counts[std::min<size_t>(static_cast<size_t>(resource.kind), 2)];
    check_at_most(counts[0], device.limits.storage_buffers, "storage buffers", shader);
    check_at_most(counts[1], limits.maxPerStageDescriptorUniformBuffers, "uniform buffers", shader);
    check_at_most(counts[2], limits.maxPerStageDescriptorSampledImages, "texel buffers", shader);
    check_at_most(reflection.push_constant_bytes, device.limits.push_constant_bytes, "bytes of push constants", shader);
    for (size_t axis = 0; axis < 3; ++axis) {
        check_at_most(reflection.local_size[axis], limits.maxComputeWorkGroupSize[axis], "invocations along one axis", shader);
    }
    check_at_most(invocations(reflection), limits.maxComputeWorkGroupInvocations, "invocations in a workgroup", shader);
}

OwnedSetLayout create_set_layout(VkDevice device, const Reflection& reflection, const std::string& where) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const Resource& resource : reflection.resources) {
        bindings.push_back({.binding = resource.binding,
                            .descriptorType = descriptor_type(resource.kind),
                            .descriptorCount = 1,
                            .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT});
    }
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .bindingCount = static_cast<uint32_t>(bindings.size()),
                                               .pBindings = bindings.data()};
    return create<OwnedSetLayout>(device, vkCreateDescriptorSetLayout, info, "a descriptor set layout", where);
}

OwnedPipelineLayout create_layout(VkDevice device, VkDescriptorSetLayout set_layout, uint32_t push_bytes,
                                  const std::string& where) {
    const VkPushConstantRange push{.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .size = push_bytes};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &set_layout,
                                          .pushConstantRangeCount = push_bytes > 0 ? 1u : 0u,
                                          .pPushConstantRanges = &push};
    return create<OwnedPipelineLayout>(device, vkCreatePipelineLayout, info, "a pipeline layout", where);
}

OwnedPipeline create_pipeline(const Device::Impl& owner, VkPipelineLayout layout, const Shader& shader,
                              std::span<const Constant> constants, const Reflection& reflection, const std::string& where) {
    const VkDevice device = owner.device.get();
    const SubgroupSize& subgroup = owner.candidate.subgroup;
    const bool required =
        subgroup.required && invocations(reflection) <= uint64_t{subgroup.size} * owner.candidate.max_workgroup_subgroups;
    const VkPipelineShaderStageRequiredSubgroupSizeCreateInfo size_info{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO,
        .requiredSubgroupSize = subgroup.size};
    // The workgroup's row is whole subgroups, and the device is to make it so.
    const bool full_subgroups = reflection.local_size[0] % (required ? subgroup.size : subgroup.most) == 0;
    const VkShaderModuleCreateInfo module_info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                               .codeSize = shader.spirv.size_bytes(),
                                               .pCode = shader.spirv.data()};
    const auto module = create<OwnedShaderModule>(device, vkCreateShaderModule, module_info, "a shader module", where);
    std::vector<VkSpecializationMapEntry> entries;
    for (size_t i = 0; i < constants.size(); ++i) {
        entries.push_back({.constantID = constants[i].id,
                           .offset = static_cast<uint32_t>(i * sizeof(Constant) + offsetof(Constant, value)),
                           .size = sizeof(uint32_t)});
    }
    const VkSpecializationInfo specialization{.mapEntryCount = static_cast<uint32_t>(entries.size()),
                                              .pMapEntries = entries.data(),
                                              .dataSize = constants.size_bytes(),
                                              .pData = constants.data()};
    const VkComputePipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .flags = VK_PIPELINE_CREATE_DISPATCH_BASE,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .pNext = required ? &size_info : nullptr,
                  .flags = full_subgroups
                               ? VkPipelineShaderStageCreateFlags{VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT}
                               : 0,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module.get(),
                  .pName = "main",
                  .pSpecializationInfo = &specialization},
        .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "create a pipeline", where);
    return OwnedPipeline(device, pipeline);
}

}  // namespace

Program::Program() = default;
Program::~Program() = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;

Program Device::program(const Shader& shader, std::span<const Constant> constants) {
    const std::string where = "shader " + shader.name;
    Program program;
    program.impl_ = std::make_shared<Program::Impl>();
    Program::Impl& made = *program.impl_;
    made.device = impl_;
    made.name = shader.name;
    made.key = shader.name;
    for (const Constant& c : constants) made.key += " " + std::to_string(c.id) + "=" + std::to_string(c.value);
    made.reflection = reflect(shader, constants);
    check_limits(made.reflection, *impl_, shader.name);
    const VkDevice device = impl_->device.get();
    made.set_layout = create_set_layout(device, made.reflection, where);
    made.layout = create_layout(device, made.set_layout.get(), made.reflection.push_constant_bytes, where);
    const std::vector<uint32_t> spirv = rewrite_spirv(shader, impl_->candidate.uniform_control_flow);
    made.pipeline = create_pipeline(*impl_, made.layout.get(), {shader.name, spirv}, constants, made.reflection, where);
    impl_->set_object_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(made.pipeline.get()), shader.name);
    return program;
}

}  // namespace gnomon::gpu
