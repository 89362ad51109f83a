// SPDX-License-Identifier: Apache-2.0
// What the tests of the stages share: a device that validates, and its programs.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stages/programs.hpp"
#include "support/shared_devices.hpp"

namespace gnomon::test {

/// Tests of one process share the device. At the end of each no validation message may be left.
class StageTest : public testing::Test {
protected:
    static gpu::Device& device() {
        static std::unique_ptr<gpu::Device> device;
        return make_once(device, "", true);
    }
    static Programs& programs() {
        static std::unique_ptr<Programs> programs;
        return make_once(programs, device());
    }
    void TearDown() override { EXPECT_THAT(device().validation_messages(), testing::IsEmpty()); }
};

}  // namespace gnomon::test
