// SPDX-License-Identifier: Apache-2.0
// How fast a device copies.
#pragma once

#include <string>

namespace gnomon::cli {

/// Bytes per second of a copy from one buffer of 64 MiB to another: the median of nine. device: as of Renderer.
/// Errors: as of Renderer; ErrorKind::out_of_memory.
double copy_rate(const std::string& device);

}  // namespace gnomon::cli
