// SPDX-License-Identifier: Apache-2.0
// How often something is tried.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "unit/io/command_runner.hpp"
#include "unit/io/test_folder.hpp"

namespace gnomon::test {

/// The environment's GNOMON_TRIALS, else so many.
inline size_t trials(size_t otherwise) {
    const char* text = std::getenv("GNOMON_TRIALS");
    return text != nullptr ? std::strtoul(text, nullptr, 10) : otherwise;
}

/// A folder of its own for each test, which is skipped without a Vulkan device.
class RobustnessTest : public TestFolder {
protected:
    void SetUp() override {
        if (run_gnomon(folder, {"devices"}).exit_code == 4) GTEST_SKIP() << "skipped: no usable Vulkan device";
    }
};

}  // namespace gnomon::test
