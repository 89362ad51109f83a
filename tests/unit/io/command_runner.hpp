// SPDX-License-Identifier: Apache-2.0
// Runs the built commands and keeps what it says.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::test {

struct CommandResult {
    int exit_code = -1;  ///< 128 + the signal where one ended it.
    std::string out;
    std::string err;
};

/// Run a command with these arguments in a folder, stdout and stderr going to files. `prepare` runs in the child before the
/// command does; `while_running` here, with the child's process id.
CommandResult run_command(const std::string& command, const std::filesystem::path& folder,
                          const std::vector<std::string>& arguments, const std::function<void()>& prepare = {},
                          const std::function<void(int)>& while_running = {});

/// The same of `gnomon`.
CommandResult run_gnomon(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                         const std::function<void()>& prepare = {}, const std::function<void(int)>& while_running = {});

/// Does the environment's GNOMON_REQUIRE_DEVICE say 1?
bool device_is_required();

/// Where a command found no device, skips the test, or fails it where a device is required, and says why.
#define GN_SKIP_WITHOUT_DEVICE(result)                                                                                   \
    if (const gnomon::test::CommandResult found = (result); found.exit_code == 4) {                                      \
        if (gnomon::test::device_is_required()) FAIL() << "a device is required (GNOMON_REQUIRE_DEVICE): " << found.err; \
        GTEST_SKIP() << "skipped: no usable Vulkan device: " << found.err;                                               \
    }

}  // namespace gnomon::test
