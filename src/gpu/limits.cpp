// SPDX-License-Identifier: Apache-2.0
// The limits of a device, and lower ones by the environment variable GNOMON_LIMITS.
#include "gpu/limits.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <gnomon/error.hpp>
#include <set>
#include <sstream>
#include <thread>

namespace gnomon::gpu {
namespace {

struct KnownLimit {
    std::string name;
    uint64_t own;
    std::function<void(uint64_t)> set;
};

template <class T>
KnownLimit known(const char* name, T& value) {
    return {name, static_cast<uint64_t>(value), [&value](uint64_t lowered) { value = static_cast<T>(lowered); }};
}

std::vector<KnownLimit> known_limits(Limits& limits) {
    return {known("buffer", limits.max_buffer_bytes),
            known("crew", limits.crew),
            known("dispatch_ms", limits.dispatch_ms),
            known("groups", limits.max_groups),
            known("mapped", limits.mapped),
            known("push_constants", limits.push_constant_bytes),
            known("shuffles", limits.shuffles),
            known("storage_16bit", limits.storage_16bit),
            known("storage_8bit", limits.storage_8bit),
            known("storage_buffers", limits.storage_buffers),
            known("storage_range", limits.max_storage_range),
            known("texel_reads", limits.texel_reads),
            known("texels", limits.max_texels),
            known("timestamps", limits.timestamps)};
}

[[noreturn]] void fail(const std::vector<KnownLimit>& limits, const std::string& part, const std::string& what) {
    std::string names;
    for (const KnownLimit& limit : limits) {
        names += (names.empty() ? "" : ", ") + limit.name + " (" + std::to_string(limit.own) + ")";
    }
    throw Error(ErrorKind::usage, "'" + part + "' " + what, "environment variable GNOMON_LIMITS",
                "give NAME=VALUE,... of these, none above the device's own: " + names);
}

}  // namespace

Limits own_limits(const Candidate& candidate) {
    VkPhysicalDeviceSubgroupProperties subgroup{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceMaintenance4Properties maintenance4{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES,
                                                        .pNext = &subgroup};
    VkPhysicalDeviceMaintenance3Properties maintenance3{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES,
                                                        .pNext = &maintenance4};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &maintenance3};
    vkGetPhysicalDeviceProperties2(candidate.physical, &properties);
    const VkPhysicalDeviceLimits& vulkan = properties.properties.limits;
    Limits limits{
        .heap_bytes = candidate.description.heap_bytes,
        .max_buffer_bytes = std::min(maintenance3.maxMemoryAllocationSize, maintenance4.maxBufferSize),
        .max_storage_range = vulkan.maxStorageBufferRange,
        .storage_alignment = vulkan.minStorageBufferOffsetAlignment,
        .max_texels = vulkan.maxTexelBufferElements,
        .texel_alignment = vulkan.minTexelBufferOffsetAlignment,
        .storage_8bit = candidate.storage_8bit,
        .storage_16bit = candidate.storage_16bit,
        .max_groups = std::min(vulkan.maxComputeWorkGroupCount[0], vulkan.maxComputeWorkGroupCount[1]),
        .subgroup_size = candidate.subgroup.size,
        .shuffles = (subgroup.supportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT) != 0,
        .storage_buffers = vulkan.maxPerStageDescriptorStorageBuffers,
        .push_constant_bytes = vulkan.maxPushConstantsSize,
        .timestamps = candidate.timestamp_bits > 0,
        .is_cpu = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU,
    };
    if (limits.is_cpu) limits.threads = std::max(1u, std::thread::hardware_concurrency());

    // Cached, because the host reads results: uncached device memory behind a bus is read far slower than it is copied. And in
    // the largest heap, because some devices show the host a small window only.
    constexpr VkMemoryPropertyFlags kMappable = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(candidate.physical, &memory);
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryType& type = memory.memoryTypes[i];
        const bool large = memory.memoryHeaps[type.heapIndex].size == limits.heap_bytes;
        if (large && (type.propertyFlags & kMappable) == kMappable) limits.mapped = true;
    }
    return limits;
}

Limits lower_limits(Limits own, const std::string& text) {
    Limits lowered = own;
    const std::vector<KnownLimit> limits = known_limits(lowered);
    std::set<std::string> seen;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const std::string name = part.substr(0, part.find('='));
        const auto limit = std::find_if(limits.begin(), limits.end(), [&](const KnownLimit& l) { return l.name == name; });
        if (limit == limits.end()) fail(limits, part, "is not a limit");
        if (!seen.insert(name).second) fail(limits, part, "is given twice");
        const char* begin = part.data() + std::min(part.size(), name.size() + 1);
        const char* end = part.data() + part.size();
        uint64_t value = 0;
        const auto read = std::from_chars(begin, end, value);
        if (begin == end || read.ec != std::errc() || read.ptr != end) fail(limits, part, "is not a number");
        if (value > limit->own) fail(limits, part, "is above the device's own " + std::to_string(limit->own));
        limit->set(value);
    }
    return lowered;
}

}  // namespace gnomon::gpu
