// SPDX-License-Identifier: Apache-2.0
// Descriptor pools and sets.
#include "gpu/descriptors.hpp"

#include <array>

namespace gnomon::gpu {

VkDescriptorType descriptor_type(ResourceKind kind) {
    switch (kind) {
        case ResourceKind::storage_buffer:
            return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        case ResourceKind::uniform_buffer:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        default:
            return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    }
}

OwnedDescriptorPool DescriptorSets::make_pool() const {
    constexpr uint32_t kSets = 256;
    constexpr std::array<VkDescriptorPoolSize, 3> kSizes = {{
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8 * kSets},
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kSets},
        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 8 * kSets},
    }};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = kSets,
                                          .poolSizeCount = static_cast<uint32_t>(kSizes.size()),
                                          .pPoolSizes = kSizes.data()};
    return create<OwnedDescriptorPool>(device_, vkCreateDescriptorPool, info, "a descriptor pool");
}

VkDescriptorSet DescriptorSets::allocate(VkDescriptorSetLayout layout) {
    for (;; ++current_) {
        const bool fresh = current_ == pools_.size();
        if (fresh) pools_.push_back(make_pool());
        const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                               .descriptorPool = pools_[current_].get(),
                                               .descriptorSetCount = 1,
                                               .pSetLayouts = &layout};
        VkDescriptorSet set = VK_NULL_HANDLE;
        const VkResult result = vkAllocateDescriptorSets(device_, &info, &set);
        const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
        if (full && !fresh) continue;
        check(result, "allocate a descriptor set");
        return set;
    }
}

VkDescriptorSet DescriptorSets::make(VkDescriptorSetLayout layout, const std::vector<Descriptor>& descriptors) {
    const VkDescriptorSet set = allocate(layout);
    std::vector<VkWriteDescriptorSet> writes;
    for (const Descriptor& descriptor : descriptors) {
        writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                          .dstSet = set,
                          .dstBinding = descriptor.resource->binding,
                          .descriptorCount = 1,
                          .descriptorType = descriptor_type(descriptor.resource->kind),
                          .pBufferInfo = &descriptor.buffer,
                          .pTexelBufferView = &descriptor.view});
    }
    vkUpdateDescriptorSets(device_, static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
    return set;
}

void DescriptorSets::reset() {
    for (size_t i = 0; i < pools_.size() && i <= current_; ++i) {
        check(vkResetDescriptorPool(device_, pools_[i].get(), 0), "reset a descriptor pool");
    }
    current_ = 0;
}

}  // namespace gnomon::gpu
