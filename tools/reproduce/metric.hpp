// SPDX-License-Identifier: Apache-2.0
// What is measured of a run, and how it is written.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::reproduce {

/// Shares are of 1, times in seconds, memory in bytes. Those that need the reference are marked R.
enum class Metric {
    false_shadow,   ///< R: share of shadow tests that say shadow where the ray-traced one of the same sample says light.
    false_light,    ///< R: the other way round.
    excess_shadow,  ///< R: false_shadow - false_light: where a shadow's edge is coarse both are wrong alike; self-shadowing is
                    ///< not.
    error,          ///< R: RMSE of visibility per pixel against the converged reference.
    noise,          ///< R: root mean over pixels of the variance of visibility between seeds.
    systematic,     ///< R: of the error, what is not noise, what more frames would not cure: root over pixels of the mean of
                    ///< (expected visibility - reference's)^2. Like the two before it compared pixel by pixel.
    flip,           ///< R: mean FLIP against the converged reference.
    seconds,        ///< On the device, all stages.
    map_seconds,    ///< Of these, what makes the lights' maps.
    test_seconds,   ///< Of these, the shadow tests.
    map_bytes,      ///< Of what the shadow tests read.
    equation_2,  ///< Memory by eq. 2 of Hong and Oh 2018, of methods with fragments: 16 bytes each, 24 per range, 8 per texel.
    ranges,      ///< In all lights' maps.
};

struct Unit {
    std::string name;   ///< Empty: a plain number.
    double size = 1.0;  ///< In what is measured: 1e-3 for ms.
};

struct MetricInfo {
    Metric metric;
    std::string key;  ///< In the JSON.
    std::string title;
    Unit unit;       ///< In tables.
    Unit plot_unit;  ///< In plots.
};

const std::vector<MetricInfo>& metrics();
const MetricInfo& info(Metric metric);

/// A mean over seeds, or what is the same for all.
struct Estimate {
    double value = 0.0;
    double standard_error = 0.0;  ///< Of the mean; 0 of a single run or of what is exact.
    uint32_t freedom = 0;         ///< Degrees of the standard error's own: seeds - 1; 0: so many that it is as good as known.
};

/// How many standard errors an estimate is from its expectation, either way, in 5 of 100 cases: Student's t.
double deviations_by_chance(uint32_t freedom);

/// values: at least one.
Estimate estimate(std::span<const double> values);

/// As many digits as the standard error leaves certain, or three: "1.25 ± 0.03".
std::string shown(const Estimate& estimate);
/// In the metric's unit; whole numbers with all their digits.
std::string shown(Metric metric, const Estimate& estimate);
/// The same with the unit's name.
std::string shown_with_unit(Metric metric, const Estimate& estimate);

}  // namespace gnomon::reproduce
