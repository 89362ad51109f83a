// SPDX-License-Identifier: Apache-2.0
// What is measured of a run, and how it is written.
#include "reproduce/metric.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::reproduce {

const std::vector<MetricInfo>& metrics() {
    const Unit plain, percent{"%", 0.01}, ms{"ms", 1e-3}, bytes{"bytes"}, mib{"MiB", 1024.0 * 1024.0}, million{"million", 1e6};
    static const std::vector<MetricInfo> all = {
        {Metric::false_shadow, "false_shadow", "false shadow", percent, percent},
        {Metric::false_light, "false_light", "false light", percent, percent},
        {Metric::excess_shadow, "excess_shadow", "excess shadow", percent, percent},
        {Metric::error, "error", "RMSE of visibility", plain, plain},
        {Metric::noise, "noise", "noise of visibility", plain, plain},
        {Metric::systematic, "systematic", "error without noise", plain, plain},
        {Metric::flip, "flip", "FLIP", plain, plain},
        {Metric::seconds, "seconds", "frame", ms, ms},
        {Metric::map_seconds, "map_seconds", "making the shadow map", ms, ms},
        {Metric::test_seconds, "test_seconds", "shadow tests", ms, ms},
        {Metric::map_bytes, "map_bytes", "memory of the shadow map", bytes, mib},
        {Metric::equation_2, "equation_2_bytes", "memory by eq. 2", bytes, mib},
        {Metric::ranges, "ranges", "ranges", plain, million},
    };
    return all;
}

const MetricInfo& info(Metric metric) {
    const auto found =
        std::find_if(metrics().begin(), metrics().end(), [&](const MetricInfo& m) { return m.metric == metric; });
    assert(found != metrics().end());
    return *found;
}

Estimate estimate(std::span<const double> values) {
    assert(!values.empty());
    const auto n = static_cast<double>(values.size());
    double sum = 0.0, squares = 0.0;
    for (const double value : values) sum += value;
    const double mean = sum / n;
    for (const double value : values) squares += (value - mean) * (value - mean);
    if (values.size() < 2) return {mean};
    return {mean, std::sqrt(squares / (n - 1.0) / n), static_cast<uint32_t>(values.size()) - 1};
}

double deviations_by_chance(uint32_t freedom) {
    constexpr double kFew[] = {1.960, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
    // From 11 on within 0.01.
    return freedom < std::size(kFew) ? kFew[freedom] : 1.960 + 2.6 / freedom;
}

std::string shown(const Estimate& estimate) {
    const auto place = [](double value) { return static_cast<int>(std::floor(std::log10(value))); };
    const double size = std::abs(estimate.value), error = estimate.standard_error;
    int decimals = size > 0.0 ? 2 - place(size) : 0;
    // One digit of the error, but no more than five of the value.
    if (error > 0.0) decimals = size > 0.0 ? std::min(4 - place(size), -place(error)) : -place(error);
    decimals = std::clamp(decimals, 0, 7);
    const std::string value = fmt::format("{:.{}f}", estimate.value, decimals);
    return error > 0.0 ? fmt::format("{} ± {:.{}f}", value, error, std::clamp(-place(error), 0, 7)) : value;
}

std::string shown(Metric metric, const Estimate& estimate) {
    const double size = info(metric).unit.size;
    const bool whole = metric == Metric::map_bytes || metric == Metric::equation_2 || metric == Metric::ranges;
    if (whole && estimate.standard_error == 0.0) {
        std::string digits = fmt::format("{:.0f}", estimate.value);
        for (auto i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3) digits.insert(static_cast<size_t>(i), ",");
        return digits;
    }
    return shown(Estimate{estimate.value / size, estimate.standard_error / size});
}

std::string shown_with_unit(Metric metric, const Estimate& estimate) {
    const std::string& unit = info(metric).unit.name;
    return shown(metric, estimate) + (unit.empty() ? "" : " " + unit);
}

}  // namespace gnomon::reproduce
