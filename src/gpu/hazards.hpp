// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: which commands have to wait for which.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::gpu {

/// Bytes of a buffer that a command reads, or writes (and perhaps reads too).
struct Access {
    const void* buffer = nullptr;
    uint64_t begin = 0;
    uint64_t end = 0;
    bool write = false;
};

/// The accesses of a command buffer since its last barrier.
class Hazards {
public:
    /// Whether a barrier has to come before a command with these accesses: one of them overlaps an earlier one and at least one
    /// of the two writes. The barrier is then taken as recorded. Those of one command are not compared with each other.
    bool add(std::span<const Access> accesses);
    void clear() { since_barrier_.clear(); }

private:
    std::vector<Access> since_barrier_;
};

}  // namespace gnomon::gpu
