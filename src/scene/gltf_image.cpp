// SPDX-License-Identifier: Apache-2.0
// Images of a glTF document.
#include "scene/gltf_image.hpp"

#include <algorithm>
#include <array>

#include "scene/gltf_file.hpp"
#include "scene/stb_image.hpp"

namespace gnomon::gltf {

namespace {

bool starts_with(const std::vector<uint8_t>& file, std::initializer_list<uint8_t> magic) {
    return file.size() >= magic.size() && std::equal(magic.begin(), magic.end(), file.begin());
}

bool has_decoder(const std::vector<uint8_t>& file) {
    return starts_with(file, {0x89, 'P', 'N', 'G'}) || starts_with(file, {0xff, 0xd8, 0xff});
}

// The encoded bytes; none where the document names no data.
std::vector<uint8_t> file_of(const Document& document, const Cursor& image) {
    if (const auto uri = image.find("uri")) return read_uri(document.folder, *uri, 1, kMaxImageFileBytes);
    const auto view = image.find("bufferView");
    if (!view) return {};
    const tinygltf::BufferView& v = document.model.bufferViews[view->integer()];
    const std::vector<unsigned char>& data = document.model.buffers[static_cast<size_t>(v.buffer)].data;
    if (data.empty()) return {};
    if (v.byteLength > kMaxImageFileBytes) image.fail("the image file is too large", "use images of at most 256 MiB");
    const auto begin = data.begin() + static_cast<std::ptrdiff_t>(v.byteOffset);
    return {begin, begin + static_cast<std::ptrdiff_t>(v.byteLength)};
}

ImageSize size_of(const Cursor& image, const std::vector<uint8_t>& file) {
    std::string reason;
    const std::optional<ImageSize> size = image_size(file, reason);
    if (!size) image.fail("the image cannot be decoded (" + reason + ")", "replace the image");
    return *size;
}

}  // namespace

void check_images(const Document& document) {
    uint64_t encoded_bytes = 0;
    document.root().for_each("images", [&](const Cursor& image, size_t) {
        const std::vector<uint8_t> file = file_of(document, image);
        encoded_bytes += file.size();
        if (encoded_bytes > kMaxEncodedBytes) image.fail("the image files have more than 4 GiB together", "use smaller images");
        if (has_decoder(file)) size_of(image, file);
    });
}

std::optional<Image> read_image(const Document& document, size_t number, uint64_t& decoded_bytes,
                                std::vector<std::string>& warnings) {
    const Cursor root = document.root();
    const Cursor images = root.get("images");
    const Cursor image = images.at(number);
    const auto name = image.find("name");
    const std::string label = "image " + std::to_string(number) + (name ? " '" + name->string() + "'" : "");
    const std::vector<uint8_t> file = file_of(document, image);
    if (file.empty()) image.fail("the image has neither a file nor data", "export it with its images");
    if (!has_decoder(file)) {
        warnings.push_back(label + " is neither PNG nor JPEG: its textures are ignored, the base colour factor is used");
        return std::nullopt;
    }
    const ImageSize size = size_of(image, file);
    decoded_bytes += uint64_t{4} * size.width * size.height;
    if (decoded_bytes > kMaxDecodedBytes) image.fail("the decoded images have more than 1 GiB together", "use smaller images");
    Image decoded{name ? name->string() : "", size.width, size.height, {}};
    std::string reason;
    decoded.rgba = decode_rgba(file, size, reason);
    if (decoded.rgba.empty()) image.fail("the image cannot be decoded (" + reason + ")", "replace the image");
    return decoded;
}

}  // namespace gnomon::gltf
