// SPDX-License-Identifier: Apache-2.0
#include "timing/summary.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace gnomon::timing {

double quantile(const std::vector<double>& sorted, double share) {
    assert(!sorted.empty());
    const double rank = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<size_t>(rank);
    const size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Summary summarize(std::vector<double> samples) {
    assert(!samples.empty());
    std::vector<double> sorted = samples;
    std::sort(sorted.begin(), sorted.end());
    return {std::move(samples),     quantile(sorted, 0.5), quantile(sorted, 0.25),
            quantile(sorted, 0.75), sorted.front(),        sorted.back()};
}

double mean(const std::vector<double>& samples) {
    return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

double standard_deviation(const std::vector<double>& samples) {
    if (samples.size() < 2) return 0.0;
    const double middle = mean(samples);
    double sum = 0.0;
    for (const double sample : samples) sum += (sample - middle) * (sample - middle);
    return std::sqrt(sum / static_cast<double>(samples.size() - 1));
}

}  // namespace gnomon::timing
