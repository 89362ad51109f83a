// SPDX-License-Identifier: Apache-2.0
// Is one thing faster than another? Paired measurements, compared without assuming how they are distributed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gnomon::timing {

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// That holds the median of what the values are drawn from with a probability of at least `confidence`: between the k-th least
/// and the k-th most of them, k as large as the sign test lets it be (exact binomial). None where even the least and the most
/// do not do: of fewer than six values, for 0.95.
std::optional<Interval> median_interval(std::vector<double> values, double confidence = 0.95);

enum class Verdict { faster, slower, same, undecided };
std::string to_string(Verdict verdict);

/// Of fewer pairs nothing is decided.
inline constexpr size_t kFewestPairs = 9;
/// Ratios within these are no difference that anybody need care about.
inline constexpr Interval kSame = {0.98, 1.02};

struct Comparison {
    size_t pairs = 0;
    double ratio = 0.0;                ///< Median of the ratios of each pair: below 1 is faster.
    std::optional<Interval> interval;  ///< Of 95 %.
    Verdict verdict = Verdict::undecided;
};

/// "same" where the interval lies within kSame; else "faster" where it lies below 1, "slower" where it lies above.
Verdict verdict_of(const std::optional<Interval>& interval, size_t pairs);

/// Seconds of the i-th repetition against those of the baseline's. None without pairs, and where a baseline took no time at
/// all.
std::optional<Comparison> compare(const std::vector<double>& seconds, const std::vector<double>& baseline);

}  // namespace gnomon::timing
