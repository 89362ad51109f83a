// SPDX-License-Identifier: Apache-2.0
// What `main` of a tool beside the command `gnomon` does.
#pragma once

#include <CLI/CLI.hpp>
#include <gnomon/error.hpp>
#include <iostream>
#include <new>
#include <string>

#include "io/atomic_file.hpp"
#include "parse_error.hpp"
#include "text/printable.hpp"

namespace gnomon::tools {

struct Tool {
    const char* name;
    const char* description;
    const char* out_of_memory;  ///< What to do when the host has no more memory.
};

/// Parse the command line into Options, with add_options(app, options), then run(options). Errors become one line on stderr and
/// their kind's exit code.
template <class Options, class Run>
int tool_main(const Tool& tool, int argc, char** argv, void (*add_options)(CLI::App&, Options&), Run run) {
    const auto fail = [&](const std::string& message, ErrorKind kind) {
        std::cerr << tool.name << ": error: " << printable(message) << '\n';
        return static_cast<int>(kind);
    };
    try {
        io::end_cleanly(tool.name, tool.out_of_memory);
        CLI::App app(tool.description, tool.name);
        Options options;
        add_options(app, options);
        try {
            app.parse(argc, argv);
        } catch (const CLI::Success& request) {  // --help or --version
            return app.exit(request);
        } catch (const CLI::ParseError& error) {
            return fail(parse_error_text(app, error) + ", command line; see '" + tool.name + " --help'", ErrorKind::usage);
        }
        refuse_empty_values(app);
        run(options);
        return 0;
    } catch (const Error& error) {
        return fail(error.what(), error.kind());
    } catch (const std::bad_alloc&) {
        io::end_without_memory();
    } catch (const std::exception& error) {
        return fail(std::string("internal error: ") + error.what(), ErrorKind::internal);
    }
}

}  // namespace gnomon::tools
