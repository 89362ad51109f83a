// SPDX-License-Identifier: Apache-2.0
// Which samples of a view's pixels a small prism may cover in one cell of time: each of the few that lie along its way is looked at. Needs common/cell.glsl; params.spp,
// params.stratum_length, params.seed.
#include "math/sample.h"

// Bounds of the pixels whose samples are met: none while first > last.
struct MetPixels {
    uvec2 first;
    uvec2 last;
    bool known;  // Else any may be met.
};

// Samples that a triangle may be expected to meet, at most, so that looking at them pays.
const float kFewSamples = 1.0;
// The way is gone in steps of so many pixels along the image's axes, the shorter and the longer.
const vec2 kStep = vec2(0.6, 4.0);
// Steps, and pixels looked at, of a prism in a cell.
const float kMostSteps = 4096.0;
const uint kMostLooks = kMostTurns / 3u;

// Bounds of a triangle in front of the eye at a time, and what rounding (math/cover.h) may add.
CellBox box_at(MovingTriangle m, float time, float rounding) {
    vec4 p0 = vertex_at(m.a0, m.d0, time), p1 = vertex_at(m.a1, m.d1, time), p2 = vertex_at(m.a2, m.d2, time);
    vec2 q0 = p0.xy * (1.0 / p0.w), q1 = p1.xy * (1.0 / p1.w), q2 = p2.xy * (1.0 / p2.w);
    return CellBox(min(min(q0, q1), q2) - rounding, max(max(q0, q1), q2) + rounding);
}

float area_of(CellBox box) { return (box.upper.x - box.lower.x) * (box.upper.y - box.lower.y); }

MetPixels met_pixels(MovingTriangle m, ViewGrid grid, uint cell) {
    MetPixels met = MetPixels(uvec2(kNone), uvec2(0u), false);
    bool all_cells = cell == grid.cell_count;
    uint segment = segment_of_cell(grid, cell);
    uint segments = all_cells ? 1u : grid.segment_count;
    uint cells = all_cells ? 1u : grid.cell_count;
    bool straddle = params.spp % cells != 0u;
    // A stratum's bounds are rounded: the neighbours of a cell's strata may reach into it.
    uint stratum = cell * params.spp / cells, last_stratum = ((cell + 1u) * params.spp - 1u) / cells;
    if (all_cells) stratum = 0u, last_stratum = params.spp - 1u;
    if (straddle) stratum = max(stratum, 1u) - 1u, last_stratum = min(last_stratum + 1u, params.spp - 1u);
    float strata = float(params.spp) / float(cells);

    float slack = time_slack(cells);
    vec2 span = cell_span(grid, cell) + vec2(-slack, slack);
    CellTriangle c = cell_triangle(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, span.x, span.y);
    float nearest_w = min(min_of(c.a0.w, c.a1.w, c.a2.w), min_of(c.b0.w, c.b1.w, c.b2.w));
    vec4 most0 = abs(m.a0) + abs(m.d0), most1 = abs(m.a1) + abs(m.d1), most2 = abs(m.a2) + abs(m.d2);
    float extent = grid_extent(grid);
    float most_w = max_of(most0.w, most1.w, most2.w), most_xy = max(max_of(most0.x, most1.x, most2.x), max_of(most0.y, most1.y, most2.y));
    float rounding = kShiftRounding * (extent + (most_xy + extent * most_w) / nearest_w);
    CellBox opens = box_at(m, span.x, rounding), closes = box_at(m, span.y, rounding);
    vec2 way = max(abs(closes.lower - opens.lower), abs(closes.upper - opens.upper)) / strata;
    float steps = clamp(ceil(max(min(way.x, way.y) / kStep.x, max(way.x, way.y) / kStep.y)), 1.0, kMostSteps);
    vec2 half_size = 0.5 * vec2(float(grid.width), float(grid.height));
    vec2 lowest = min(opens.lower, closes.lower), highest = max(opens.upper, closes.upper);
    bool in_image = lowest.x <= half_size.x && lowest.y <= half_size.y && highest.x >= -half_size.x && highest.y >= -half_size.y;
    bool few = in_image && nearest_w > 0.0 && max(area_of(opens), area_of(closes)) * strata <= kFewSamples;
    if (!few) {
        steps = 1.0;
        last_stratum = stratum;
    }
    // Within a step places are mixed: by so much of the way x / w may be elsewhere.
    float bend = 0.25 * max_of(abs(m.d0.w), abs(m.d1.w), abs(m.d2.w)) * (span.y - span.x) / (strata * steps * nearest_w);

    vec2 pixel_last = vec2(float(grid.width), float(grid.height)) - 1.0;
    uint looks = 0u;
    do {
        float opened = max(local_time_of(stratum_start(stratum, params.stratum_length), segment, segments), span.x);
        float closed = min(local_time_of(stratum_start(stratum + 1u, params.stratum_length), segment, segments), span.y);
        float from = opened;
        CellBox then = box_at(m, from, rounding);
        float step = 0.0;
        do {
            step += 1.0;
            bool starts = from == opened, ends = step >= steps;
            float to = ends ? closed : opened + (closed - opened) * (step / steps);
            float per_step = 1.0 / max(to - from, 1e-30);
            CellBox next = box_at(m, to, rounding);
            vec2 lower = min(then.lower, next.lower), upper = max(then.upper, next.upper);
            vec2 bent = bend * (upper - lower);
            vec2 first = max(floor(lower - bent + half_size), vec2(0.0)), last = min(floor(upper + bent + half_size), pixel_last);
            bool any = few && first.x <= last.x && first.y <= last.y;
            uvec2 f = uvec2(any ? first : vec2(0.0)), l = uvec2(any ? last : vec2(0.0)), at = f;
            do {
                vec3 p = sample_point(pixel_hash(at.x, at.y, params.seed), at.x, at.y, stratum, params.stratum_length);
                float time = local_time_of(p.z, segment, segments);
                bool now = any && (starts || time >= from) && (ends || time < to);
                if (straddle) now = now && cell_of(p.z, cells) == cell;
                float share = clamp((time - from) * per_step, 0.0, 1.0);
                vec2 place = p.xy - half_size;
                vec2 inner = min(place - mix(then.lower, next.lower, share), mix(then.upper, next.upper, share) - place) + bent;
                bool hit = now && min(inner.x, inner.y) >= 0.0;
                met.first = hit ? min(met.first, at) : met.first;
                met.last = hit ? max(met.last, at) : met.last;
                bool row_ends = at.x == l.x;
                at.x = row_ends ? f.x : at.x + 1u;
                at.y += row_ends ? 1u : 0u;
                ++looks;
            } while (at.y <= l.y && looks < kMostLooks);
            from = to;
            then = next;
        } while (step < steps && looks < kMostLooks);
        ++stratum;
    } while (stratum <= last_stratum && looks < kMostLooks);
    met.known = few && looks < kMostLooks;
    return met;
}
