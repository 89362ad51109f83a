// SPDX-License-Identifier: Apache-2.0
// The one exception type of gnomon. Environment and input errors are thrown as gnomon::Error; logic errors are asserts.
#pragma once

#include <stdexcept>
#include <string>

namespace gnomon {

/// Why something failed. The value is the exit code of the command.
enum class ErrorKind : int {
    internal = 1,       ///< A bug in gnomon.
    usage = 2,          ///< Options that do not parse or contradict each other.
    input = 3,          ///< An input is missing, unreadable or invalid; or an output cannot be written.
    no_device = 4,      ///< No Vulkan device has what gnomon needs.
    out_of_memory = 5,  ///< Out of device memory, or over the memory budget.
    device_lost = 6,    ///< The driver gave up while work was running.
};

/// what: what is wrong. where: file, object or option. hint: what to do about it.
class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& what, const std::string& where, const std::string& hint)
        : std::runtime_error(what + (where.empty() ? "" : ", " + where) + (hint.empty() ? "" : "; " + hint)), kind_(kind) {}

    ErrorKind kind() const { return kind_; }
    int exit_code() const { return static_cast<int>(kind_); }

private:
    ErrorKind kind_;
};

}  // namespace gnomon
