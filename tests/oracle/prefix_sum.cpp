// SPDX-License-Identifier: Apache-2.0
// The oracle of prefix sums.
#include "oracle/prefix_sum.hpp"

namespace gnomon::oracle {

std::vector<uint64_t> exclusive_sums(const std::vector<uint32_t>& values) {
    std::vector<uint64_t> sums = {0};
    for (uint32_t value : values) sums.push_back(sums.back() + value);
    return sums;
}

}  // namespace gnomon::oracle
