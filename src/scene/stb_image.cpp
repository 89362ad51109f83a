// SPDX-License-Identifier: Apache-2.0
// stb_image's code, for PNG and JPEG from memory only.
#include "scene/stb_image.hpp"

#include <cstdlib>

namespace {

// stb_image unpacks PNG data as far as they go, whatever size the header states: its allocations are bounded here.
thread_local size_t largest_allocation = 0;

void* bounded_malloc(size_t bytes) { return bytes > largest_allocation ? nullptr : std::malloc(bytes); }
void* bounded_realloc(void* block, size_t bytes) { return bytes > largest_allocation ? nullptr : std::realloc(block, bytes); }

}  // namespace

#define STBI_MALLOC(bytes) bounded_malloc(bytes)
#define STBI_REALLOC(block, bytes) bounded_realloc(block, bytes)
#define STBI_FREE(block) std::free(block)
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

#include <algorithm>
#include <memory>
#include <numeric>

namespace gnomon::gltf {

namespace {

constexpr size_t kDecoderState = size_t{1} << 20;  // More than what stb_image keeps beside texels and packed data.

// Texels that a byte of the file can hold at most. PNG: eight of a bit each, and deflate makes at most 1032 of one. JPEG:
// blocks of 8x8 with a code of a bit for each.
uint64_t most_texels_of_byte(std::span<const uint8_t> file) {
    constexpr uint8_t kJpeg = 0xff;
    return file[0] == kJpeg ? 8 * 64 : 8 * 1032;
}

// stb_image before 2.28 writes past the end of its tables where a Huffman table of a JPEG has more codes than there are values
// (tests/fuzz/regressions/image). Walks the segments as it does: what lies between them, as coded texels, is passed over to the
// next marker.
bool has_too_many_codes(std::span<const uint8_t> file) {
    constexpr size_t kLengths = 16, kMostCodes = 256;
    constexpr uint8_t kTables = 0xc4, kFirstBare = 0xd0, kLastBare = 0xd9;  // Restarts, begin and end have no content.
    for (size_t at = 0;;) {
        while (at < file.size() && file[at] != 0xff) ++at;
        while (at < file.size() && file[at] == 0xff) ++at;
        if (at + 3 > file.size()) return false;
        const uint8_t marker = file[at++];
        if (marker <= 1 || (marker >= kFirstBare && marker <= kLastBare)) continue;
        const size_t end = std::min(at + (size_t{file[at]} << 8 | file[at + 1]), file.size());
        for (size_t table = at + 2; marker == kTables && table < end;) {  // The last may reach beyond the segment.
            const auto rest = file.subspan(table + 1);
            const auto lengths = rest.first(std::min(kLengths, rest.size()));
            const size_t codes = std::accumulate(lengths.begin(), lengths.end(), size_t{0});
            if (codes > kMostCodes) return true;
            table += 1 + kLengths + codes;
        }
        at = std::max(end, at);
    }
}

// Of some damage stb_image has nothing to say.
std::string failure_reason() {
    const char* reason = stbi_failure_reason();
    return reason != nullptr && *reason != '\0' ? reason : "its data are damaged";
}

}  // namespace

std::optional<ImageSize> image_size(std::span<const uint8_t> file, std::string& reason) {
    largest_allocation = kDecoderState;
    if (!file.empty() && file[0] == 0xff && has_too_many_codes(file)) {
        reason = "a Huffman table has more than 256 codes";
        return std::nullopt;
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels) == 0) {
        reason = failure_reason();
        return std::nullopt;
    }
    if (static_cast<uint64_t>(width) * static_cast<uint64_t>(height) > file.size() * most_texels_of_byte(file)) {
        reason = "its header states " + std::to_string(width) + "x" + std::to_string(height) +
                 " texels, more than the file can hold";
        return std::nullopt;
    }
    return ImageSize{static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

std::vector<uint8_t> decode_rgba(std::span<const uint8_t> file, ImageSize size, std::string& reason) {
    // Four channels of two bytes, padded to blocks of JPEG; packed data are gathered in a buffer that doubles.
    largest_allocation = size_t{8} * (size.width + 64) * (size.height + 64) + 2 * file.size() + kDecoderState;
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
        stbi_load_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels, 4), stbi_image_free);
    if (!texels) {
        reason = failure_reason();
        return {};
    }
    return {texels.get(), texels.get() + size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height)};
}

}  // namespace gnomon::gltf
