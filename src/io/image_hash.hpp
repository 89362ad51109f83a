// SPDX-License-Identifier: Apache-2.0
// One number for the bits of a picture.
#pragma once

#include <cstdint>
#include <gnomon/render.hpp>
#include <span>
#include <string>

namespace gnomon::io {

/// FNV-1a of the size and, in the order of their names, of the channels' names and values, bit for bit: -0 is not 0, and one
/// NaN is not another.
uint64_t image_hash(uint32_t width, uint32_t height, std::span<const Channel> channels);

/// As 16 hexadecimal digits.
std::string hash_text(uint64_t hash);

}  // namespace gnomon::io
