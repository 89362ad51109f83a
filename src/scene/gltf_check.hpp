// SPDX-License-Identifier: Apache-2.0
// The checks that a glTF document passes before anything else reads it. After them every index is in range, every accessor lies
// inside its buffer view and that inside its buffer, types and counts fit their use, and the nodes are a forest. What depends
// on the data themselves (vertex indices, joints, key frames, sparse indices) is checked where they are read.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/json_cursor.hpp"

namespace gnomon::gltf {

/// Component types, as in the file.
enum ComponentType : uint32_t { kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126 };

uint32_t component_bytes(uint32_t component_type);

/// What a use of an accessor depends on.
struct AccessorInfo {
    uint32_t columns = 0;  ///< 1 except for matrices; 0: an unknown type, which nothing may use.
    uint32_t rows = 0;
    uint32_t component_type = 0;
    bool normalized = false;
    uint64_t count = 0;
};

/// Rows and columns of "SCALAR" to "MAT4"; 0 columns if the type is unknown.
AccessorInfo shape_of(std::string_view type);

/// Columns of matrices start at multiples of four bytes (glTF 2.0, 3.6.2.4): bytes from column to column, bytes of one element
/// up to its last component, and bytes from element to element where no stride is given.
uint64_t column_stride(const AccessorInfo& info);
uint64_t element_bytes(const AccessorInfo& info);
uint64_t packed_stride(const AccessorInfo& info);

/// Check the whole document. Errors: ErrorKind::input.
void check_document(const Cursor& root);

/// Parts of it: extensionsRequired.
void check_extensions(const Cursor& root);
/// Buffers, buffer views and accessors.
std::vector<AccessorInfo> check_data(const Cursor& root);
/// Images, textures, materials, meshes, cameras, lights.
void check_content(const Cursor& root, const std::vector<AccessorInfo>& accessors);

/// True if the document states that it uses the extension.
bool uses_extension(const Cursor& root, std::string_view name);

/// The number of morph targets of a mesh.
size_t target_count(const Cursor& root, size_t mesh);

}  // namespace gnomon::gltf
