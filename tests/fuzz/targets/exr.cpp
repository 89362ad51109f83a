// SPDX-License-Identifier: Apache-2.0
// An image that `gnomon compare` reads.
#include "io/exr.hpp"

#include "expected_error.hpp"
#include "input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    static const fuzz::InputFile file;
    fuzz::try_input(ErrorKind::input, [&] {
        const io::ExrImage image = io::read_exr(file.path_with(data, bytes));
        for (const Channel& channel : image.channels) {
            if (channel.values.size() != size_t{image.width} * image.height) std::abort();
        }
    });
    return 0;
}
