// SPDX-License-Identifier: Apache-2.0
// Stages compiled at run time, for layouts that were not compiled with gnomon.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "layouts/layout.hpp"

namespace gnomon {

/// SPIR-V of a stage ("sample/shadow") with a layout. storage_reads: the variant whose read-only data are storage buffers.
/// bound: names of what the stage binds with any layout. Errors: ErrorKind::input, where the layout does not compile (with its
/// file and line), or declares resources of its own.
std::vector<uint32_t> compile_stage(const std::string& stage, const Layout& layout, bool storage_reads,
                                    const std::set<std::string>& bound);

}  // namespace gnomon
