// SPDX-License-Identifier: Apache-2.0
// The scene on the device: what does not move is uploaded once, vertices are posed at each key of each frame.
#pragma once

#include <gnomon/scene.hpp>
#include <memory>

#include "gpu/gpu.hpp"
#include "stages/programs.hpp"

namespace gnomon {

/// What of a scene does not depend on its pose.
struct SceneData {
    uint32_t triangle_count = 0;
    uint32_t vertex_count = 0;
    gpu::Buffer triangles;   ///< uvec4 (vertex 0, 1, 2, material); one more, degenerate, behind the last.
    gpu::Buffer shells;      ///< uint per triangle: its shell (scene/shells.hpp); the number of shells where it has none.
    gpu::Buffer attributes;  ///< 2 vec4 per vertex: texture coordinates, colour.
    gpu::Buffer materials;   ///< 2 uvec4 per material: base colour; first texel, width, height, wrap modes.
    gpu::Buffer texels;      ///< RGBA8 words of all images.
    gpu::Buffer rest;        ///< 3 uvec4 per vertex, as pose/pose reads them.
    gpu::Buffer influences;
    gpu::Buffer morph_positions;
    gpu::Buffer morph_normals;
    bool textured = false;                  ///< A material has a texture.
    bool smooth = false;                    ///< A vertex has a normal.
    std::vector<uint32_t> shell_triangles;  ///< Of each shell; then of none.

    uint32_t shell_count() const { return static_cast<uint32_t>(shell_triangles.size()) - 1; }
};

SceneData upload_scene(gpu::Device& device, const Scene& scene);

/// A posed scene, read by all later stages. Vertices of key k start at k * vertex_stride.
struct Geometry {
    std::shared_ptr<const SceneData> scene;
    uint32_t vertex_stride = 0;  ///< vertex_count, rounded up to keep bindings aligned.
    uint32_t segment_count = 0;
    gpu::Buffer positions;          ///< vec4 per key and vertex, world space.
    gpu::Buffer normals;            ///< vec4 per key and vertex.
    Bounds box;                     ///< Of all triangles at all keys, where it is asked for.
    gpu::Buffer still;              ///< A bit per triangle, 32 to a word: it stands still from the first key to the last.
    gpu::Download still_triangles;  ///< Their number.
    gpu::Buffer closed;  ///< uint per shell, and one for triangles of none: 1 where it counts as closed in this frame.
};

/// Vertices [first, first + count).
struct VertexRun {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// The vertices of a key in runs whose records of 16 bytes one storage binding holds.
std::vector<VertexRun> vertex_runs(const gpu::Device& device, const Geometry& geometry);

/// Run the pose stage at every key.
Geometry pose_geometry(gpu::Device& device, Programs& programs, std::shared_ptr<const SceneData> scene,
                       const std::vector<Pose>& poses);

struct GeometryBounds {
    Bounds all;
    std::vector<Bounds> shells;
};

/// The boxes of what triangles use, at all keys: bounds_of, on the device. Errors: as bounds_of, for positions that are not
/// finite.
GeometryBounds geometry_bounds(gpu::Device& device, Programs& programs, const Geometry& geometry, const Scene& scene,
                               const std::vector<Pose>& poses);
/// Upload the scene first.
Geometry pose_geometry(gpu::Device& device, Programs& programs, const Scene& scene, const std::vector<Pose>& poses);

}  // namespace gnomon
