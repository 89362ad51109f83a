// SPDX-License-Identifier: Apache-2.0
#include "stages/bin.hpp"

#include <gnomon/error.hpp>

#include "shared/rect.h"
#include "stages/grid.hpp"
#include "stages/scan.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

void record_project(Programs& programs, gpu::Recorder& recorder, const Geometry& geometry, const View& view, const Bins& bins) {
    uint64_t key_bytes = uint64_t(geometry.vertex_stride) * sizeof(glm::vec4);
    for (size_t k = 0; k < view.keys.size(); ++k) {
        const ViewKey& key = view.keys[k];
        shared::ProjectParams params{key.row_x,
                                     key.row_y,
                                     key.row_z,
                                     key.row_w,
                                     key.origin,
                                     geometry.vertex_count,
                                     static_cast<uint32_t>(k * geometry.vertex_stride)};
        recorder.dispatch("setup/project", programs.get("setup/project"),
                          bindings({{"positions", &geometry.positions, Texel::rgba32_float},
                                    {"RasterVertices", &bins.raster_vertices, {}, k * key_bytes, key_bytes}}),
                          params, groups_of(geometry.vertex_count, 64));
    }
}

}  // namespace

Bins bin_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, uint32_t cell_count,
                Listing listing) {
    const bool by_bounds = listing == Listing::bounds;
    Bins bins;
    shared::ViewGrid& grid = bins.grid;
    grid.width = view.width;
    grid.height = view.height;
    grid.tiles_x = static_cast<uint32_t>(groups_of(view.width, shared::kTileSize));
    grid.tiles_y = static_cast<uint32_t>(groups_of(view.height, shared::kTileSize));
    grid.cell_count = cell_count;
    grid.segment_count = geometry.segment_count;
    grid.triangle_count = geometry.triangle_count;
    grid.vertex_stride = geometry.vertex_stride;

    uint64_t list_count = uint64_t(grid.tiles_x) * grid.tiles_y * cell_count;
    // Each cell's rectangles are bound on their own.
    uint64_t alignment = std::max(device.limits().storage_alignment, device.limits().texel_alignment);
    uint64_t rect_stride = groups_of(uint64_t(geometry.triangle_count) * sizeof(glm::uvec2), alignment) * alignment;
    bins.raster_vertices =
        device.allocate("raster_vertices", uint64_t(geometry.vertex_stride) * view.keys.size() * sizeof(glm::vec4));
    bins.offsets = device.allocate("bin_offsets", scan_bytes(list_count));
    gpu::Buffer rects = device.allocate("rects", rect_stride * cell_count);
    gpu::Buffer block_count = device.allocate("block_count", 4);
    uint64_t triangle_groups = groups_of(geometry.triangle_count, 64);

    gpu::Recorder recorder(device);
    record_project(programs, recorder, geometry, view, bins);
    recorder.fill("setup/prisms", block_count, 0);
    for (uint32_t cell = 0; cell < cell_count; ++cell) {
        recorder.dispatch("setup/prisms", programs.get("setup/prisms"),
                          bindings({{"triangles", &geometry.triangles, Texel::rgba32_uint},
                                    {"raster_vertices", &bins.raster_vertices, Texel::rgba32_float},
                                    {"Rects", &rects, {}, cell * rect_stride, rect_stride},
                                    {"BlockCount", &block_count}}),
                          shared::PrismParams{grid, cell}, triangle_groups);
    }
    recorder.submit();
    uint32_t large_blocks = gpu::download_vector<uint32_t>(device, block_count, 1)[0];
    gpu::Buffer blocks = device.allocate("blocks", uint64_t(large_blocks) * sizeof(glm::uvec2));

    auto params = [&](uint32_t cell) {
        return shared::BinParams{grid, cell, static_cast<uint32_t>(rect_stride / sizeof(glm::uvec2)), large_blocks};
    };
    auto record_lists = [&](bool fill, const gpu::Buffer& lists, const gpu::Buffer& entries) {
        const char* stage = fill ? "bin/fill" : "bin/count";
        for (uint32_t cell = 0; cell < cell_count; ++cell) {
            recorder.dispatch(stage, programs.get("bin/small", {fill, by_bounds}),
                              bindings({{"rects", &rects, Texel::rg32_uint, cell * rect_stride, rect_stride},
                                        {"Lists", &lists},
                                        {"Entries", &entries}}),
                              params(cell), triangle_groups);
            if (!fill && large_blocks > 0) {
                recorder.dispatch("bin/blocks", programs.get("bin/blocks"),
                                  bindings({{"rects", &rects, Texel::rg32_uint, cell * rect_stride, rect_stride},
                                            {"Blocks", &blocks},
                                            {"BlockCount", &block_count}}),
                                  params(cell), triangle_groups);
            }
        }
        recorder.dispatch(fill ? "bin/fill_large" : "bin/count_large", programs.get("bin/large", {fill, by_bounds}),
                          bindings({{"blocks", &blocks, Texel::rg32_uint},
                                    {"rects", &rects, Texel::rg32_uint},
                                    {"triangles", &geometry.triangles, Texel::rgba32_uint},
                                    {"raster_vertices", &bins.raster_vertices, Texel::rgba32_float},
                                    {"Lists", &lists},
                                    {"Entries", &entries}}),
                          params(0), groups_of(uint64_t(large_blocks) * shared::kBlockTiles, 64));
    };
    gpu::Buffer no_entries = device.allocate("bin_entries", 4);
    gpu::Buffer cursors = device.allocate("bin_cursors", scan_bytes(list_count));  // First the counts.
    recorder.fill("bin/count", cursors, 0);
    recorder.fill("bin/count", block_count, 0);
    record_lists(false, cursors, no_entries);
    Scan scan = record_scan(device, programs, recorder, cursors, static_cast<uint32_t>(list_count), bins.offsets);
    recorder.copy("bin/fill", bins.offsets, 0, cursors, 0, scan_bytes(list_count));
    recorder.submit();
    bins.entry_count = gpu::download_vector<uint32_t>(device, bins.offsets, 1, list_count * 4)[0];
    bins.longest = longest_of(device, scan);
    if (bins.entry_count == shared::kNone) {
        throw Error(ErrorKind::out_of_memory, "more than 2^32 prisms in the tiles of a view",
                    std::to_string(view.width) + "x" + std::to_string(view.height), "use a smaller --size or --shadow-res");
    }
    if (uint64_t(bins.entry_count) * 4 > device.limits().max_storage_range) {
        throw Error(ErrorKind::out_of_memory,
                    std::to_string(bins.entry_count) + " prisms in the tiles of a view are more than the device can bind",
                    std::to_string(view.width) + "x" + std::to_string(view.height), "use a smaller --size or --shadow-res");
    }
    bins.entries = device.allocate("bin_entries", uint64_t(bins.entry_count) * 4);
    if (bins.entry_count > 0) {
        record_lists(true, cursors, bins.entries);
        recorder.submit();
    }
    return bins;
}

}  // namespace gnomon
