// SPDX-License-Identifier: Apache-2.0
// From numbers to places along an axis.
#pragma once

#include <vector>

namespace gnomon::html {

/// 0 and evenly spaced round numbers after it, until one is not below `most`.
std::vector<double> ticks(double most);

/// Round numbers within [least, most], both above 0: powers of ten, or 1, 2 and 5 times such, or evenly spaced where that is
/// too few.
std::vector<double> logarithmic_ticks(double least, double most);

class Scale {
public:
    /// From 0 at `from` to a round number at `to`, not below `most`.
    static Scale linear(double most, double from, double to);

    /// From `least` at `from` to `most` at `to`, both above 0, with some room beyond either.
    static Scale logarithmic(double least, double most, double from, double to);

    /// With ticks at these numbers, in ascending order; `logarithmic` or not, with room beyond the first and last.
    static Scale with_ticks(std::vector<double> ticks, bool logarithmic, double from, double to);

    /// The place of a number; of one that is beyond the ends, the end.
    double at(double value) const;
    const std::vector<double>& ticks() const { return ticks_; }
    bool is_logarithmic() const { return logarithmic_; }
    double from() const { return from_; }
    double to() const { return to_; }

private:
    Scale(std::vector<double> ticks, bool logarithmic, double least, double most, double from, double to);

    std::vector<double> ticks_;
    bool logarithmic_;
    double least_, most_, from_, to_;
};

}  // namespace gnomon::html
