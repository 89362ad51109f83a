// SPDX-License-Identifier: Apache-2.0
#include "stages/extent.hpp"

#include <algorithm>

#include "math/order.h"
#include "stages/grid.hpp"

namespace gnomon {

using gpu::Texel;

Extents casting_extents(gpu::Device& device, Programs& programs, const Geometry& geometry, const Bins& bins) {
    struct Ordered {
        glm::uvec2 lower{0xffffffffu};
        glm::uvec2 upper{0};
        uint32_t count = 0;
    };
    shared::ViewGrid grid = bins.grid;
    grid.segment_count = geometry.segment_count;
    const size_t keys = grid.segment_count + 1;
    const gpu::Buffer buffer = gpu::upload_new(device, "extents", std::vector<Ordered>(keys));
    device.recorder().dispatch("setup/extent", programs.get("setup/extent", {static_cast<uint32_t>(bins.part)}),
                               bindings({{"triangles", &geometry.scene->triangles, Texel::rgba32_uint},
                                         {"raster_vertices", &bins.raster_vertices, Texel::rgba32_float},
                                         {"shells", &geometry.scene->shells, Texel::r32_uint},
                                         {"closed", &geometry.closed, Texel::r32_uint},
                                         {"positions", &geometry.positions, Texel::rgba32_float},
                                         {"still", &geometry.still, Texel::r32_uint},
                                         {"Extents", &buffer}}),
                               shared::ExtentParams{grid, geometry.box.lower, geometry.box.upper},
                               groups_of(bins.grid.triangle_count, 64 * shared::kBoundsRun));
    const auto place = [](glm::uvec2 o) { return glm::vec2(shared::from_ordered_bits(o.x), shared::from_ordered_bits(o.y)); };
    Extents extents;
    bool all = true;
    for (const Ordered& box : gpu::download_vector<Ordered>(device, buffer, keys)) {
        extents.triangles = std::max<uint64_t>(extents.triangles, box.count);
        all = all && box.lower.x <= box.upper.x;
        extents.boxes.push_back({place(box.lower), place(box.upper)});
    }
    if (!all) extents.boxes.clear();
    return extents;
}

}  // namespace gnomon
