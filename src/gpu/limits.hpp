// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: the limits of a device, or lower ones, for tests.
#pragma once

#include <string>

#include "gpu/vulkan.hpp"

namespace gnomon::gpu {

/// Of a device with Vulkan 1.3, whose heap, queue and subgroup size are known.
Limits own_limits(const Candidate& candidate);

/// `own` with what `text`, the value of GNOMON_LIMITS (see Device), lowers. Errors: ErrorKind::usage, naming the variable and
/// the names it knows, for one that is unknown or given twice, and for a value that is not a number or above the device's own.
Limits lower_limits(Limits own, const std::string& text);

}  // namespace gnomon::gpu
