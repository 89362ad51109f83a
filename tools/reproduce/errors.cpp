// SPDX-License-Identifier: Apache-2.0
// How far a run's shadows are from the reference's.
#include "reproduce/errors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "io/perceived_error.hpp"

namespace gnomon::reproduce {
namespace {

const std::vector<float>& plane(const Frame& frame, const std::string& name) {
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

double visibility_error(const Frame& frame, const Frame& reference) {
    const std::vector<float>&a = plane(frame, "A"), &b = plane(reference, "A");
    double sum = 0.0;
    uint64_t count = 0;
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        const std::vector<float>&u = visibility(frame, light), &v = visibility(reference, light);
        for (size_t i = 0; i < u.size(); ++i) {
            if (a[i] <= 0.0f || b[i] <= 0.0f) continue;
            const double difference = double(u[i]) - double(v[i]);
            sum += difference * difference;
            ++count;
        }
    }
    return count > 0 ? std::sqrt(sum / double(count)) : 0.0;
}

Estimate without_noise(const Estimate& error, const Estimate& noise) {
    const double square = error.value * error.value - noise.value * noise.value;
    // Of the square; its root is known to half of it, relatively, and near 0 no better than the root of it.
    const double spread = 2.0 * std::hypot(error.value * error.standard_error, noise.value * noise.standard_error);
    const double root = std::sqrt(std::max(0.0, square));
    return {root, std::min(root > 0.0 ? spread / (2.0 * root) : std::sqrt(spread), std::sqrt(spread))};
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

void VisibilityVariance::add(const Frame& frame) {
    const std::vector<float>& alpha = plane(frame, "A");
    sums_.resize(alpha.size() * frame.light_count);
    squares_.resize(sums_.size());
    hits_.resize(sums_.size());
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        const std::vector<float>& v = visibility(frame, light);
        for (size_t i = 0; i < v.size(); ++i) {
            const size_t place = light * v.size() + i;
            sums_[place] += double(v[i]);
            squares_[place] += double(v[i]) * double(v[i]);
            hits_[place] += alpha[i] > 0.0f ? 1 : 0;
        }
    }
    ++frames_;
}

std::optional<Estimate> VisibilityVariance::noise() const {
    if (frames_ < 2) return std::nullopt;
    const double n = frames_;
    std::vector<double> variances;
    for (size_t i = 0; i < sums_.size(); ++i)
        if (hits_[i] == frames_) variances.push_back(std::max(0.0, (squares_[i] - sums_[i] * sums_[i] / n) / (n - 1.0)));
    if (variances.empty()) return std::nullopt;
    const Estimate variance = estimate(variances);
    const double deviation = std::sqrt(variance.value);
    return Estimate{deviation, deviation > 0.0 ? variance.standard_error / (2.0 * deviation) : 0.0};
}

}  // namespace gnomon::reproduce
