// SPDX-License-Identifier: Apache-2.0
// How far one image is from another, channel by channel.
#pragma once

#include <cstdint>
#include <gnomon/render.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::io {

/// The error of values a against the reference b, over the n pixels where both are finite, in double precision. Without any
/// such pixel the errors are 0.
struct ChannelError {
    std::string name;
    double rmse = 0.0;        ///< sqrt(sum (a - b)^2 / n)
    double max = 0.0;         ///< max |a - b|
    double psnr = 0.0;        ///< 20 log10(peak / rmse) in dB, peak = max |b|, or 1 where that is 0; infinite where rmse is 0.
    double rel_mse = 0.0;     ///< sum ((a - b)^2 / (b^2 + 0.01)) / n
    uint64_t compared = 0;    ///< n
    uint64_t not_finite = 0;  ///< Pixels where a or b is NaN or infinite: in none of the errors above.
};

/// a and b have the same length.
ChannelError compare_channel(const std::string& name, std::span<const float> a, std::span<const float> b);

enum class Metric { rmse, max, psnr, rel_mse };

/// Is the error worse than the threshold: above it, or, for psnr, below it? A channel with values that are not finite always
/// is.
bool is_over(const ChannelError& error, Metric metric, double threshold);

}  // namespace gnomon::io
