// SPDX-License-Identifier: Apache-2.0
// An image that `gnomon compare` reads.
#include "io/exr.hpp"

#include <array>
#include <cstring>
#include <string_view>

#include "expected_error.hpp"
#include "input_file.hpp"

namespace {

// Pictures with longer sides say nothing new, and take long.
bool is_small(const uint8_t* data, size_t bytes) {
    constexpr int64_t kMostSide = 256;
    constexpr std::string_view kName("dataWindow\0box2i\0\x10\0\0\0", 21);
    const std::string_view text(reinterpret_cast<const char*>(data), bytes);
    const size_t at = text.find(kName);
    std::array<int32_t, 4> window{};
    if (at == std::string_view::npos || bytes - at < kName.size() + sizeof window) return true;  // It is refused.
    std::memcpy(window.data(), data + at + kName.size(), sizeof window);
    return int64_t{window[2]} - window[0] < kMostSide && int64_t{window[3]} - window[1] < kMostSide;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    if (!is_small(data, bytes)) return 0;
    static const fuzz::InputFile file;
    fuzz::try_input(ErrorKind::input, [&] {
        const io::ExrImage image = io::read_exr(file.path_with(data, bytes));
        for (const Channel& channel : image.channels) {
            if (channel.values.size() != size_t{image.width} * image.height) std::abort();
        }
    });
    return 0;
}
