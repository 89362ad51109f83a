// SPDX-License-Identifier: Apache-2.0
// The manifest of a layout.
#include "layouts/layout.hpp"

#include "expected_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    const std::string_view text(reinterpret_cast<const char*>(data), bytes);
    fuzz::try_input(ErrorKind::input, [&] { with_ranges(parse_layout(text, "layout.json"), false); });
    return 0;
}
