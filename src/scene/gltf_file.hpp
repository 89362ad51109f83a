// SPDX-License-Identifier: Apache-2.0
// Bytes of a glTF scene: the .gltf or .glb file itself and the files and data that its addresses name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/json_cursor.hpp"

namespace gnomon::gltf {

/// Most bytes of the JSON text, of all buffers together, and of one image file.
inline constexpr uint64_t kMaxJsonBytes = uint64_t{256} << 20;
inline constexpr uint64_t kMaxBufferBytes = uint64_t{1} << 30;
inline constexpr uint64_t kMaxImageFileBytes = uint64_t{256} << 20;

struct SceneFile {
    std::filesystem::path folder;  ///< Canonical; addresses in the scene stay inside it.
    std::string name;              ///< For messages.
    std::string json;
    bool is_glb = false;
    std::vector<uint8_t> binary;  ///< The GLB's BIN chunk.
    bool has_binary = false;
};

/// Read a .gltf or a .glb; which one, its first bytes say. Errors: ErrorKind::input.
SceneFile read_scene_file(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// What the address `uri` (a string) names: data inside it, or a regular file inside `folder`. At least `least` and at most
/// `most` bytes; `take`: only the first so many, 0 all. Errors: ErrorKind::input at the address's place.
std::vector<uint8_t> read_uri(const std::filesystem::path& folder, const Cursor& uri, uint64_t least, uint64_t most,
                              uint64_t take = 0);

}  // namespace gnomon::gltf
