// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: copies on the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::gpu {

struct Copy {
    const std::byte* from = nullptr;
    std::byte* to = nullptr;
    uint64_t bytes = 0;
};

/// Make all copies; many bytes by several threads, since one alone copies a film slower than a device renders it. They do not
/// overlap.
void copy_all(std::span<const Copy> copies);

}  // namespace gnomon::gpu
