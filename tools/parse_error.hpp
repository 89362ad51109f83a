// SPDX-License-Identifier: Apache-2.0
// What a command line that does not parse is told.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <gnomon/error.hpp>
#include <string>
#include <vector>

namespace gnomon::tools {

/// CLI11's own text, but for arguments that nothing takes: it names those from the last to the first.
inline std::string parse_error_text(const CLI::App& app, const CLI::ParseError& error) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return error.what();
    return "not expected: " + CLI::detail::join(app.remaining(true), " ");
}

/// An option whose value is empty, as where a script's variable is not set, is not one that was left out.
/// Errors: ErrorKind::usage.
inline void refuse_empty_values(const CLI::App& app) {
    for (const CLI::Option* option : app.get_options()) {
        const std::vector<std::string>& values = option->results();
        if (option->nonpositional() && std::find(values.begin(), values.end(), "") != values.end())
            throw Error(ErrorKind::usage, "the value is empty", option->get_name(), "give one, or leave the option out");
    }
    for (const CLI::App* command : app.get_subcommands()) refuse_empty_values(*command);
}

}  // namespace gnomon::tools
