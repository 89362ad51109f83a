// SPDX-License-Identifier: Apache-2.0
// From numbers to places along an axis.
#include "html/scale.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::html {
namespace {

// 1, 2 or 5 times a power of ten, for 4 to 9 steps of it.
double round_step(double length) {
    double step = std::pow(10.0, std::floor(std::log10(length / 4.0)));
    for (const double factor : {2.0, 2.5, 2.0}) {
        if (length / step <= 8.0) break;
        step *= factor;
    }
    return step;
}

}  // namespace

std::vector<double> ticks(double most) {
    if (!(most > 0.0)) most = 1.0;
    const double step = round_step(most);
    std::vector<double> result = {0.0};
    while (result.back() < most * (1.0 - 1e-9)) result.push_back(step * static_cast<double>(result.size()));
    return result;
}

std::vector<double> logarithmic_ticks(double least, double most) {
    constexpr size_t kFewest = 3, kMost = 9;
    const auto multiples = [&](std::initializer_list<double> factors) {
        std::vector<double> result;
        for (double power = std::floor(std::log10(least)); power <= std::ceil(std::log10(most)); power += 1.0)
            for (const double factor : factors)
                if (const double tick = factor * std::pow(10.0, power); tick >= least * (1 - 1e-9) && tick <= most * (1 + 1e-9))
                    result.push_back(tick);
        return result;
    };
    std::vector<double> result = multiples({1.0, 2.0, 5.0});
    if (result.size() > kMost) result = multiples({1.0});
    if (result.size() > kMost) {
        const size_t every = (result.size() + kMost - 1) / kMost;
        std::vector<double> some;
        for (size_t i = 0; i < result.size(); i += every) some.push_back(result[i]);
        return some;
    }
    if (result.size() >= kFewest || !(most > least)) return result;
    const double step = round_step(most - least);
    std::vector<double> even;
    for (double i = std::ceil(least / step - 1e-9); i * step <= most * (1.0 + 1e-9); ++i)
        if (i > 0.0) even.push_back(i * step);
    return even;
}

Scale::Scale(std::vector<double> ticks, bool logarithmic, double least, double most, double from, double to)
    : ticks_(std::move(ticks)), logarithmic_(logarithmic), least_(least), most_(most), from_(from), to_(to) {}

Scale Scale::linear(double most, double from, double to) {
    std::vector<double> marks = html::ticks(most);
    const double last = marks.back();
    return {std::move(marks), false, 0.0, last, from, to};
}

Scale Scale::logarithmic(double least, double most, double from, double to) {
    const double room = std::max(1.05, std::pow(most / least, 0.06));
    least /= room;
    most *= room;
    return {logarithmic_ticks(least, most), true, least, most, from, to};
}

Scale Scale::with_ticks(std::vector<double> ticks, bool logarithmic, double from, double to) {
    double least = ticks.front(), most = ticks.back();
    if (logarithmic) {
        const double room = std::max(1.1, std::pow(most / least, 0.06));
        least /= room;
        most *= room;
    } else {
        const double room = most > least ? 0.06 * (most - least) : std::max(1.0, std::abs(most));
        least -= room;
        most += room;
    }
    return {std::move(ticks), logarithmic, least, most, from, to};
}

double Scale::at(double value) const {
    const double low = std::clamp(value, least_, most_);
    const double share = logarithmic_ ? std::log(low / least_) / std::log(most_ / least_) : (low - least_) / (most_ - least_);
    return from_ + share * (to_ - from_);
}

}  // namespace gnomon::html
