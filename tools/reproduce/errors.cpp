// SPDX-License-Identifier: Apache-2.0
// How far a run's shadows are from the reference's.
#include "reproduce/errors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "io/perceived_error.hpp"

namespace gnomon::reproduce {
namespace {

const std::vector<float>& plane(const Frame& frame, std::string_view name) {
    const auto found =
        std::find_if(frame.channels.begin(), frame.channels.end(), [&](const Channel& c) { return c.name == name; });
    assert(found != frame.channels.end());
    return found->values;
}

const std::vector<float>& visibility(const Frame& frame, uint32_t light) {
    return plane(frame, "visibility." + std::to_string(light));
}

// Of one sample: 0 or 1, or a share where the method gives shares.
double visibility(const Frame& frame, size_t sample, uint32_t light) {
    if (!frame.sample_visibility.empty()) return double(frame.sample_visibility[sample * frame.light_count + light]);
    return frame.samples[sample].lit >> light & 1u ? 1.0 : 0.0;
}

}  // namespace

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

FalseShare false_share(const Frame& frame, const Frame& reference) {
    assert(frame.samples.size() == reference.samples.size() && frame.light_count == reference.light_count);
    uint64_t tests = 0;
    double shadow = 0.0, light = 0.0;
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        const uint32_t triangle = frame.samples[i].triangle;
        if (triangle != reference.samples[i].triangle || triangle == SampleRecord::kMiss) continue;
        tests += frame.light_count;
        for (uint32_t l = 0; l < frame.light_count; ++l) {
            const double difference = visibility(frame, i, l) - visibility(reference, i, l);
            (difference < 0.0 ? shadow : light) += std::abs(difference);
        }
    }
    if (tests == 0) return {};
    return {shadow / double(tests), light / double(tests)};
}

PixelSquares difference(const PixelSquares& a, double factor, const PixelSquares& b) {
    assert(a.without.size() == b.without.size());
    const auto of = [&](const std::vector<double>& u, const std::vector<double>& v) {
        std::vector<double> result(u.size());
        for (size_t i = 0; i < u.size(); ++i) result[i] = u[i] - factor * v[i];
        return result;
    };
    PixelSquares result{of(a.all, b.all), {}};
    for (size_t k = 0; k < a.without.size(); ++k) result.without.push_back(of(a.without[k], b.without[k]));
    return result;
}

Estimate over_seeds(const PixelSquares& squares, uint32_t width) {
    constexpr size_t kBlock = 16;
    const size_t seeds = squares.without.size(), across = (width + kBlock - 1) / kBlock;
    const size_t rows = (squares.all.size() + width - 1) / width, down = (rows + kBlock - 1) / kBlock;
    std::vector<double> sums(seeds * across * down);  // Of each block's pixels, without each seed.
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < squares.all.size(); ++i) {
        if (std::isnan(squares.all[i])) continue;
        sum += squares.all[i];
        count += 1.0;
        const size_t block = i / width / kBlock * across + i % width / kBlock;
        for (size_t k = 0; k < seeds; ++k) sums[block * seeds + k] += squares.without[k][i];
    }
    if (count == 0.0) return {};
    double spread = 0.0;
    for (size_t block = 0; block < across * down; ++block) {
        const std::span<const double> of_block(&sums[block * seeds], seeds);
        const double middle = std::accumulate(of_block.begin(), of_block.end(), 0.0) / double(seeds);
        for (const double without : of_block) spread += (without - middle) * (without - middle);
    }
    return {sum / count, std::sqrt(spread * (double(seeds) - 1.0) / double(seeds)) / count};
}

Estimate root_of(const Estimate& square) {
    const double root = std::sqrt(std::max(0.0, square.value));
    // Near 0 a root is known no better than to the root of what the square is known to.
    const double most = std::sqrt(square.standard_error);
    return {root, root > 0.0 ? std::min(square.standard_error / (2.0 * root), most) : most};
}

std::vector<double> visibility_difference(const Frame& frame, const Frame& reference) {
    const std::vector<float>&a = plane(frame, "A"), &b = plane(reference, "A");
    std::vector<double> result(a.size());
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        const std::vector<float>&u = visibility(frame, light), &v = visibility(reference, light);
        for (size_t i = 0; i < u.size(); ++i)
            if (a[i] > 0.0f && b[i] > 0.0f) result[i] += (double(u[i]) - double(v[i])) / frame.light_count;
    }
    return result;
}

std::vector<double> flip_of(const Frame& frame, const Frame& reference) {
    const auto test = io::shown_picture(frame.channels, frame.width, frame.height, 0.0);
    const auto truth = io::shown_picture(reference.channels, reference.width, reference.height, 0.0);
    assert(test && truth);
    return io::flip(*test, *truth);
}

void VisibilityStatistics::add(const Frame& frame) {
    const std::vector<float>& alpha = plane(frame, "A");
    lights_ = frame.light_count;
    hits_.resize(alpha.size());
    for (size_t i = 0; i < alpha.size(); ++i) hits_[i] += alpha[i] > 0.0f ? 1 : 0;
    std::vector<float>& all = frames_.emplace_back();
    for (uint32_t light = 0; light < lights_; ++light) {
        const std::vector<float>& of_light = visibility(frame, light);
        all.insert(all.end(), of_light.begin(), of_light.end());
    }
}

// square(pixel, light, mean, variance, frames)
template <typename F>
PixelSquares VisibilityStatistics::each(const F& square) const {
    assert(frames_.size() >= 3);
    const size_t pixels = hits_.size();
    const auto squares_without = [&](size_t left_out) {
        std::vector<double> result(pixels, std::numeric_limits<double>::quiet_NaN());
        const double n = double(frames_.size()) - (left_out < frames_.size() ? 1.0 : 0.0);
        for (size_t i = 0; i < pixels; ++i) {
            if (hits_[i] != frames_.size()) continue;
            result[i] = 0.0;
            for (uint32_t light = 0; light < lights_; ++light) {
                double sum = 0.0, of_squares = 0.0;
                for (size_t k = 0; k < frames_.size(); ++k) {
                    const double v = k == left_out ? 0.0 : double(frames_[k][light * pixels + i]);
                    sum += v;
                    of_squares += v * v;
                }
                const double mean = sum / n, variance = std::max(0.0, (of_squares - sum * mean) / (n - 1.0));
                result[i] += square(i, light, mean, variance, n) / lights_;
            }
        }
        return result;
    };
    PixelSquares result{squares_without(frames_.size()), {}};
    for (size_t k = 0; k < frames_.size(); ++k) result.without.push_back(squares_without(k));
    return result;
}

PixelSquares VisibilityStatistics::noise() const {
    return each([](size_t, uint32_t, double, double variance, double) { return variance; });
}

// square(difference of the mean, variance, frames)
template <typename F>
PixelSquares VisibilityStatistics::against(const Frame& reference, const F& square) const {
    std::vector<const std::vector<float>*> truth;
    for (uint32_t light = 0; light < lights_; ++light) truth.push_back(&visibility(reference, light));
    PixelSquares result = each([&](size_t pixel, uint32_t light, double mean, double variance, double n) {
        return square(mean - double((*truth[light])[pixel]), variance, n);
    });
    const std::vector<float>& alpha = plane(reference, "A");
    for (size_t i = 0; i < alpha.size(); ++i)
        if (alpha[i] <= 0.0f) result.all[i] = std::numeric_limits<double>::quiet_NaN();
    return result;
}

PixelSquares VisibilityStatistics::error(const Frame& reference) const {
    return against(reference, [](double d, double variance, double n) { return d * d + variance * (n - 1.0) / n; });
}

PixelSquares VisibilityStatistics::systematic(const Frame& reference) const {
    return against(reference, [](double d, double variance, double n) { return d * d - variance / n; });
}

}  // namespace gnomon::reproduce
