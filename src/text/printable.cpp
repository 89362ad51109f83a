// SPDX-License-Identifier: Apache-2.0
#include "text/printable.hpp"

#include <cstddef>

namespace gnomon {

namespace {

// A character, as UTF-8 has it. 0 bytes: it is none.
struct Character {
    char32_t code = 0;
    size_t bytes = 0;
};

Character first_of(std::string_view text) {
    constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // By bytes: less is written in fewer.
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80) return {byte(0), 1};
    const size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc0 || byte(0) >= 0xf8 || text.size() < bytes) return {};
    char32_t code = byte(0) & (0x7fu >> bytes);
    for (size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    return code < kLeast[bytes] || is_surrogate || code > 0x10ffff ? Character{} : Character{code, bytes};
}

bool is_harmless(const Character& c) {
    const auto in = [&](char32_t first, char32_t last) { return c.code >= first && c.code <= last; };
    const bool is_control = in(0, 0x1f) || in(0x7f, 0x9f);
    const bool ends_line = in(0x2028, 0x2029);
    const bool turns_direction = in(0x200e, 0x200f) || in(0x202a, 0x202e) || in(0x2066, 0x2069);
    return c.bytes > 0 && !is_control && !ends_line && !turns_direction;
}

std::string escaped(unsigned char byte) {
    constexpr char kDigits[] = "0123456789abcdef";
    if (byte == '\n') return "\\n";
    if (byte == '\r') return "\\r";
    if (byte == '\t') return "\\t";
    return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 0xf]};
}

}  // namespace

std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const Character c = first_of(text);
        const std::string_view bytes = text.substr(0, c.bytes > 0 ? c.bytes : 1);
        if (is_harmless(c)) {
            result += bytes;
        } else {
            for (const char byte : bytes) result += escaped(static_cast<unsigned char>(byte));
        }
        text.remove_prefix(bytes.size());
    }
    return result;
}

}  // namespace gnomon
