// SPDX-License-Identifier: Apache-2.0
// The file of a texture, PNG or JPEG.
#include <cstdint>
#include <cstdlib>

#include "scene/stb_image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon::gltf;
    constexpr uint64_t kMostTexels = uint64_t{1} << 22;  // Larger ones say nothing new, and take long.
    if (bytes == 0) return 0;
    std::string reason;
    const std::optional<ImageSize> size = image_size({data, bytes}, reason);
    if (!size && reason.empty()) std::abort();
    if (!size || uint64_t{size->width} * size->height > kMostTexels) return 0;
    const std::vector<uint8_t> texels = decode_rgba({data, bytes}, *size, reason);
    if (texels.empty() ? reason.empty() : texels.size() != size_t{4} * size->width * size->height) std::abort();
    return 0;
}
