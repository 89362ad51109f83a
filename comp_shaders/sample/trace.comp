#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the nearest triangle at each sample of a view.
// Reads:   bin_offsets, bin_entries, triangles, raster_vertices
// Writes:  Hits (per slot of the batch: the list entry, a triangle and its orientation, or kNone), TestCount (where kCount: samples times triangles that were
//          tested, two words)
// Grid:    8 invocations per tile and stratum of time: one per pixel of a block of 4x2, the 8 blocks in registers; they fetch the list's triangles for each other and,
//          where lists are long, pass over those that are nowhere nearer than what all samples have found
// Source:  math/cover.h
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOrthographic = false;
layout(constant_id = 1) const bool kStraddle = false;  // A stratum may lie in several cells.
layout(constant_id = 2) const bool kContinue = false;  // Go on from the hits of an earlier part of the lists.
layout(constant_id = 3) const bool kSliced = false;    // Samples are slice_points.
layout(constant_id = 4) const uint kCrew = 8u;
layout(constant_id = 5) const bool kApart = false;  // What stands still is listed behind a tile's cells.
layout(constant_id = 6) const bool kPassOver = false;  // Pass over the end of a round that is nowhere nearer.
layout(constant_id = 7) const bool kCount = false;     // Count tests.
READ_UINT(0, bin_offsets)
READ_UINT(1, bin_entries)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
layout(binding = 4, scalar) buffer Hits { uint hits[]; };
layout(binding = 5, scalar) buffer TestCount { uint test_count[]; };
layout(push_constant, scalar) uniform Push { TraceParams params; };
#include "common/triangle.glsl"
#include "common/spread.glsl"
#include "common/batch.glsl"
#include "common/crew.glsl"
#include "common/cell.glsl"

MovingTriangle shown(MovingTriangle m, uint from) {
    return MovingTriangle(subgroupShuffle(m.a0, from), subgroupShuffle(m.a1, from), subgroupShuffle(m.a2, from), subgroupShuffle(m.d0, from),
                          subgroupShuffle(m.d1, from), subgroupShuffle(m.d2, from));
}

struct Best {
    float depth;
    uint entry;
};

// Keep the nearer surface; of equally near ones the lower triangle, so that the order of a list does not matter.
void test(MovingTriangle m, uint entry, vec3 xys, inout Best best) {
    vec4 p0 = vertex_at(m.a0, m.d0, xys.z);
    vec4 p1 = vertex_at(m.a1, m.d1, xys.z);
    vec4 p2 = vertex_at(m.a2, m.d2, xys.z);
    vec3 e = edges_at(p0, p1, p2, xys.x, xys.y);
    float depth = kOrthographic ? depth_orthographic(e, p0, p1, p2) : depth_perspective(e, p0, p1, p2);
    bool nearer = depth < best.depth || (depth == best.depth && (entry & ~kReversed) < (best.entry & ~kReversed));
    bool hit = covers(e) && depth > params.depth_near && nearer;
    best.depth = hit ? depth : best.depth;
    best.entry = hit ? entry : best.entry;
}

// First entry and number of what this dispatch walks of a list.
uvec2 list_part(uint list) {
    uint begin = fetch_bin_offsets(list) + params.list_first;
    uint end = max(fetch_bin_offsets(list + 1u), begin);
    return uvec2(begin, min(end - begin, kListChunk));
}

void main() {
    ViewGrid grid = params.grid;
    uint item_count = params.tile_count * params.stratum_count;
    Crew crew = join_crew();
    uint item = spread_first(item_count, 8u) + (crewed_invocation() >> 3u);
    uint lane = crewed_invocation() & 7u;
    bool inside = item < item_count;
    item = min(item, item_count - 1u);
    uint tile_in_batch = item / params.stratum_count;
    uint stratum = params.stratum_first + item - tile_in_batch * params.stratum_count;
    uint tile = params.tile_first + tile_in_batch;
    uint tile_y = tile / grid.tiles_x;
    uint tile_x = tile - tile_y * grid.tiles_x;
    uint slot = item * kTileTexels;

    // The strata's cells are walked one by one, by a dispatch each.
    uint cell = kStraddle ? cell_of(stratum_start(stratum, params.stratum_length), grid.cell_count) + params.cell_turn
                          : stratum / (params.spp / grid.cell_count);
    bool walked = !kStraddle || cell <= cell_of(stratum_start(stratum + 1u, params.stratum_length), grid.cell_count);
    cell = min(cell, grid.cell_count - 1u);
    uint segment = cell / (grid.cell_count / grid.segment_count);
    uint key_first = segment * grid.vertex_stride;

    vec3 at[8];  // x and y in raster space, local time in the segment.
    bool here[8];
    Best best[8];
    [[unroll]] for (uint r = 0u; r < 8u; ++r) {
        uint x_px = tile_x * kTileSize + slot_column(8u * r + lane);
        uint y_px = tile_y * kTileSize + slot_row(8u * r + lane);
        vec3 p = view_sample(kSliced, x_px, y_px, stratum, params.stratum_length, params.seed);
        at[r] = vec3(p.x - 0.5 * float(grid.width), p.y - 0.5 * float(grid.height), local_time_of(p.z, segment, grid.segment_count));
        here[r] = inside && x_px < grid.width && y_px < grid.height;
        if (kStraddle) here[r] = here[r] && walked && cell_of(p.z, grid.cell_count) == cell;
        // Nothing is nearer than what no sample is taken for.
        best[r] = Best(here[r] ? params.depth_far : -3.4e38, kNone);
        if (kContinue) {
            uint entry = hits[slot + 8u * r + lane];
            MovingTriangle m = fetch_moving_triangle(here[r] && entry != kNone ? entry : grid.triangle_count, key_first, grid.vertex_stride);
            test(m, entry, at[r], best[r]);
        }
    }

    // Local times between which the samples lie.
    vec2 span = vec2(local_time_of(stratum_start(stratum, params.stratum_length), segment, grid.segment_count),
                     local_time_of(stratum_start(stratum + 1u, params.stratum_length), segment, grid.segment_count));
    if (kStraddle) {
        float slack = time_slack(grid.cell_count);
        vec2 of_cell = cell_span(grid, cell);
        span = vec2(max(span.x, of_cell.x - slack), min(span.y, of_cell.y + slack));
    }

    uint tests = 0u;
    uint tile_lists = grid.cell_count + (kApart ? 1u : 0u);
    uint list = (tile - grid.tile_first) * tile_lists;
    uvec2 moving = list_part(list + cell);
    uvec2 still = kApart ? list_part(list + grid.cell_count) : uvec2(0u);
    uint count = walked ? moving.y + still.y : 0u;
    uint rounds = rounds_of(count);
    uint k = 0u;
    do {
        // Past the end: the triangle behind the last, whose vertices coincide and which covers nothing.
        uint own = k + crew.place;
        uint place = own < moving.y ? moving.x + own : still.x + own - moving.y;
        uint own_entry = own < count ? fetch_bin_entries(place) : grid.triangle_count;
        MovingTriangle own_triangle = fetch_moving_triangle(own_entry, key_first, grid.vertex_stride);
        uint from = 0u;
        uint last = min(crew.size, rounds - k);
        if (kPassOver) {
            CellTriangle c = cell_triangle(own_triangle.a0, own_triangle.a1, own_triangle.a2, own_triangle.d0, own_triangle.d1, own_triangle.d2, span.x, span.y);
            float farthest = best[0].depth;
            [[unroll]] for (uint r = 1u; r < 8u; ++r) farthest = max(farthest, best[r].depth);
            farthest = crew_max(crew, farthest);
            bool nearer = own < count && nearest_computed_depth(c, kOrthographic) <= farthest;
            last = rounds_of(nearer ? crew.place + 1u : 1u);
        }
        if (kCount) tests += 8u * last;
        do {
            uint entry = subgroupShuffle(own_entry, crew.first + from);
            MovingTriangle m = shown(own_triangle, crew.first + from);
            [[unroll]] for (uint r = 0u; r < 8u; ++r) test(m, entry, at[r], best[r]);
            ++from;
        } while (from < last);
        k += crew.size;
    } while (k < rounds);

    // The first dispatch leaves a hit or none for every sample.
    bool first = params.cell_turn == 0u && params.list_first == 0u;
    [[unroll]] for (uint r = 0u; r < 8u; ++r) {
        if (inside && (first || here[r])) hits[slot + 8u * r + lane] = best[r].entry;
    }
    if (kCount) {
        uint sum = subgroupAdd(inside ? tests : 0u);
        if (subgroupElect()) {
            uint before = atomicAdd(test_count[0], sum);
            if (before + sum < before) atomicAdd(test_count[1], 1u);
        }
    }
}
