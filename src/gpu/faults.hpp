// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: what is known to be wrong with drivers.
#pragma once

#include <string>
#include <vector>

#include "gpu/vulkan.hpp"

namespace gnomon::gpu {

/// The known faults of a driver of this version (as the driver writes it), in words, each with how it is avoided.
std::vector<std::string> faults_of(VkDriverId driver, const std::string& version);

}  // namespace gnomon::gpu
