// SPDX-License-Identifier: Apache-2.0
// Stages compiled at run time, for layouts that were not compiled with gnomon.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "layouts/layout.hpp"
#include "stages/programs.hpp"

namespace gnomon {

/// SPIR-V of a stage ("sample/shadow") with a layout. storage_reads: the variant whose read-only data are storage buffers.
/// Errors: ErrorKind::input, where the layout does not compile (with its file and line), or declares resources of its own.
std::vector<uint32_t> compile_stage(const std::string& stage, const Layout& layout, bool storage_reads);

/// Add the stages of a layout to the programs, where they are not there.
void add_stages(Programs& programs, const Layout& layout, const std::vector<std::string>& stages, bool storage_reads);

/// The stages of its own that an S-buffer in this layout goes through.
std::vector<std::string> s_buffer_stages(const Layout& layout);

}  // namespace gnomon
