// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include <gnomon/error.hpp>
#include <gnomon/version.hpp>

#include "parse_error.hpp"

namespace gnomon::cli {

CommandLine::CommandLine()
    : app_("gnomon renders glTF scenes with motion-blurred shadows, in Vulkan compute shaders.", "gnomon") {
    app_.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    app_.require_subcommand(0, 1);  // None is an error below: CLI11 would not name an unknown one.
    app_.get_formatter()->column_width(36);
    add_render(app_, invocation_);
    add_info(app_, invocation_);
    add_devices(app_, invocation_);
    add_doctor(app_, invocation_);
    add_layouts(app_, invocation_);
    add_methods(app_, invocation_);
    add_bench(app_, invocation_);
    add_compare(app_, invocation_);
    add_probe(app_, invocation_);
    add_sbuffer(app_, invocation_);
    add_ranges(app_, invocation_);
    add_report(app_, invocation_);
#ifdef GNOMON_HAS_REFERENCE
    add_reproduce(app_, invocation_);
#endif
}

Invocation& CommandLine::parse(int argc, const char* const* argv) {
    invocation_.arguments.assign(argv, argv + argc);
    try {
        app_.parse(argc, argv);
    } catch (const CLI::Success& request) {  // --help or --version
        invocation_.run = [this, request] { return app_.exit(request); };
        return invocation_;
    } catch (const CLI::ParseError& error) {
        const auto commands = app_.get_subcommands();
        const std::string name = commands.empty() ? "gnomon" : "gnomon " + commands.front()->get_name();
        throw Error(ErrorKind::usage, tools::parse_error_text(app_, error), "command line", "see '" + name + " --help'");
    }
    tools::refuse_empty_values(app_);
    if (!invocation_.run) throw Error(ErrorKind::usage, "no command given", "command line", "see 'gnomon --help'");
    return invocation_;
}

}  // namespace gnomon::cli
