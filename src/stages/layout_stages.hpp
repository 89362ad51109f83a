// SPDX-License-Identifier: Apache-2.0
// The stages that depend on a layout.
#pragma once

#include "layouts/layout.hpp"
#include "stages/programs.hpp"

namespace gnomon {

/// The stages of its own that an S-buffer in this layout goes through.
std::vector<std::string> s_buffer_stages(const Layout& layout);

/// Add these and `stages` ("sample/shadow"), compiled for the layout, to the programs, where they are not there.
/// Errors: ErrorKind::input, as of compile_stage.
void add_layout_stages(gpu::Device& device, Programs& programs, const Layout& layout, const std::vector<std::string>& stages);

}  // namespace gnomon
