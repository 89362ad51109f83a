// SPDX-License-Identifier: Apache-2.0
// Stages compiled at run time for a layout that is not built in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "layouts/layout.hpp"

namespace gnomon {

/// SPIR-V of a stage ("sample/shadow") with the layout.glsl in `layout.folder`, as the build makes it for a built-in layout.
/// storage_reads: the variant whose read-only data are storage buffers. `layout` has the buffers that the stage's method wants
/// (with_ranges). Errors: ErrorKind::input, where the layout does not compile (with its file and line), or declares other
/// buffers than its manifest.
std::vector<uint32_t> compile_stage(const std::string& stage, const Layout& layout, bool storage_reads);

}  // namespace gnomon
