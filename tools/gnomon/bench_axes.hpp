// SPDX-License-Identifier: Apache-2.0
// The axes of `gnomon bench`: settings that take several values in turn.
#pragma once

#include "bench_case.hpp"

namespace gnomon::cli {

/// "NAME=V1,V2,...". Errors: ErrorKind::usage for a form that is another, a value twice, an axis that cannot be varied, which
/// says why, or that there is not.
Axis parse_axis(const std::string& text);

/// Set what the axis says. Errors: ErrorKind::usage for a value that it cannot have.
void set_axis(const std::string& name, const std::string& value, BenchGroup& point);

/// All combinations of the values, the last axis changing fastest; of no axis one, without values.
std::vector<AxisValues> combinations(const std::vector<Axis>& axes);

/// The names, for help and errors.
std::string axis_names();

}  // namespace gnomon::cli
