// SPDX-License-Identifier: Apache-2.0
// What the tests of the GPU layer share.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <gnomon/error.hpp>
#include <string>
#include <vector>

#include "gpu/gpu.hpp"

namespace gnomon::gpu {

/// `statement` throws an Error of this kind whose text holds all of `parts`.
template <class Statement>
void expect_error(ErrorKind kind, const std::vector<std::string>& parts, Statement statement) {
    try {
        statement();
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        for (const std::string& part : parts) EXPECT_THAT(error.what(), testing::HasSubstr(part));
    }
}

inline std::vector<uint32_t> iota(uint32_t count, uint32_t first = 0) {
    std::vector<uint32_t> values(count);
    for (uint32_t i = 0; i < count; ++i) values[i] = first + i;
    return values;
}

/// Sets an environment variable for the life of this object.
class ScopedVariable {
public:
    ScopedVariable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old, had_ = true;
        setenv(name, value, 1);
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;
    ~ScopedVariable() {
        if (had_) {
            setenv(name_, old_.c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }

private:
    const char* name_;
    std::string old_;
    bool had_ = false;
};

/// A fixture with a device that validates. At its end no message may be left.
class DeviceTest : public testing::Test {
protected:
    void TearDown() override { EXPECT_THAT(device.validation_messages(), testing::IsEmpty()); }

    Device device{"", true};
};

}  // namespace gnomon::gpu
