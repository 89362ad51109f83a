// SPDX-License-Identifier: Apache-2.0
// What `main` of a tool beside the command `gnomon` does.
#pragma once

#include <CLI/CLI.hpp>
#include <gnomon/error.hpp>
#include <iostream>
#include <new>
#include <string>

namespace gnomon::tools {

/// Parse the command line, then run(). Errors become one line on stderr and their kind's exit code; out_of_memory says what to
/// do when the host has no more memory.
template <class Run>
int tool_main(CLI::App& app, int argc, char** argv, const std::string& out_of_memory, Run run) {
    const auto fail = [&](const std::string& message, ErrorKind kind) {
        std::cerr << app.get_name() << ": error: " << message << '\n';
        return static_cast<int>(kind);
    };
    try {
        app.parse(argc, argv);
        run();
        return 0;
    } catch (const CLI::Success& request) {  // --help or --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        return fail(std::string(error.what()) + ", command line; see '" + app.get_name() + " --help'", ErrorKind::usage);
    } catch (const Error& error) {
        return fail(error.what(), error.kind());
    } catch (const std::bad_alloc&) {
        return fail("out of memory, on the host; " + out_of_memory, ErrorKind::out_of_memory);
    } catch (const std::exception& error) {
        return fail(std::string("internal error: ") + error.what(), ErrorKind::internal);
    }
}

}  // namespace gnomon::tools
