// SPDX-License-Identifier: Apache-2.0
// The sources of the stages and of the layouts that are built in.
#pragma once

#include <optional>
#include <string_view>

namespace gnomon {

/// The text of a file below comp_shaders, "common/stage.glsl"; nothing, if there is none.
std::optional<std::string_view> find_source(std::string_view name);

}  // namespace gnomon
