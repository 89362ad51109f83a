// SPDX-License-Identifier: Apache-2.0
// How far one image is from another, channel by channel.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace gnomon::io {

/// What sampling noise has in an error.
struct NoiseShare {
    double variance = 0.0;  ///< Of a - b, mean over the pixels.
    double share = 0.0;     ///< Of rmse^2; NaN where rmse is 0.
    /// rmse^2 - variance: the mean square of what the images would differ by without noise. Its expectation is right, so that
    /// it may be negative where there is little but noise.
    double mse_without = 0.0;
    double mse_without_standard_error = 0.0;
};

/// The error of values a against the reference b, over the n pixels where both are finite, in double precision. Without any
/// such pixel the errors are 0. Standard errors are those of pixel_mean, all NaN where n is below 2. Where there is a second
/// image of the same expectation as a, they are those of the mean that the two errors' difference has, over sqrt(2): the spread
/// over the seeds of a, whatever is expected of the pixels.
struct ChannelError {
    std::string name;
    double bias = 0.0;  ///< sum (a - b) / n
    double bias_standard_error = 0.0;
    double rmse = 0.0;                 ///< sqrt(sum (a - b)^2 / n)
    double rmse_standard_error = 0.0;  ///< That of rmse^2, over 2 rmse; 0 where rmse is 0.
    double max = 0.0;                  ///< max |a - b|
    double psnr = 0.0;     ///< 20 log10(peak / rmse) in dB, peak = max |b|, or 1 where that is 0; infinite where rmse is 0.
    double rel_mse = 0.0;  ///< sum ((a - b)^2 / (b^2 + 0.01)) / n
    double rel_mse_standard_error = 0.0;
    std::optional<NoiseShare> noise = {};  ///< Where it is known.
    uint64_t compared = 0;                 ///< n
    uint64_t not_finite = 0;  ///< Pixels where a, b or what tells the noise is NaN or infinite: in none of the errors above.
};

/// What tells the noise of a - b: at most one of these.
struct PixelNoise {
    std::span<const double> variances;  ///< Of each pixel; that their expectation is right is enough.
    std::span<const float> again;       ///< An image of the same expectation as a, with noise of its own. Says nothing of b's.
};

/// a and b, and what is not empty of the noise, have the same length: rows of `width`.
ChannelError compare_channel(const std::string& name, std::span<const float> a, std::span<const float> b, uint32_t width,
                             const PixelNoise& noise = {});

enum class Metric { rmse, max, psnr, rel_mse };

/// Is the error worse than the threshold: above it, or, for psnr, below it? A channel with values that are not finite always
/// is.
bool is_over(const ChannelError& error, Metric metric, double threshold);

}  // namespace gnomon::io
