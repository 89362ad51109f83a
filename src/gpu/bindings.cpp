// SPDX-License-Identifier: Apache-2.0
// The checks that stand between a stage and a driver that would crash or read zeros.
#include "gpu/bindings.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon::gpu {

void fail_stage(std::string_view stage, const std::string& what) {
    throw Error(ErrorKind::internal, what, "stage " + std::string(stage), "fix the code that records it");
}

uint64_t checked_range(std::string_view stage, const std::string& name, uint64_t offset, uint64_t bytes, uint64_t end,
                       uint64_t alignment) {
    if (offset % alignment != 0) {
        fail_stage(stage,
                   "offset " + std::to_string(offset) + " of " + name + " is not a multiple of " + std::to_string(alignment));
    }
    if (offset > end || bytes > end - offset || (bytes == 0 && offset == end)) {
        fail_stage(stage, std::to_string(bytes) + " bytes at " + std::to_string(offset) + " of " + name + " pass the end at " +
                              std::to_string(end));
    }
    return bytes == 0 ? end - offset : bytes;
}

Buffer::Impl& checked_buffer(std::string_view stage, const Device::Impl& device, const Buffer& buffer, std::string_view name) {
    if (!buffer) fail_stage(stage, std::string(name) + " is an empty buffer");
    if (buffer.impl()->device.get() != &device) fail_stage(stage, std::string(name) + " is a buffer of another device");
    return *buffer.impl();
}

const std::shared_ptr<Buffer::Impl>& checked_transfer(const Device::Impl& device, const Buffer& buffer, uint64_t offset,
                                                      uint64_t bytes, const char* what) {
    const std::shared_ptr<Buffer::Impl>& impl = buffer.impl();
    const std::string hint = "fix the code that calls it";
    if (!impl) throw Error(ErrorKind::internal, std::string(what) + " of an empty buffer", "", hint);
    if (impl->device.get() != &device) {
        throw Error(ErrorKind::internal, std::string(what) + " on another device", "buffer " + impl->name, hint);
    }
    if (offset > impl->bytes || bytes > impl->bytes - offset) {
        throw Error(ErrorKind::internal,
                    std::string(what) + " of " + std::to_string(bytes) + " bytes at " + std::to_string(offset) +
                        " passes the end at " + std::to_string(impl->bytes),
                    "buffer " + impl->name, hint);
    }
    return impl;
}

Grid checked_arguments(std::string_view stage, std::span<const std::byte> arguments, uint64_t most_groups) {
    std::array<uint32_t, 3> groups{};
    std::memcpy(groups.data(), arguments.data(), sizeof(groups));
    const auto [x, y, z] = groups;
    if (z != 1 || uint64_t{x} * y > most_groups) {
        fail_stage(stage, "indirect arguments " + std::to_string(x) + " x " + std::to_string(y) + " x " + std::to_string(z) +
                              ", which should be at most " + std::to_string(most_groups) + " workgroups in x and y");
    }
    return {x, y};
}

namespace {

std::string in_quotes(std::string_view name) {
    std::string text = "'";
    text += name;
    text += "'";
    return text;
}

struct TexelFormat {
    VkFormat format;
    uint64_t bytes;
    ResourceKind kind;
};

TexelFormat texel_format(Texel texel) {
    switch (texel) {
        case Texel::r32_float:
            return {VK_FORMAT_R32_SFLOAT, 4, ResourceKind::float_texels};
        case Texel::rg32_float:
            return {VK_FORMAT_R32G32_SFLOAT, 8, ResourceKind::float_texels};
        case Texel::rgba32_float:
            return {VK_FORMAT_R32G32B32A32_SFLOAT, 16, ResourceKind::float_texels};
        case Texel::r32_uint:
            return {VK_FORMAT_R32_UINT, 4, ResourceKind::uint_texels};
        case Texel::rg32_uint:
            return {VK_FORMAT_R32G32_UINT, 8, ResourceKind::uint_texels};
        case Texel::rgba32_uint:
            return {VK_FORMAT_R32G32B32A32_UINT, 16, ResourceKind::uint_texels};
        case Texel::r16_uint:
            return {VK_FORMAT_R16_UINT, 2, ResourceKind::uint_texels};
        case Texel::rg16_uint:
            return {VK_FORMAT_R16G16_UINT, 4, ResourceKind::uint_texels};
        case Texel::rgba16_uint:
            return {VK_FORMAT_R16G16B16A16_UINT, 8, ResourceKind::uint_texels};
        case Texel::r8_uint:
            return {VK_FORMAT_R8_UINT, 1, ResourceKind::uint_texels};
        case Texel::rg8_uint:
            return {VK_FORMAT_R8G8_UINT, 2, ResourceKind::uint_texels};
        case Texel::rgba8_uint:
            return {VK_FORMAT_R8G8B8A8_UINT, 4, ResourceKind::uint_texels};
    }
    return {};  // all enumerators are above
}

Descriptor block_descriptor(std::string_view stage, const std::string& name, const Resource& resource, const Binding& binding,
                            const Buffer::Impl& buffer) {
    const Device::Impl& device = *buffer.device;
    const bool storage = resource.kind == ResourceKind::storage_buffer;
    const uint64_t alignment = storage ? device.limits.storage_alignment : device.vulkan_limits.minUniformBufferOffsetAlignment;
    const uint64_t limit = storage ? device.limits.max_storage_range : device.vulkan_limits.maxUniformBufferRange;
    const uint64_t bytes = checked_range(stage, name, binding.offset, binding.bytes, buffer.bytes, alignment);
    if (bytes > limit) {
        fail_stage(stage, name + " has " + std::to_string(bytes) + " bytes, the device binds at most " + std::to_string(limit) +
                              " (process it in bands)");
    }
    if (bytes < resource.min_bytes) {
        fail_stage(stage,
                   name + " has " + std::to_string(bytes) + " bytes, the shader's block " + std::to_string(resource.min_bytes));
    }
    return {.resource = &resource,
            .owner = &buffer,
            .offset = binding.offset,
            .bytes = bytes,
            .buffer = {buffer.memory.buffer.get(), binding.offset, bytes}};
}

Descriptor texel_descriptor(std::string_view stage, const std::string& name, const Resource& resource, const Binding& binding,
                            Buffer::Impl& buffer) {
    const TexelFormat format = texel_format(binding.texel);
    if (format.kind != resource.kind) {
        fail_stage(stage, name + " is a " + (resource.kind == ResourceKind::uint_texels ? "usamplerBuffer" : "samplerBuffer") +
                              ", which the binding's texel type does not fit");
    }
    const Limits& limits = buffer.device->limits;
    uint64_t bytes = checked_range(stage, name, binding.offset, binding.bytes, buffer.capacity, limits.texel_alignment);
    if (binding.bytes == 0) bytes -= bytes % format.bytes;
    if (bytes == 0 || bytes % format.bytes != 0) {
        fail_stage(stage,
                   std::to_string(bytes) + " bytes of " + name + " are not whole texels of " + std::to_string(format.bytes));
    }
    if (bytes / format.bytes > limits.max_texels) {
        fail_stage(stage, name + " has " + std::to_string(bytes / format.bytes) + " texels, the device binds at most " +
                              std::to_string(limits.max_texels) + " (process it in bands)");
    }
    return {.resource = &resource,
            .owner = &buffer,
            .offset = binding.offset,
            .bytes = bytes,
            .view = buffer.view(format.format, binding.offset, bytes)};
}

// Every resource once; the error names what is wrong.
const Resource& find_resource(std::string_view stage, const Reflection& reflection, std::span<const Binding> bindings,
                              size_t i) {
    for (size_t j = 0; j < i; ++j) {
        if (bindings[j].name == bindings[i].name) fail_stage(stage, in_quotes(bindings[i].name) + " is bound twice");
    }
    for (const Resource& resource : reflection.resources) {
        if (resource.name == bindings[i].name) return resource;
    }
    fail_stage(stage, "the shader has no resource " + in_quotes(bindings[i].name));
}

void check_all_bound(std::string_view stage, const Reflection& reflection, std::span<const Binding> bindings) {
    for (const Resource& resource : reflection.resources) {
        const bool bound = std::any_of(bindings.begin(), bindings.end(),
                                       [&](const Binding& binding) { return binding.name == resource.name; });
        if (!bound) fail_stage(stage, in_quotes(resource.name) + " is not bound");
    }
}

// A compiler may take two resources for different memory, and a load through one for independent of a store through the other.
void check_no_aliases(std::string_view stage, const std::vector<Descriptor>& descriptors) {
    for (size_t i = 0; i < descriptors.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
            const Descriptor& a = descriptors[j];
            const Descriptor& b = descriptors[i];
            const bool overlap = a.owner == b.owner && a.offset < b.offset + b.bytes && b.offset < a.offset + a.bytes;
            if (!overlap || !(a.resource->writable || b.resource->writable)) continue;
            fail_stage(stage, in_quotes(a.resource->name) + " and " + in_quotes(b.resource->name) + " are ranges of buffer " +
                                  a.owner->name + " that overlap, and " +
                                  in_quotes((a.resource->writable ? a : b).resource->name) + " may be written");
        }
    }
}

}  // namespace

std::vector<Descriptor> bind_resources(std::string_view stage, const Program::Impl& program,
                                       std::span<const Binding> bindings) {
    std::vector<Descriptor> descriptors;
    for (size_t i = 0; i < bindings.size(); ++i) {
        const Binding& binding = bindings[i];
        const Resource& resource = find_resource(stage, program.reflection, bindings, i);
        if (!binding.buffer) fail_stage(stage, in_quotes(resource.name) + " is bound to no buffer");
        Buffer::Impl& buffer = checked_buffer(stage, *program.device, *binding.buffer, in_quotes(resource.name));
        const std::string name = in_quotes(resource.name) + " (buffer " + buffer.name + ")";
        const bool block = resource.kind == ResourceKind::storage_buffer || resource.kind == ResourceKind::uniform_buffer;
        descriptors.push_back(block ? block_descriptor(stage, name, resource, binding, buffer)
                                    : texel_descriptor(stage, name, resource, binding, buffer));
    }
    check_all_bound(stage, program.reflection, bindings);
    check_no_aliases(stage, descriptors);
    return descriptors;
}

}  // namespace gnomon::gpu
