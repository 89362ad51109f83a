// SPDX-License-Identifier: Apache-2.0
// What bad input may end in.
#pragma once

#include <cstdlib>
#include <gnomon/error.hpp>

namespace gnomon::fuzz {

/// Runs what is to be tried. Any exception but a gnomon::Error of this kind, with a text, is a crash.
template <class Run>
void try_input(ErrorKind kind, Run run) {
    try {
        run();
    } catch (const Error& error) {
        if (error.kind() != kind || error.what()[0] == '\0') std::abort();
    }
}

}  // namespace gnomon::fuzz
