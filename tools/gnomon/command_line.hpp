// SPDX-License-Identifier: Apache-2.0
// The command line of `gnomon`: what it asks for.
#pragma once

#include "command.hpp"

namespace gnomon::cli {

/// All subcommands with their options. Not to be moved: what is run refers to it.
class CommandLine {
public:
    CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// What is asked for; of --help and --version, to print them. Errors: ErrorKind::usage.
    Invocation& parse(int argc, const char* const* argv);

private:
    CLI::App app_;
    Invocation invocation_;
};

}  // namespace gnomon::cli
