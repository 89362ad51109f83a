// SPDX-License-Identifier: Apache-2.0
// The mean over the pixels of a picture, and how sure it is.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::io {

/// Without a pixel the mean is 0.
struct PixelMean {
    double mean = 0.0;
    double standard_error = std::numeric_limits<double>::quiet_NaN();  ///< NaN where fewer than two pixels have a value.
    uint64_t count = 0;                                                ///< Pixels that have one.
};

/// The mean of n values, rows of `width`; those that are NaN are left out.
///
/// Neighbouring pixels may depend on each other, as where they read one texel of a shadow map. So the picture is cut into
/// blocks of about n^(1/4) pixels along a side, which grow as the picture does (Nordman and Lahiri 2004, "On optimal spatial
/// subsample size for variance estimation"). Of the sums of 2 x 2 blocks, less the mean, a - b - c + d has the variance of a +
/// b + c + d and no expectation but that of what changes along both axes at once: the idea of collapsed strata (Cochran 1977,
/// "Sampling techniques", section 5A.12). So the standard error is the spread of the mean over the seeds where what is expected
/// of the pixels changes smoothly, and more where it does not. It is too small where the dependence reaches as far as a block.
PixelMean pixel_mean(std::span<const double> values, uint32_t width);

/// The standard error of the mean of `values` where `again` has the same expectation in each pixel and is independent: that of
/// the mean of what they differ by, over sqrt(2). It is the spread of the mean over the seeds whatever is expected of the
/// pixels.
double standard_error_of_two(std::span<const double> values, std::span<const double> again, uint32_t width);

}  // namespace gnomon::io
