// SPDX-License-Identifier: Apache-2.0
#include "layouts/length.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr uint64_t kMost = std::numeric_limits<uint64_t>::max();
constexpr size_t kMostNested = 32;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

// Recursive descent: sums of products of numbers, names, calls and parentheses.
class LengthParser {
public:
    using Kind = Length::Step::Kind;

    LengthParser(std::string_view text, Length& length) : text_(text), length_(length) {
        sum();
        if (!at_end()) fail("is not expected");
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        const std::string found = at_ < text_.size() ? "'" + std::string(1, text_[at_]) + "'" : "the end";
        throw std::invalid_argument(found + " at character " + std::to_string(at_ + 1) + " " + what);
    }
    bool at_end() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
        return at_ == text_.size();
    }
    bool take(char c) {
        if (at_end() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    void expect(char c) {
        if (!take(c)) fail(std::string("stands where '") + c + "' is expected");
    }
    void put(Kind kind, uint64_t number = 0) { length_.steps_.push_back({kind, number}); }

    void sum() {
        if (++nested_ > kMostNested) fail("is nested too deeply");
        product();
        for (;;) {
            if (take('+')) {
                product();
                put(Kind::add);
            } else if (take('-')) {
                product();
                put(Kind::subtract);
            } else {
                break;
            }
        }
        --nested_;
    }
    void product() {
        term();
        for (;;) {
            if (take('*')) {
                term();
                put(Kind::multiply);
            } else if (take('/')) {
                term();
                put(Kind::divide);
            } else {
                break;
            }
        }
    }
    void term() {
        if (take('(')) {
            sum();
            expect(')');
        } else if (!at_end() && is_digit(text_[at_])) {
            uint64_t number = 0;
            const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
            if (error != std::errc()) fail("begins a number that is too large");
            at_ = static_cast<size_t>(end - text_.data());
            put(Kind::number, number);
        } else if (!at_end() && is_letter(text_[at_])) {
            const size_t begin = at_;
            while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
            const std::string name(text_.substr(begin, at_ - begin));
            if (name == "max" || name == "min") {
                expect('(');
                sum();
                expect(',');
                sum();
                expect(')');
                put(name == "max" ? Kind::most : Kind::least);
                return;
            }
            const auto found = std::find(length_.names_.begin(), length_.names_.end(), name);
            put(Kind::name, static_cast<uint64_t>(found - length_.names_.begin()));
            if (found == length_.names_.end()) length_.names_.push_back(name);
        } else {
            at_end();
            fail("stands where a number or a name is expected");
        }
    }

    std::string_view text_;
    Length& length_;
    size_t at_ = 0;
    size_t nested_ = 0;
};

Length::Length(std::string_view text) : text_(text) { LengthParser(text, *this); }

uint64_t Length::value(const Values& of) const {
    std::vector<uint64_t> stack;
    for (const Step& step : steps_) {
        using Kind = Step::Kind;
        if (step.kind == Kind::number || step.kind == Kind::name) {
            stack.push_back(step.kind == Kind::number ? step.number : of(names_[step.number]));
            continue;
        }
        const uint64_t b = stack.back();
        stack.pop_back();
        uint64_t& a = stack.back();
        switch (step.kind) {
            case Kind::add:
                a = a > kMost - b ? kMost : a + b;
                break;
            case Kind::subtract:
                a = a > b ? a - b : 0;
                break;
            case Kind::multiply:
                a = b != 0 && a > kMost / b ? kMost : a * b;
                break;
            case Kind::divide:
                a = b == 0 ? 0 : a / b;
                break;
            case Kind::least:
                a = std::min(a, b);
                break;
            default:
                a = std::max(a, b);
                break;
        }
    }
    return stack.empty() ? 0 : stack.back();
}

}  // namespace gnomon
