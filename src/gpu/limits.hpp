// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: limits lower than the device's, for tests.
#pragma once

#include <string>

#include "gpu/gpu.hpp"

namespace gnomon::gpu {

/// `own` with what `text`, the value of GNOMON_LIMITS (see Device), lowers. Errors: ErrorKind::usage, naming the variable and
/// the names it knows, for one that is unknown or given twice, and for a value that is not a number or above the device's own.
Limits lower_limits(Limits own, const std::string& text);

}  // namespace gnomon::gpu
