// SPDX-License-Identifier: Apache-2.0
// How far one image is from another, channel by channel.
#include "io/image_compare.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace gnomon::io {

ChannelError compare_channel(const std::string& name, std::span<const float> a, std::span<const float> b) {
    assert(a.size() == b.size());
    ChannelError error{.name = name};
    double square_sum = 0.0;
    double relative_sum = 0.0;
    double peak = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        if (!std::isfinite(a[i]) || !std::isfinite(b[i])) {
            ++error.not_finite;
            continue;
        }
        const double reference = b[i];
        const double difference = a[i] - reference;
        ++error.compared;
        square_sum += difference * difference;
        relative_sum += difference * difference / (reference * reference + 0.01);
        error.max = std::max(error.max, std::abs(difference));
        peak = std::max(peak, std::abs(reference));
    }
    if (error.compared > 0) {
        error.rmse = std::sqrt(square_sum / static_cast<double>(error.compared));
        error.rel_mse = relative_sum / static_cast<double>(error.compared);
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
