// SPDX-License-Identifier: Apache-2.0
// The manifest of a layout, and the GLSL that it stands for.
#include "layouts/layout.hpp"
#include "layouts/interface.hpp"

#include "expected_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    const std::string_view text(reinterpret_cast<const char*>(data), bytes);
    fuzz::try_input(ErrorKind::input, [&] { layout_interface(with_ranges(parse_layout(text, "layout.json"), true)); });
    return 0;
}
