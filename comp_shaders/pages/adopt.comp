#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the pages that others are split into: those that something is listed for. Mark, or write after the scan.
// Reads:   pages, units (sums), receivers (of the parts), places (of their entries); write: page_of (scanned marks)
// Writes:  mark: Marks; write: NewPages (two uvec4 each, common/page.glsl), Leaves (per node: its page * 16 + its level, or kNone)
// Grid:    one invocation per node, four for each unit; only those of a page's first unit are of its parts
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kWrite = false;
READ_UVEC4(4, pages)
READ_UINT(5, units)
READ_UVEC2(6, receivers)
READ_UINT(7, places)
READ_UINT(10, page_of)
layout(binding = 8, scalar) writeonly buffer Marks { uint marks[]; };
layout(binding = 9, scalar) writeonly buffer NewPages { uvec4 new_pages[]; };
layout(binding = 11, scalar) writeonly buffer Leaves { uint leaves[]; };
layout(push_constant, scalar) uniform Push { PageParams params; };
#include "common/page.glsl"
#include "common/page_units.glsl"

void main() {
    uint node = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (node >= 4u * params.unit_count) return;
    Unit unit = fetch_unit(node >> 2u);
    uint q = node & 3u;
    uint begin = fetch_places(part_place(unit, q)), end = fetch_places(part_place(unit, q) + unit.count * 8u);
    bool listed = unit.number == unit.first && end > begin;
    if (!kWrite) {
        marks[node] = listed ? 1u : 0u;
        return;
    }
    Page part = part_of(unit.page, unit.page.split, q);
    uint rank = fetch_page_of(node);
    leaves[params.node_first + node] = listed ? (params.page_first + params.page_count + rank) << 4u | part.level : kNone;
    if (!listed) return;
    part.begin = params.entry_next + begin;
    part.end = params.entry_next + end;
    set_receiver(part, fetch_receivers(node));
    new_pages[2u * rank] = page_place(part);
    new_pages[2u * rank + 1u] = page_list(part);
}
