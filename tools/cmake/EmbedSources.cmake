# SPDX-License-Identifier: Apache-2.0
# Run as a script: writes the files NAMES of FOLDER, as text by name, into the header OUTPUT, as the array TABLE.
set(entries "")
foreach(name IN LISTS NAMES)
  file(READ ${FOLDER}/${name} text)
  string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// SPDX-License-Identifier: Apache-2.0
// Made by CMake: files as text, by name.
#pragma once

#include <string_view>

namespace gnomon {

struct EmbeddedFile {
    std::string_view name;  // Below the folder: \"common/stage.glsl\".
    std::string_view text;
};

inline constexpr EmbeddedFile ${TABLE}[] = {
${entries}};

}  // namespace gnomon
")
