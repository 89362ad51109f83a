// SPDX-License-Identifier: Apache-2.0
// Repeated measurements of one quantity.
#pragma once

#include <vector>

namespace gnomon::timing {

struct Summary {
    std::vector<double> samples;  ///< In the order in which they were taken.
    double median = 0.0;
    double q1 = 0.0;  ///< A quarter of the samples is below, by linear interpolation between two of them; likewise q3.
    double q3 = 0.0;
    double least = 0.0;
    double most = 0.0;
};

/// Of at least one sample.
Summary summarize(std::vector<double> samples);

/// The value below which a share of 0 to 1 of sorted values lies: that of rank share * (n - 1), linear between two of them.
double quantile(const std::vector<double>& sorted, double share);

double mean(const std::vector<double>& samples);

/// Of a sample: with n - 1; 0 of a single one.
double standard_deviation(const std::vector<double>& samples);

}  // namespace gnomon::timing
