#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: list small prisms in the tiles of their bounds, for one cell, in the orientations whose turn it is. Count, or fill after the scan.
// Reads:   rects of the cell
// Writes:  Lists (count: entries per list; fill: the next free place of each list), Entries (fill)
// Grid:    one invocation per triangle
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "shared/rect.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFill = false;
layout(constant_id = 1) const bool kByBounds = false;  // Each prism once.
layout(constant_id = 2) const bool kApart = false;     // A tile has a list behind those of its cells, for what stands still.
READ_UVEC2(0, rects)
layout(binding = 1, scalar) buffer Lists { uint lists[]; };
layout(binding = 2, scalar) writeonly buffer Entries { uint entries[]; };
layout(push_constant, scalar) uniform Push { BinParams params; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = i < params.triangle_count;
    uint triangle = params.triangle_first + i;
    Rect rect = unpack_rect(fetch_rects(params.rect_first + min(i, params.triangle_count - 1u)));
    rect.seen &= params.seen;
    bool listed = inside && rect.seen != 0u && !rect.large;
    uint copies = rect.seen == 3u && !kByBounds ? 2u : 1u;
    uint first_entry = triangle | (rect.seen == 2u && !kByBounds ? kReversed : 0u);
    uvec2 tile = rect.first;
    uint tile_lists = params.grid.cell_count + (kApart ? 1u : 0u);
    bool more;
    do {
        uint list = (tile.y * params.grid.tiles_x + tile.x - params.grid.tile_first) * tile_lists + params.cell;
        if (listed) {
            uint place = atomicAdd(lists[list], copies);
            if (kFill) {
                entries[place] = first_entry;
                if (copies == 2u) entries[place + 1u] = triangle | kReversed;
            }
        }
        bool row_ends = tile.x == rect.last.x;
        tile.x = row_ends ? rect.first.x : tile.x + 1u;
        tile.y += row_ends ? 1u : 0u;
        more = listed && tile.y <= rect.last.y;
    } while (more);
}
