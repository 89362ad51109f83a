# SPDX-License-Identifier: Apache-2.0
# Run as a script: writes the files NAMES of FOLDER, as text by name, into the header OUTPUT.
set(entries "")
foreach(name IN LISTS NAMES)
  file(READ ${FOLDER}/${name} text)
  string(APPEND entries "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// SPDX-License-Identifier: Apache-2.0
// Made by CMake: the GLSL sources of the stages, for what is compiled at run time.
#pragma once

#include <string_view>

namespace gnomon {

struct SourceEntry {
    std::string_view name;  // As in an include directive: \"common/stage.glsl\".
    std::string_view text;
};

inline constexpr SourceEntry kSourceTable[] = {
${entries}};

}  // namespace gnomon
")
