// SPDX-License-Identifier: Apache-2.0
// Repeated measurements of one quantity.
#pragma once

#include <algorithm>
#include <cassert>
#include <vector>

namespace gnomon::bench {

struct Summary {
    double median = 0.0;  ///< Of an even number of runs, the mean of the middle two.
    double min = 0.0;
    double max = 0.0;
    std::vector<double> runs;  ///< In the order in which they ran.
};

/// Of at least one run.
inline Summary summarize(std::vector<double> runs) {
    assert(!runs.empty());
    std::vector<double> sorted = runs;
    std::sort(sorted.begin(), sorted.end());
    const size_t n = sorted.size();
    return {0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]), sorted.front(), sorted.back(), std::move(runs)};
}

}  // namespace gnomon::bench
