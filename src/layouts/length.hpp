// SPDX-License-Identifier: Apache-2.0
// How many elements a buffer of a layout has, as its manifest says it: an expression over what is counted.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// Whole numbers, names, + - * /, max(a, b), min(a, b) and parentheses. Division rounds down, by 0 gives 0; a difference is
/// at least 0; what does not fit into 64 bits is the largest number that does.
class Length {
public:
    /// The value of a name; 0 and more.
    using Values = std::function<uint64_t(const std::string& name)>;

    Length() = default;
    /// Errors: std::invalid_argument, saying what is wrong and at which character.
    explicit Length(std::string_view text);

    uint64_t value(const Values& of) const;
    const std::vector<std::string>& names() const { return names_; }
    const std::string& text() const { return text_; }

private:
    friend class LengthParser;
    struct Step {
        enum class Kind { number, name, add, subtract, multiply, divide, least, most } kind;
        uint64_t number = 0;  ///< Or the index of the name.
    };
    std::vector<Step> steps_;  ///< In reverse Polish order.
    std::vector<std::string> names_;
    std::string text_;
};

}  // namespace gnomon
