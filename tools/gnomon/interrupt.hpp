// SPDX-License-Identifier: Apache-2.0
// Ctrl-C.
#pragma once

namespace gnomon::cli {

/// From now on the first SIGINT or SIGTERM sets interrupted(), and the second one ends the process.
void catch_interrupts();

bool interrupted();

}  // namespace gnomon::cli
