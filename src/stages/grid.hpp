// SPDX-License-Identifier: Apache-2.0
// Small helpers for recording stages.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "gpu/gpu.hpp"

namespace gnomon {

/// Groups of `size` that hold `count` items.
inline uint64_t groups_of(uint64_t count, uint64_t size) { return (count + size - 1) / size; }

/// Memory for resources that a pass does not touch but that have to be bound: a place for each, since what may be written is
/// bound only once.
class Unbound {
public:
    Unbound(gpu::Device& device, size_t places) : buffer_(device.allocate("unbound", places * kStride)) {}

    gpu::Binding at(size_t place, std::string_view name, gpu::Texel texel = {}) const {
        return {name, &buffer_, texel, place * kStride, kBytes};
    }

private:
    static constexpr uint64_t kStride = 256;  // The coarsest alignment that Vulkan allows a device to ask for.
    static constexpr uint64_t kBytes = 16;    // An element of any type.

    gpu::Buffer buffer_;
};

inline std::vector<gpu::Binding> bindings(std::initializer_list<gpu::Binding> list) { return list; }

}  // namespace gnomon
