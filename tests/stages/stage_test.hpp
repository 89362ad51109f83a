// SPDX-License-Identifier: Apache-2.0
// What the tests of the stages share: a device that validates, and its programs.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stages/programs.hpp"

namespace gnomon::test {

/// Tests of one process share the device. At the end of each no validation message may be left.
class StageTest : public testing::Test {
protected:
    static gpu::Device& device() {
        static gpu::Device shared("", true);
        return shared;
    }
    static Programs& programs() {
        static Programs shared(device());
        return shared;
    }
    void TearDown() override { EXPECT_THAT(device().validation_messages(), testing::IsEmpty()); }
};

}  // namespace gnomon::test
