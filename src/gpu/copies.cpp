// SPDX-License-Identifier: Apache-2.0
// Copies on the host.
#include "gpu/copies.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <system_error>
#include <thread>
#include <vector>

namespace gnomon::gpu {
namespace {

constexpr uint64_t kPieceBytes = uint64_t{1} << 19;
// Of one thread: it takes some 30 microseconds to start, and as long to copy a tenth of this.
constexpr uint64_t kThreadBytes = uint64_t{3} << 20;
constexpr uint64_t kMostThreads = 8;  // More do not add bandwidth.

}  // namespace

void copy_all(std::span<const Copy> copies) {
    uint64_t bytes = 0;
    for (const Copy& copy : copies) bytes += copy.bytes;
    const uint64_t threads =
        std::min({bytes / kThreadBytes, kMostThreads, uint64_t{std::max(1u, std::thread::hardware_concurrency())}});
    if (threads <= 1) {
        for (const Copy& copy : copies) std::memcpy(copy.to, copy.from, copy.bytes);
        return;
    }
    std::vector<Copy> pieces;
    for (const Copy& copy : copies) {
        for (uint64_t at = 0; at < copy.bytes; at += kPieceBytes)
            pieces.push_back({copy.from + at, copy.to + at, std::min(kPieceBytes, copy.bytes - at)});
    }
    std::atomic<size_t> next = 0;
    const auto work = [&] {
        for (size_t i = next++; i < pieces.size(); i = next++) std::memcpy(pieces[i].to, pieces[i].from, pieces[i].bytes);
    };
    std::vector<std::jthread> helpers;
    try {
        while (helpers.size() + 1 < threads) helpers.emplace_back(work);
    } catch (const std::system_error&) {
        // There are no more threads: those that there are do it.
    }
    work();
}

}  // namespace gnomon::gpu
