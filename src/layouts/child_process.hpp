// SPDX-License-Identifier: Apache-2.0
// Work on what others wrote, in a process of its own.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace gnomon {

/// What a child process may take.
struct ChildLimits {
    std::chrono::seconds seconds{30};            ///< Of either clock, the wall's doubled.
    uint64_t more_bytes = uint64_t{1} << 30;     ///< Address space besides what this process has.
    uint64_t output_bytes = uint64_t{64} << 20;  ///< Of the result.
};

/// What `work` returned in a child process, which ends with it. `work` calls no driver and takes no lock that another thread
/// may hold. Where it ends otherwise: nothing, and `reason`: "took more than 30 s", "took more than 1024 MiB", "crashed (signal
/// 11)". Errors: ErrorKind::out_of_memory, where no process can be made.
std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits, std::string& reason);

}  // namespace gnomon
