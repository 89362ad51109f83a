// SPDX-License-Identifier: Apache-2.0
// Shells: the closed surfaces among a scene's triangles, whatever their poses.
#pragma once

#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon {

struct Shells {
    uint32_t count = 0;
    std::vector<uint32_t> of_triangle;  ///< Of each triangle the number of its shell; `count` where it belongs to none.
};

/// A shell is a set of triangles, connected by edges, each of whose edges is used as often in one direction as in the other, so
/// that space has a winding number around it. Vertices are one where all that poses them is the same: their posed positions
/// are the same bits at any key. Not a shell is what has two triangles on the same three vertices, back to back: a sheet, whose
/// two sides are the same place.
Shells find_shells(const Scene& scene);

}  // namespace gnomon
