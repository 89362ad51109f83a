// SPDX-License-Identifier: Apache-2.0
// What a command line that does not parse is told.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gnomon::tools {

/// CLI11's own text, but for arguments that nothing takes: it names those from the last to the first.
inline std::string parse_error_text(const CLI::App& app, const CLI::ParseError& error) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return error.what();
    return "not expected: " + CLI::detail::join(app.remaining(true), " ");
}

}  // namespace gnomon::tools
