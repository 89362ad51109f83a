// SPDX-License-Identifier: Apache-2.0
// How far one image is from another, channel by channel.
#include "io/image_compare.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "io/pixel_mean.hpp"

namespace gnomon::io {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // Of a pixel that is left out.

using Values = std::vector<double>;

double square(double x) { return x * x; }

// The errors of each pixel.
struct PixelErrors {
    Values differences, squares, relative;

    explicit PixelErrors(size_t count) : differences(count, kNone), squares(count, kNone), relative(count, kNone) {}

    void set(size_t i, double a, double b) {
        differences[i] = a - b;
        squares[i] = square(a - b);
        relative[i] = squares[i] / (square(b) + 0.01);
    }
};

}  // namespace

ChannelError compare_channel(const std::string& name, std::span<const float> a, std::span<const float> b, uint32_t width,
                             const PixelNoise& noise) {
    assert(a.size() == b.size());
    assert(noise.variances.empty() || noise.variances.size() == a.size());
    assert(noise.again.empty() || noise.again.size() == a.size());
    const bool has_again = !noise.again.empty(), has_noise = has_again || !noise.variances.empty();
    ChannelError error{.name = name};
    PixelErrors errors(a.size()), again(a.size());
    Values variances(a.size(), kNone), without_noise(a.size(), kNone);
    double peak = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double value = a[i], reference = b[i];
        const double value_again = has_again ? noise.again[i] : value;
        const double variance = has_again ? square(value - value_again) / 2.0 : has_noise ? noise.variances[i] : 0.0;
        if (!std::isfinite(value - reference) || !std::isfinite(variance)) {
            ++error.not_finite;
            continue;
        }
        errors.set(i, value, reference);
        again.set(i, value_again, reference);
        variances[i] = variance;
        without_noise[i] = errors.squares[i] - variance;
        error.max = std::max(error.max, std::abs(value - reference));
        peak = std::max(peak, std::abs(reference));
    }
    const auto standard_error = [&](const Values& values, const Values& values_again) {
        return has_again ? standard_error_of_two(values, values_again, width) : pixel_mean(values, width).standard_error;
    };
    error.compared = a.size() - error.not_finite;
    error.bias = pixel_mean(errors.differences, width).mean;
    error.bias_standard_error = standard_error(errors.differences, again.differences);
    const double mse = pixel_mean(errors.squares, width).mean;
    const double mse_standard_error = standard_error(errors.squares, again.squares);
    error.rmse = std::sqrt(mse);
    error.rmse_standard_error = mse > 0.0 ? mse_standard_error / (2.0 * error.rmse) : mse_standard_error;
    error.rel_mse = pixel_mean(errors.relative, width).mean;
    error.rel_mse_standard_error = standard_error(errors.relative, again.relative);
    if (has_noise && error.compared > 0) {
        const PixelMean variance = pixel_mean(variances, width), without = pixel_mean(without_noise, width);
        error.noise = {variance.mean, mse > 0.0 ? variance.mean / mse : kNone, without.mean, without.standard_error};
    }
    error.psnr =
        mse > 0.0 ? 20.0 * std::log10((peak > 0.0 ? peak : 1.0) / error.rmse) : std::numeric_limits<double>::infinity();
    return error;
}

bool is_over(const ChannelError& error, Metric metric, double threshold) {
    if (error.not_finite > 0) return true;
    switch (metric) {
        case Metric::rmse:
            return error.rmse > threshold;
        case Metric::max:
            return error.max > threshold;
        case Metric::psnr:
            return error.psnr < threshold;
        case Metric::rel_mse:
            return error.rel_mse > threshold;
    }
    assert(false);
    return true;
}

}  // namespace gnomon::io
