// SPDX-License-Identifier: Apache-2.0
// Reading accessors: strides, normalized integers, sparse values, and accessors without data (zeros).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf_document.hpp"

namespace gnomon::gltf {

/// Components of one element; matrices column by column.
uint32_t width_of(const tinygltf::Accessor& accessor);

/// Bytes that read_floats returns.
uint64_t float_bytes(const tinygltf::Accessor& accessor);

/// count * width numbers. Integers are exact, normalized ones are divided by their largest value and not below -1.
/// Errors: ErrorKind::input where the data are missing or sparse indices are wrong.
std::vector<float> read_floats(const Document& document, int accessor);

/// Likewise for unsigned integers that are not normalized.
std::vector<uint32_t> read_unsigned(const Document& document, int accessor);

}  // namespace gnomon::gltf
