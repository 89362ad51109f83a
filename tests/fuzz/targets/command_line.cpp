// SPDX-License-Identifier: Apache-2.0
// The arguments of the command, one a line. They are parsed; nothing runs.
#include "command_line.hpp"

#include <algorithm>

#include "expected_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    std::string text(reinterpret_cast<const char*>(data), bytes);
    std::vector<char*> arguments = {text.data() + text.size()};  // The program's name: empty.
    for (auto at = text.begin(); at != text.end();) {
        const auto end = std::find(at, text.end(), '\n');
        arguments.push_back(&*at);
        if (end == text.end()) break;
        *end = '\0';
        at = end + 1;
    }
    static cli::CommandLine command_line;  // To make one takes a hundred times as long as to parse; it forgets what was parsed.
    fuzz::try_input(ErrorKind::usage, [&] { command_line.parse(static_cast<int>(arguments.size()), arguments.data()); });
    return 0;
}
