// SPDX-License-Identifier: Apache-2.0
// Images of a glTF document.
#pragma once

#include <gnomon/scene.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_document.hpp"

namespace gnomon::gltf {

/// Most bytes of all decoded images together.
inline constexpr uint64_t kMaxDecodedBytes = uint64_t{1} << 30;
/// And of all image files; one file named several times counts so often.
inline constexpr uint64_t kMaxEncodedBytes = uint64_t{1} << 32;

/// That the files of all images are there and the headers of PNG and JPEG valid. Errors: ErrorKind::input.
void check_images(const Document& document);

/// Decode one image; nothing, and a warning, if it is of another format than PNG or JPEG. `decoded_bytes` counts what has been
/// decoded so far. Errors: ErrorKind::input.
std::optional<Image> read_image(const Document& document, size_t number, uint64_t& decoded_bytes,
                                std::vector<std::string>& warnings);

}  // namespace gnomon::gltf
