// SPDX-License-Identifier: Apache-2.0
// What a call throws.
#pragma once

#include <gnomon/error.hpp>
#include <optional>

namespace gnomon::test {

/// The gnomon::Error that a call ends in; nothing if it ends in none.
template <class Call>
std::optional<Error> error_of(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

}  // namespace gnomon::test

/// The call throws an Error of this kind whose message contains the text.
#define EXPECT_GNOMON_ERROR(call, expected_kind, text)                        \
    do {                                                                      \
        const auto thrown = ::gnomon::test::error_of([&] { call; });          \
        ASSERT_TRUE(thrown.has_value()) << #call << " throws no Error";       \
        EXPECT_EQ(thrown->kind(), expected_kind) << thrown->what();           \
        EXPECT_THAT(std::string(thrown->what()), ::testing::HasSubstr(text)); \
    } while (false)
