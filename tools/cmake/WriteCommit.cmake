# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a header with the commit that SOURCE is at: run at each build, it is written anew only where that changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=40 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "// The commit of git that this is built from, \"-dirty\" where files were changed since; \"unknown\" without git.
#pragma once

namespace gnomon {

inline constexpr const char* kCommit = \"${commit}\";

}  // namespace gnomon
" @ONLY)
