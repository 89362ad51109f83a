// SPDX-License-Identifier: Apache-2.0
// Device memory: allocation within a budget, texel views.
#include <algorithm>
#include <array>
#include <cstdio>

#include "gpu/vulkan.hpp"

namespace gnomon::gpu {
namespace {

constexpr uint64_t kGranularity = 16;  // bytes of the largest texel

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                      VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;

constexpr VkMemoryPropertyFlags kHostReadable =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

std::optional<uint32_t> find_memory_type(const VkPhysicalDeviceMemoryProperties& properties, uint32_t type_bits,
                                         VkMemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
        const bool allowed = (type_bits >> i) & 1u;
        if (allowed && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    }
    return std::nullopt;
}

Error memory_error(const Device::Impl& device, const std::string& name, uint64_t bytes, const std::string& why,
                   const std::string& hint) {
    return Error(ErrorKind::out_of_memory, "no memory for buffer '" + name + "' of " + format_bytes(bytes) + ": " + why,
                 format_bytes(device.live_bytes) + " in use" + device.describe_live(), hint);
}

}  // namespace

std::string format_bytes(uint64_t bytes) {
    constexpr std::array<const char*, 4> kUnits = {"B", "KiB", "MiB", "GiB"};
    double value = static_cast<double>(bytes);
    size_t unit = 0;
    for (; value >= 1024.0 && unit + 1 < kUnits.size(); ++unit) value /= 1024.0;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), unit == 0 ? "%.0f %s" : "%.1f %s", value, kUnits[unit]);
    return text.data();
}

std::string Device::Impl::describe_live() const {
    constexpr size_t kShown = 5;
    std::vector<std::pair<uint64_t, std::string>> sizes;
    for (const auto& [name, bytes] : live_by_name) sizes.emplace_back(bytes, name);
    std::sort(sizes.rbegin(), sizes.rend());
    std::string text;
    for (size_t i = 0; i < std::min(kShown, sizes.size()); ++i) {
        text += (i == 0 ? ": " : ", ") + sizes[i].second + " " + format_bytes(sizes[i].first);
    }
    if (sizes.size() > kShown) text += " and " + std::to_string(sizes.size() - kShown) + " more";
    return text;
}

uint64_t Device::Impl::most_held_bytes() const { return budget > 0 ? budget : limits.heap_bytes / 2; }

void Device::Impl::release_memory(uint64_t down_to) {
    for (auto& [type, pool] : pools) pool.release(down_to);
}

Memory Device::Impl::make_memory(const std::string& name, uint64_t bytes, VkBufferUsageFlags usage,
                                 std::span<const VkMemoryPropertyFlags> preferences, bool map) {
    const VkBufferCreateInfo buffer_info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
    Memory made;
    made.buffer = create<OwnedBuffer>(device.get(), vkCreateBuffer, buffer_info, "a buffer", name);
    VkMemoryRequirements requirements{};
    vkGetBufferMemoryRequirements(device.get(), made.buffer.get(), &requirements);
    std::optional<uint32_t> type;
    for (size_t i = 0; i < preferences.size() && !type; ++i) {
        type = find_memory_type(memory_properties, requirements.memoryTypeBits, preferences[i]);
    }
    if (!type)
        throw Error(ErrorKind::no_device, "the device has no memory type for buffers", "buffer " + name, "update the driver");
    MemoryPool& pool = pools.try_emplace({*type, map}, device.get(), *type, map, max_allocation_bytes).first->second;
    const auto take = [&] { return pool.take(requirements.size, requirements.alignment, most_held_bytes(), made.piece); };
    VkResult result = take();
    const auto is_out = [&] { return result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY; };
    if (is_out()) {
        release_memory(0);
        result = take();
    }
    if (is_out()) throw memory_error(*this, name, bytes, "the driver has no more", "use a lower --memory-budget");
    check(result, "allocate memory", "buffer " + name);
    check(vkBindBufferMemory(device.get(), made.buffer.get(), made.piece.memory(), made.piece.offset()), "bind memory",
          "buffer " + name);
    made.mapped = made.piece.mapped();
    set_object_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(made.buffer.get()), name);
    return made;
}

Buffer::Buffer() = default;
Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
uint64_t Buffer::bytes() const { return impl_ ? impl_->bytes : 0; }
Buffer::operator bool() const { return impl_ != nullptr; }

Buffer::Impl::~Impl() {
    if (bytes > 0) device->remove_live(name, bytes);
}

VkBufferView Buffer::Impl::view(VkFormat format, uint64_t offset, uint64_t range) {
    OwnedBufferView& cached = views[{format, offset, range}];
    if (!cached.get()) {
        const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                          .buffer = memory.buffer.get(),
                                          .format = format,
                                          .offset = offset,
                                          .range = range};
        cached = create<OwnedBufferView>(device->device.get(), vkCreateBufferView, info, "a texel view", "buffer " + name);
    }
    return cached.get();
}

Buffer Device::allocate(const std::string& name, uint64_t bytes) {
    bytes = bytes == 0 ? kGranularity : bytes;
    if (bytes > impl_->limits.max_buffer_bytes - kGranularity) {
        throw memory_error(*impl_, name, bytes,
                           "a buffer of this device has at most " + format_bytes(impl_->limits.max_buffer_bytes),
                           "use a lower --memory-budget");
    }
    const auto passes_budget = [&] {
        return impl_->budget > 0 && (impl_->live_bytes > impl_->budget || bytes > impl_->budget - impl_->live_bytes);
    };
    if (passes_budget()) recorder().submit();
    if (passes_budget()) {
        throw memory_error(*impl_, name, bytes, "it would pass the budget of " + format_bytes(impl_->budget),
                           "allow a larger --memory-budget");
    }
    Buffer buffer;
    buffer.impl_ = std::make_shared<Buffer::Impl>();
    buffer.impl_->device = impl_;
    buffer.impl_->name = name;
    buffer.impl_->capacity = (bytes + kGranularity - 1) / kGranularity * kGranularity;
    constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const std::array preferences{impl_->limits.mapped ? kLocal | kHostReadable : kLocal};
    buffer.impl_->memory = impl_->make_memory(name, buffer.impl_->capacity, kUsage, preferences, impl_->limits.mapped);
    impl_->add_live(name, bytes);
    buffer.impl_->bytes = bytes;
    return buffer;
}

}  // namespace gnomon::gpu
