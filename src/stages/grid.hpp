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

inline std::vector<gpu::Binding> bindings(std::initializer_list<gpu::Binding> list) { return list; }

}  // namespace gnomon
