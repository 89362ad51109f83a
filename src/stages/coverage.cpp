// SPDX-License-Identifier: Apache-2.0
#include "stages/coverage.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "stages/grid.hpp"
#include "stages/raster_stage.hpp"

namespace gnomon {

CoverageMap make_coverage(gpu::Device& device, Programs& programs, const RasterSource& source, bool orthographic,
                          bool cull_back_faces) {
    const uint32_t items = source.item_count();
    const uint64_t item_bytes = uint64_t(shared::kTileTexels) * 4, bytes = items * item_bytes;
    if (uint64_t(items) * shared::kTileTexels > device.limits().most_elements(4)) {
        throw Error(ErrorKind::out_of_memory, "the coverage map of a light's view is more than the device can bind", "S-buffer",
                    "use a smaller --shadow-res");
    }
    CoverageMap map;
    map.nearest_depths = device.allocate("nearest_depths", bytes);
    map.nearest_triangles = device.allocate("nearest_triangles", bytes);
    map.coverage = device.allocate("coverage", bytes);
    gpu::Recorder& recorder = device.recorder();
    for (const gpu::Buffer* buffer : {&map.nearest_depths, &map.nearest_triangles, &map.coverage})
        recorder.fill("raster/coverage", *buffer, shared::kNone);
    const auto most = static_cast<uint32_t>(device.limits().max_storage_range / item_bytes);
    for (uint32_t first = 0; first < items; first += std::min(most, items - first)) {
        const uint32_t count = std::min(most, items - first);
        std::vector<gpu::Binding> all = source.bindings();
        all.push_back({"NearestDepths", &map.nearest_depths, {}, first * item_bytes, count * item_bytes});
        all.push_back({"NearestTriangles", &map.nearest_triangles, {}, first * item_bytes, count * item_bytes});
        all.push_back({"Coverage", &map.coverage, {}, first * item_bytes, count * item_bytes});
        for (uint32_t pass = 0; pass < 4; ++pass) {
            for (uint32_t part = 0; part < source.part_count(); ++part) {
                shared::RasterParams params{};
                params.grid = source.bins.grid;
                params.item_count = count;
                params.item_first = first;
                params.list_first = part * shared::kListChunk;
                params.entry_first = source.entry_first();
                recorder.dispatch(
                    "raster/coverage",
                    programs.get("raster/coverage", {pass, orthographic, cull_back_faces, source.asked != nullptr}), all,
                    params, groups_of(count, 8));
            }
        }
    }
    const auto covering = gpu::download_vector<uint32_t>(device, map.coverage, bytes / 4);
    map.covered = covering.size() - static_cast<uint64_t>(std::count(covering.begin(), covering.end(), shared::kNone));
    return map;
}

}  // namespace gnomon
