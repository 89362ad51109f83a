// SPDX-License-Identifier: Apache-2.0
// What `render --json` has written, as `gnomon compare` reads it back.
#include "expected_error.hpp"
#include "input_file.hpp"
#include "render_curves.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    static const fuzz::InputFile file;
    fuzz::try_input(ErrorKind::input, [&] {
        cli::CompareOptions options;
        options.files = {file.path_with(data, bytes), "/nonexistent/reference.exr"};
        cli::render_curves(options);
    });
    return 0;
}
