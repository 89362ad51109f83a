// SPDX-License-Identifier: Apache-2.0
// The bounds on JSON, and text that a terminal is shown: what passes must parse, and be one line.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "expected_error.hpp"
#include "text/json_bounds.hpp"
#include "text/printable.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    const std::string_view text(reinterpret_cast<const char*>(data), bytes);
    const std::string line = printable(text);
    if (std::any_of(line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; })) std::abort();
    fuzz::try_input(ErrorKind::input, [&] {
        check_json(text, "input", "repair it");
        [[maybe_unused]] const nlohmann::json parsed = nlohmann::json::parse(text);
    });
    return 0;
}
