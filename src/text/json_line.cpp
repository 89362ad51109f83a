// SPDX-License-Identifier: Apache-2.0
#include "text/json_line.hpp"

#include <algorithm>
#include <charconv>

namespace gnomon {
namespace {

// Walks valid JSON once.
class Walk {
public:
    explicit Walk(std::string_view text) : text_(text) {}

    size_t line_of(std::string_view pointer) {
        space();
        size_t found = at_;
        while (!pointer.empty()) {
            pointer.remove_prefix(1);
            const std::string_view key = pointer.substr(0, pointer.find('/'));
            pointer.remove_prefix(key.size());
            const bool is_there = text_[at_] == '{' ? enter_member(key, found) : text_[at_] == '[' && enter_element(key, found);
            if (!is_there) break;
        }
        return 1 + static_cast<size_t>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
    }

private:
    void space() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size() - 1); }
    // Past a character between values.
    void past() {
        ++at_;
        space();
    }

    std::string_view string() {
        const size_t begin = ++at_;
        while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
        return text_.substr(begin, at_++ - begin);
    }

    void skip_value() {
        int level = 0;
        do {
            if (text_[at_] == '"') {
                string();
            } else {
                level += text_[at_] == '{' || text_[at_] == '[' ? 1 : text_[at_] == '}' || text_[at_] == ']' ? -1 : 0;
                ++at_;
            }
        } while (at_ < text_.size() && (level > 0 || !ends()));
        space();
    }
    // A number or a word does, or what was a whole value.
    bool ends() const { return text_.find_first_of(",]} \t\r\n", at_) == at_; }

    bool enter_member(std::string_view key, size_t& found) {
        past();
        while (text_[at_] == '"') {
            const size_t begin = at_;
            const bool wanted = string() == key;
            space();
            past();  // The colon.
            if (wanted) {
                found = begin;
                return true;
            }
            skip_value();
            if (text_[at_] != ',') return false;
            past();
        }
        return false;
    }

    bool enter_element(std::string_view key, size_t& found) {
        size_t index = 0;
        std::from_chars(key.data(), key.data() + key.size(), index);
        past();
        while (text_[at_] != ']') {
            if (index == 0) {
                found = at_;
                return true;
            }
            --index;
            skip_value();
            if (text_[at_] != ',') return false;
            past();
        }
        return false;
    }

    std::string_view text_;
    size_t at_ = 0;
};

}  // namespace

size_t json_line(std::string_view text, std::string_view pointer) { return Walk(text).line_of(pointer); }

}  // namespace gnomon
