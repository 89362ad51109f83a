// SPDX-License-Identifier: Apache-2.0
// The oracle of prefix sums.
#pragma once

#include <cstdint>
#include <vector>

namespace gnomon::oracle {

/// Sums of the values before each, and the total behind the last: values.size() + 1 of them.
std::vector<uint64_t> exclusive_sums(const std::vector<uint32_t>& values);

}  // namespace gnomon::oracle
