// SPDX-License-Identifier: Apache-2.0
// The command `gnomon`: parses the command line, runs a subcommand, turns exceptions into exit codes.
#include <spdlog/spdlog.h>

#include <csignal>
#include <gnomon/error.hpp>
#include <gnomon/version.hpp>
#include <iostream>
#include <new>

#include "command.hpp"
#include "io/atomic_file.hpp"
#include "parse_error.hpp"

namespace {

using gnomon::Error;
using gnomon::ErrorKind;

int run(int argc, char** argv) {
    gnomon::cli::Invocation invocation;
    CLI::App app("gnomon renders glTF scenes with motion-blurred shadows, in Vulkan compute shaders.", "gnomon");
    app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    app.require_subcommand(0, 1);  // None is an error below: CLI11 would not name an unknown one.
    app.get_formatter()->column_width(36);
    gnomon::cli::add_render(app, invocation);
    gnomon::cli::add_info(app, invocation);
    gnomon::cli::add_devices(app, invocation);
    gnomon::cli::add_doctor(app, invocation);
    gnomon::cli::add_methods(app, invocation);
    gnomon::cli::add_compare(app, invocation);
    gnomon::cli::add_probe(app, invocation);
    gnomon::cli::add_sbuffer(app, invocation);
    gnomon::cli::add_ranges(app, invocation);
#ifdef GNOMON_HAS_REFERENCE
    gnomon::cli::add_reproduce(app, invocation);
#endif

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {  // --help or --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        const auto commands = app.get_subcommands();
        const std::string name = commands.empty() ? "gnomon" : "gnomon " + commands.front()->get_name();
        throw Error(ErrorKind::usage, gnomon::tools::parse_error_text(app, error), "command line", "see '" + name + " --help'");
    }
    gnomon::tools::refuse_empty_values(app);
    if (!invocation.run) throw Error(ErrorKind::usage, "no command given", "command line", "see 'gnomon --help'");
    spdlog::set_level(invocation.quiet ? spdlog::level::err : invocation.verbose ? spdlog::level::debug : spdlog::level::info);
    return invocation.run();
}

}  // namespace

int main(int argc, char** argv) {
    // A file over the limit on sizes is then an error of the write, and its temporary file is removed.
    std::signal(SIGXFSZ, SIG_IGN);
    gnomon::io::remove_unfinished_files_on_signals();
    gnomon::cli::start_log();
    try {
        const int exit_code = run(argc, argv);
        if (!std::cout.flush())
            throw Error(ErrorKind::input, "cannot write the results", "standard output", "send them to a file with free space");
        return exit_code;
    } catch (const Error& error) {
        spdlog::error("{}", error.what());
        return error.exit_code();
    } catch (const std::bad_alloc&) {
        spdlog::error("out of memory, on the host; render a smaller image or a smaller scene");
        return static_cast<int>(ErrorKind::out_of_memory);
    } catch (const std::exception& error) {
        spdlog::error("internal error: {}, gnomon " GNOMON_VERSION "; please report it", error.what());
        return static_cast<int>(ErrorKind::internal);
    }
}
