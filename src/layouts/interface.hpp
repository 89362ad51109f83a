// SPDX-License-Identifier: Apache-2.0
// The GLSL that a layout's manifest stands for: blocks, texel buffers and accessors.
#pragma once

#include <string>

#include "layouts/manifest.hpp"

namespace gnomon {

/// What layout.glsl sees before its own text, in stages that write (LAYOUT_WRITE defined) and in those that read. Included as
/// "layout_interface.glsl", behind comp_shaders/common/s_buffer.glsl.
std::string layout_interface(const Layout& layout);

/// The names of the resources: the block that writes a buffer, the texel buffer that reads it; what is read of a size.
std::string written_name(const LayoutBuffer& buffer);
std::string read_name(const LayoutSize& size);

}  // namespace gnomon
