// SPDX-License-Identifier: Apache-2.0
// What the subcommands share: how they are registered, what they return, where their results go.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <gnomon/render.hpp>
#include <string>
#include <vector>

#include "io/report.hpp"

namespace gnomon::cli {

/// Exit codes that are not those of an ErrorKind.
enum ExitCode : int { kDone = 0, kLostEntries = 7, kOverThreshold = 8, kWrongResult = 9 };

/// What the command line asks for: filled while it is parsed, run after.
struct Invocation {
    std::function<int()> run;                 ///< Returns the exit code.
    std::vector<std::string> arguments = {};  ///< All, from the program's name on.
    bool quiet = false;
    bool verbose = false;
};

/// A subcommand with the options that all have.
CLI::App* add_command(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& description);

/// Warn where an option was given that has no effect without another one.
void warn_if_unused(const CLI::App& command, const std::string& option, const std::string& needed);

void add_render(CLI::App& app, Invocation& invocation);
void add_info(CLI::App& app, Invocation& invocation);
void add_devices(CLI::App& app, Invocation& invocation);
void add_doctor(CLI::App& app, Invocation& invocation);
void add_layouts(CLI::App& app, Invocation& invocation);
void add_methods(CLI::App& app, Invocation& invocation);
void add_bench(CLI::App& app, Invocation& invocation);
void add_compare(CLI::App& app, Invocation& invocation);
void add_probe(CLI::App& app, Invocation& invocation);
void add_sbuffer(CLI::App& app, Invocation& invocation);
void add_ranges(CLI::App& app, Invocation& invocation);
void add_report(CLI::App& app, Invocation& invocation);
void add_reproduce(CLI::App& app, Invocation& invocation);  ///< Only where the reference is built (GNOMON_HAS_REFERENCE).

/// Messages go to stderr as `gnomon: LEVEL: TEXT`, TEXT as printable() makes it, in colour on a terminal unless NO_COLOR is
/// set.
void start_log();

/// Say which device renders, and warn where it is a CPU that was not asked for.
void log_device(const DeviceDescription& device, bool was_named);

/// Write a document to a file, or, for "-", to stdout; indent -1: on one line.
void write_json(const std::string& target, const io::Json& json, int indent = 2);

/// A line of results for people, as printable() makes it.
void print_line(const std::string& text);

/// A label and a value, one line of a table for people.
void print_row(const std::string& label, const std::string& value);

}  // namespace gnomon::cli
