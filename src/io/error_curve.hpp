// SPDX-License-Identifier: Apache-2.0
// The error of a method against the seconds that it takes: methods are compared after equal seconds and at equal error.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gnomon::io {

/// One render of a method.
struct CurvePoint {
    double seconds = 0.0;         ///< Above 0.
    double error = 0.0;           ///< Above 0; in any unit.
    double standard_error = 0.0;  ///< Of the error.
};

/// What a curve says at one place. The numbers are NaN outside of what was measured.
struct CurveValue {
    enum class Where { before_first, measured, after_last };
    Where where = Where::measured;
    double value = std::numeric_limits<double>::quiet_NaN();
    double standard_error = std::numeric_limits<double>::quiet_NaN();
};

/// A polyline through the renders of one method in log(seconds) and log(error), which is straight where the error falls with a
/// power of the samples. It says nothing beyond its ends. Standard errors are those of the two renders on either side, taken as
/// independent, to first order.
class ErrorCurve {
public:
    /// In any order. Errors, which say whose curve it is: ErrorKind::input where there is no point, two took the same seconds,
    /// seconds or an error are not finite and above 0, or a standard error is not finite and at least 0.
    explicit ErrorCurve(std::vector<CurvePoint> points, const std::string& name = "");

    /// By seconds.
    const std::vector<CurvePoint>& points() const { return points_; }

    /// The error after so many seconds. before_first: fewer than the first render took; after_last: more than the last did.
    CurveValue error_after(double seconds) const;

    /// The seconds after which the error is first so small. before_first: it is smaller at the first render; after_last: no
    /// render reaches it. The standard error is NaN where a curve of one point has no slope to tell it.
    CurveValue seconds_to(double error) const;

private:
    std::vector<CurvePoint> points_;
};

}  // namespace gnomon::io
