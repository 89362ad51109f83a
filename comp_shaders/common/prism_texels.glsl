// SPDX-License-Identifier: Apache-2.0
// Rasterizing prisms by their triangulated surface (math/prism.h): every texel centre that a prism of an item's list covers is visited, once. The list holds prisms
// by their bounds, each once. 8 invocations per item, each with prisms of its own; of the last ones
// of a list, invocations share the rows of one. Needs: void visit(uint list, uint triangle, PrismFragments fragments)
#include "math/prism.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kPass = 0u;
layout(constant_id = 1) const bool kOrthographic = false;
layout(constant_id = 2) const bool kCullBackFaces = false;  // Leave out what the light sees from behind at both ends.
layout(constant_id = 3) const bool kAsked = false;
READ_UINT(0, bin_offsets)
READ_UINT(1, bin_entries)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
layout(push_constant, scalar) uniform Push { RasterParams params; };
#include "common/triangle.glsl"
#include "common/cell.glsl"
#include "common/source_page.glsl"
#include "common/spread.glsl"

void visit(uint list, uint triangle, PrismFragments fragments);

// The texels of a tile whose centres the prism's bounds hold: first and last column and row.
uvec4 covered_texels(CellTriangle c, vec2 centre, float extent) {
    if (!cell_in_front(c)) return uvec4(0u, 0u, kTileSize - 1u, kTileSize - 1u);
    CellBox box = cell_box(c, extent, 0.0);
    vec2 first = ceil(box.lower - centre + 3.5), last = floor(box.upper - centre + 3.5);
    bool none = first.x > last.x || first.y > last.y || first.x > 7.0 || first.y > 7.0 || last.x < 0.0 || last.y < 0.0;
    return none ? uvec4(1u, 1u, 0u, 0u) : uvec4(clamp(vec4(first, last), vec4(0.0), vec4(7.0)));
}

bool is_culled(CellTriangle c) {
    return kCullBackFaces && det3(c.a0.xyw, c.a1.xyw, c.a2.xyw) > 0.0 && det3(c.b0.xyw, c.b1.xyw, c.b2.xyw) > 0.0;
}

// Of the item with this number in the dispatch.
void visit_texels(uint number) {
    bool inside = number < params.item_count;
    uint item = params.item_first + min(number, params.item_count - 1u);
    ViewGrid grid = params.grid;
    Page page = fetch_page(item);
    vec2 centre = tile_centre(grid, page.tile_x, page.tile_y);
    uvec2 most = min(uvec2(grid.width, grid.height) - uvec2(page.tile_x, page.tile_y) * kTileSize, uvec2(kTileSize)) - 1u;
    uint key_first = segment_of_cell(grid, page.cell) * grid.vertex_stride;
    vec2 span = cell_span(grid, page.cell);
    uint list_first = (item - params.item_first) * kTileTexels;

    uint k = page.begin + params.list_first;
    uint end = inside ? min(page.end, k + kListChunk) : 0u;
    uint lane = gl_LocalInvocationID.x & 7u;
    while (k < end) {
        uint left = end - k;
        uint share_log2 = left > 4u ? 0u : left > 2u ? 1u : left > 1u ? 2u : 3u;  // Of the invocations of one prism.
        uint share = 1u << share_log2;
        uint number_here = lane >> share_log2;
        bool own = number_here < left;
        uint entry = fetch_bin_entries(min(k + number_here, end - 1u)) & ~kReversed;
        CellTriangle c = fetch_cell_triangle(grid, entry, key_first, span);
        PrismSurface surface = prism_surface(c, centre.x, centre.y, kOrthographic);
        uvec4 texels = covered_texels(c, centre, grid_extent(grid));
        uvec2 last = min(texels.zw, most);
        uvec2 at = uvec2(texels.x, texels.y + (lane & (share - 1u)));
        bool more = own && at.x <= last.x && at.y <= last.y && !is_culled(c);
        while (more) {
            PrismFragments fragments = fragments_at(surface, float(at.x) - 3.5, float(at.y) - 3.5, kOrthographic ? -kFarthest : 0.0);
            if (fragments.covered != 0u) visit(list_first + at.y * kTileSize + at.x, entry, fragments);
            bool row_ends = at.x == last.x;
            at = row_ends ? uvec2(texels.x, at.y + share) : at + uvec2(1u, 0u);
            more = at.y <= last.y;
        }
        k += 8u;
    }
}
