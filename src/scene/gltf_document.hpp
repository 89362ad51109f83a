// SPDX-License-Identifier: Apache-2.0
// A glTF document that has passed all checks: its JSON, tinygltf's model of it, and its buffers.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/json_cursor.hpp"

namespace gnomon::gltf {

struct Document {
    std::filesystem::path folder;
    std::string name;  ///< Of the file, for messages.
    nlohmann::json json;
    /// Accessors of types that nothing may use read as one scalar. Buffers hold their bytes, or nothing where the file names no
    /// data for them. Images are left out: see read_image.
    tinygltf::Model model;
    /// Bytes that have been read from accessors: a small file can name the same data any number of times, so this is bounded.
    mutable uint64_t decoded_bytes = 0;

    Cursor root() const { return Cursor(json, name); }
};

/// Read and check. Errors: ErrorKind::input. Appends what is ignored to `warnings`.
Document read_document(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// One line for each extension that the document uses and gnomon ignores.
void warn_of_extensions(const Cursor& root, std::vector<std::string>& warnings);

}  // namespace gnomon::gltf
