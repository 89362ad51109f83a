// SPDX-License-Identifier: Apache-2.0
// The command `gnomon`: parses the command line, runs a subcommand, turns exceptions into exit codes.
#include <spdlog/spdlog.h>

#include <csignal>
#include <gnomon/error.hpp>
#include <gnomon/version.hpp>
#include <iostream>
#include <new>

#include "command_line.hpp"
#include "io/atomic_file.hpp"

namespace {

using gnomon::Error;
using gnomon::ErrorKind;

int run(int argc, char** argv) {
    gnomon::cli::CommandLine command_line;
    const gnomon::cli::Invocation& invocation = command_line.parse(argc, argv);
    spdlog::set_level(invocation.quiet ? spdlog::level::err : invocation.verbose ? spdlog::level::debug : spdlog::level::info);
    return invocation.run();
}

}  // namespace

int main(int argc, char** argv) {
    // A file over the limit on sizes is then an error of the write, and its temporary file is removed.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        gnomon::io::end_cleanly("gnomon", "render a smaller image or a smaller scene");
        gnomon::cli::start_log();
        const int exit_code = run(argc, argv);
        if (!std::cout.flush())
            throw Error(ErrorKind::input, "cannot write the results", "standard output", "send them to a file with free space");
        return exit_code;
    } catch (const Error& error) {
        spdlog::error("{}", error.what());
        return error.exit_code();
    } catch (const std::bad_alloc&) {
        gnomon::io::end_without_memory();
    } catch (const std::exception& error) {
        spdlog::error("internal error: {}, gnomon " GNOMON_VERSION "; please report it", error.what());
        return static_cast<int>(ErrorKind::internal);
    }
}
