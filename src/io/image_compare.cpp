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

double square(double x) { return x * x; }

}  // namespace

ChannelError compare_channel(const std::string& name, std::span<const float> a, std::span<const float> b, uint32_t width,
                             std::span<const double> variances) {
    assert(a.size() == b.size());
    assert(variances.empty() || variances.size() == a.size());
    ChannelError error{.name = name};
    std::vector<double> differences(a.size(), kNone), squares = differences, relative = differences,
                                                      without_noise = differences;
    double peak = 0.0;
    double variance_sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double reference = b[i];
        const double variance = variances.empty() ? 0.0 : variances[i];
        differences[i] = a[i] - reference;
        if (!std::isfinite(differences[i]) || !std::isfinite(variance)) {
            differences[i] = kNone;
            ++error.not_finite;
            continue;
        }
        squares[i] = square(differences[i]);
        relative[i] = squares[i] / (square(reference) + 0.01);
        without_noise[i] = squares[i] - variance;
        variance_sum += variance;
        error.max = std::max(error.max, std::abs(differences[i]));
        peak = std::max(peak, std::abs(reference));
    }
    const PixelMean bias = pixel_mean(differences, width), mse = pixel_mean(squares, width);
    const PixelMean rel_mse = pixel_mean(relative, width);
    error.compared = bias.count;
    error.bias = bias.mean;
    error.bias_standard_error = bias.standard_error;
    error.rmse = std::sqrt(mse.mean);
    error.rmse_standard_error = error.rmse > 0.0 ? mse.standard_error / (2.0 * error.rmse) : mse.standard_error;
    error.rel_mse = rel_mse.mean;
    error.rel_mse_standard_error = rel_mse.standard_error;
    if (!variances.empty() && error.compared > 0) {
        const PixelMean without = pixel_mean(without_noise, width);
        const double variance = variance_sum / static_cast<double>(error.compared);
        error.noise = {variance, mse.mean > 0.0 ? variance / mse.mean : kNone, without.mean, without.standard_error};
    }
    error.psnr =
        error.rmse > 0.0 ? 20.0 * std::log10((peak > 0.0 ? peak : 1.0) / error.rmse) : std::numeric_limits<double>::infinity();
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
