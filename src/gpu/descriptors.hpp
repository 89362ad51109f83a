// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: descriptor sets that live until the recorder's work is done.
#pragma once

#include "gpu/vulkan.hpp"

namespace gnomon::gpu {

/// What one resource of a shader is bound to: a range of a buffer, or a view of one.
struct Descriptor {
    const Resource* resource = nullptr;
    const Buffer::Impl* owner = nullptr;
    uint64_t offset = 0;
    uint64_t bytes = 0;
    VkDescriptorBufferInfo buffer{};
    VkBufferView view = VK_NULL_HANDLE;
};

VkDescriptorType descriptor_type(ResourceKind kind);

/// Grows by pools. Any number of sets.
class DescriptorSets {
public:
    explicit DescriptorSets(const Device::Impl& device) : device_(device.device.get()) {}

    VkDescriptorSet make(VkDescriptorSetLayout layout, const std::vector<Descriptor>& descriptors);
    void reset();  ///< All sets are gone; the pools stay.

private:
    VkDescriptorSet allocate(VkDescriptorSetLayout layout);
    OwnedDescriptorPool make_pool() const;

    VkDevice device_;
    std::vector<OwnedDescriptorPool> pools_;
    size_t current_ = 0;
};

}  // namespace gnomon::gpu
