// SPDX-License-Identifier: Apache-2.0
// stb_image's code, for PNG and JPEG from memory only.
#include "scene/stb_image.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

#include <memory>

namespace gnomon::gltf {

std::optional<ImageSize> image_size(std::span<const uint8_t> file, std::string& reason) {
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels) == 0) {
        reason = stbi_failure_reason();
        return std::nullopt;
    }
    return ImageSize{static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

std::vector<uint8_t> decode_rgba(std::span<const uint8_t> file, std::string& reason) {
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
        stbi_load_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels, 4), stbi_image_free);
    if (!texels) {
        reason = stbi_failure_reason();
        return {};
    }
    return {texels.get(), texels.get() + size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height)};
}

}  // namespace gnomon::gltf
