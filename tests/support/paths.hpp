// SPDX-License-Identifier: Apache-2.0
// Where the files and programs are that tests use.
#pragma once

#include <cstdlib>
#include <string>

namespace gnomon::test {

/// The value of the environment's variable, else `built`.
inline std::string path_or(const char* variable, const char* built) {
    const char* path = std::getenv(variable);
    return path != nullptr ? path : built;
}

}  // namespace gnomon::test

/// The path that the build gave this macro, or that of the environment's variable of its name: a bundle is not where it was
/// built.
#define GN_PATH(name) gnomon::test::path_or(#name, name)
