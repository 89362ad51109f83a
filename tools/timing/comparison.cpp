// SPDX-License-Identifier: Apache-2.0
#include "timing/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "timing/summary.hpp"

namespace gnomon::timing {

std::optional<Interval> median_interval(std::vector<double> values, double confidence) {
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size());
    // Chance that at most `ranks` of the values are below the median, for 0, 1, ... in turn.
    double chance = 0.0;
    size_t ranks = 0;
    for (; 2 * ranks < values.size(); ++ranks) {
        const auto i = static_cast<double>(ranks);
        const double log_ways = std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0);
        chance += std::exp(log_ways - n * std::log(2.0));
        if (2.0 * chance > 1.0 - confidence) break;
    }
    if (ranks == 0) return std::nullopt;
    return Interval{values[ranks - 1], values[values.size() - ranks]};
}

std::string to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::faster:
            return "faster";
        case Verdict::slower:
            return "slower";
        case Verdict::same:
            return "same";
        default:
            return "undecided";
    }
}

Verdict verdict_of(const std::optional<Interval>& interval, size_t pairs) {
    if (!interval || pairs < kFewestPairs) return Verdict::undecided;
    if (interval->low >= kSame.low && interval->high <= kSame.high) return Verdict::same;
    if (interval->high < 1.0) return Verdict::faster;
    return interval->low > 1.0 ? Verdict::slower : Verdict::undecided;
}

std::optional<Comparison> compare(const std::vector<double>& seconds, const std::vector<double>& baseline) {
    std::vector<double> ratios;
    for (size_t i = 0; i < std::min(seconds.size(), baseline.size()); ++i) {
        if (!(baseline[i] > 0.0)) return std::nullopt;
        ratios.push_back(seconds[i] / baseline[i]);
    }
    if (ratios.empty()) return std::nullopt;
    const std::optional<Interval> interval = median_interval(ratios);
    return Comparison{ratios.size(), summarize(ratios).median, interval, verdict_of(interval, ratios.size())};
}

}  // namespace gnomon::timing
