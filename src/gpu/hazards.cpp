// SPDX-License-Identifier: Apache-2.0
// Overlaps of what commands access.
#include "gpu/hazards.hpp"

#include <algorithm>

namespace gnomon::gpu {
namespace {

// Each access is compared with all since the barrier; beyond this many a barrier is cheaper.
constexpr size_t kMostAccesses = 512;

bool conflict(const Access& a, const Access& b) {
    return (a.write || b.write) && a.buffer == b.buffer && a.begin < b.end && b.begin < a.end;
}

bool covers(const Access& a, const Access& b) {
    return a.buffer == b.buffer && a.begin <= b.begin && a.end >= b.end && a.write == b.write;
}

}  // namespace

bool Hazards::add(std::span<const Access> accesses) {
    const bool barrier =
        since_barrier_.size() > kMostAccesses || std::any_of(accesses.begin(), accesses.end(), [&](const Access& a) {
            return std::any_of(since_barrier_.begin(), since_barrier_.end(), [&](const Access& b) { return conflict(a, b); });
        });
    if (barrier) since_barrier_.clear();
    for (const Access& access : accesses) {
        const bool known = std::any_of(since_barrier_.begin(), since_barrier_.end(),
                                       [&](const Access& before) { return covers(before, access); });
        if (!known) since_barrier_.push_back(access);
    }
    return barrier;
}

}  // namespace gnomon::gpu
