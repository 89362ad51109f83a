// SPDX-License-Identifier: Apache-2.0
// A prism within one cell of time: its vertices, how it may be seen, when it may touch a texel and how near it comes.
#ifndef GNOMON_MATH_TEXEL_RANGE_H
#define GNOMON_MATH_TEXEL_RANGE_H
#include "orientation.h"
GN_BEGIN

// Vertices at the cell's start (a) and end (b).
struct CellTriangle {
    vec4 a0, a1, a2;
    vec4 b0, b1, b2;
};

// From the vertices at the segment's start (a) and their motion until its end (d); the cell lasts from local time start to end.
GN_FN CellTriangle cell_triangle(vec4 a0, vec4 a1, vec4 a2, vec4 d0, vec4 d1, vec4 d2, float start, float end) {
    CellTriangle c;
    c.a0 = vertex_at(a0, d0, start);
    c.a1 = vertex_at(a1, d1, start);
    c.a2 = vertex_at(a2, d2, start);
    c.b0 = vertex_at(a0, d0, end);
    c.b1 = vertex_at(a1, d1, end);
    c.b2 = vertex_at(a2, d2, end);
    return c;
}

// All of it has w > 0 throughout the cell.
GN_FN bool cell_in_front(CellTriangle c) { return min(min_of(c.a0.w, c.a1.w, c.a2.w), min_of(c.b0.w, c.b1.w, c.b2.w)) > 0.0f; }

// Two vertices coincide throughout the segment: no area, whatever the rounding.
GN_FN bool coincide(vec4 a, vec4 da, vec4 b, vec4 db) {
    return a.x == b.x && a.y == b.y && a.w == b.w && da.x == db.x && da.y == db.y && da.w == db.w;
}

// Orthographic: all vertices keep to one column or one row of the image, seen edge-on throughout the segment.
GN_FN bool edge_on(float a0, float a1, float a2, float d0, float d1, float d2) {
    return a0 == a1 && a1 == a2 && d0 == d1 && d1 == d2;
}

// Orientations (math/orientation.h) in the cell; zero for a triangle that has no area during the whole segment. Small areas
// within a cell prove nothing: vertices that coincide at both its ends may be an ulp apart in between.
GN_FN uint prism_orientations(vec4 a0, vec4 a1, vec4 a2, vec4 d0, vec4 d1, vec4 d2, CellTriangle c, float extent) {
    bool in_front = cell_in_front(c);
    float x = in_front ? c.a0.x / c.a0.w : 0.0f;
    float y = in_front ? c.a0.y / c.a0.w : 0.0f;
    uint seen = orientations(tile_relative(c.a0, x, y), tile_relative(c.a1, x, y), tile_relative(c.a2, x, y),
                             tile_relative(c.b0, x, y), tile_relative(c.b1, x, y), tile_relative(c.b2, x, y), extent);
    bool flat_w = edge_on(a0.w, a1.w, a2.w, d0.w, d1.w, d2.w);
    bool no_area = coincide(a0, d0, a1, d1) || coincide(a1, d1, a2, d2) || coincide(a2, d2, a0, d0) ||
                   (flat_w && (edge_on(a0.x, a1.x, a2.x, d0.x, d1.x, d2.x) || edge_on(a0.y, a1.y, a2.y, d0.y, d1.y, d2.y)));
    return no_area ? 0u : seen;
}

// A lower bound of the triangle's depth during the cell.
GN_FN float nearest_depth(CellTriangle c, bool orthographic) {
    float z = min(min_of(c.a0.z, c.a1.z, c.a2.z), min_of(c.b0.z, c.b1.z, c.b2.z));
    float w = min(min_of(c.a0.w, c.a1.w, c.a2.w), min_of(c.b0.w, c.b1.w, c.b2.w));
    float flat_depth = z - abs(z) * (4.0f / 16777216.0f);
    float deep = w > 0.0f ? -(1.0f + 8.0f / 16777216.0f) / w : -3.4e38f;
    return orthographic ? flat_depth : deep;
}

// A lower bound of the depths that cover.h computes of it where it covers a point: convex combinations of its vertices' with
// some 16 roundings.
GN_FN float nearest_computed_depth(CellTriangle c, bool orthographic) {
    float depth = nearest_depth(c, orthographic);
    float deepest = max(max_of(abs(c.a0.z), abs(c.a1.z), abs(c.a2.z)), max_of(abs(c.b0.z), abs(c.b1.z), abs(c.b2.z)));
    return depth - (orthographic ? deepest : abs(depth)) * (16.0f / 16777216.0f);
}

// A prism's bounds in the image, where it is in front of the eye: raster space, widened by what rounding may move its vertices
// (math/range.h) and by the motion within time_slack. The bounds of a linear motion are those of its ends, since x / w is
// monotone in time for w > 0.
struct CellBox {
    vec2 lower;
    vec2 upper;
};

GN_FN CellBox cell_box(CellTriangle c, float extent, float slack) {
    vec2 a0 = vec2(c.a0.x, c.a0.y) / c.a0.w, a1 = vec2(c.a1.x, c.a1.y) / c.a1.w, a2 = vec2(c.a2.x, c.a2.y) / c.a2.w;
    vec2 b0 = vec2(c.b0.x, c.b0.y) / c.b0.w, b1 = vec2(c.b1.x, c.b1.y) / c.b1.w, b2 = vec2(c.b2.x, c.b2.y) / c.b2.w;
    vec2 lower =
        vec2(min(min_of(a0.x, a1.x, a2.x), min_of(b0.x, b1.x, b2.x)), min(min_of(a0.y, a1.y, a2.y), min_of(b0.y, b1.y, b2.y)));
    vec2 upper =
        vec2(max(max_of(a0.x, a1.x, a2.x), max_of(b0.x, b1.x, b2.x)), max(max_of(a0.y, a1.y, a2.y), max_of(b0.y, b1.y, b2.y)));
    vec2 furthest = vec2(max(abs(lower.x), abs(upper.x)), max(abs(lower.y), abs(upper.y)));
    vec2 widen = kShiftRounding * (vec2(extent, extent) + furthest) + slack * (upper - lower);
    CellBox box;
    box.lower = lower - widen;
    box.upper = upper + widen;
    return box;
}

// How far beyond a side of the image the nearest of a prism's vertices is, times w; (x, y): outward, half_size: of the image.
GN_FN float beyond_side(CellTriangle c, float x, float y, float half_size) {
    vec3 a = vec3(x * c.a0.x + y * c.a0.y - half_size * c.a0.w, x * c.a1.x + y * c.a1.y - half_size * c.a1.w,
                  x * c.a2.x + y * c.a2.y - half_size * c.a2.w);
    vec3 b = vec3(x * c.b0.x + y * c.b0.y - half_size * c.b0.w, x * c.b1.x + y * c.b1.y - half_size * c.b1.w,
                  x * c.b2.x + y * c.b2.y - half_size * c.b2.w);
    return min(min_of(a.x, a.y, a.z), min_of(b.x, b.y, b.z));
}

// All of a prism is beyond one side of the image throughout the cell, by more than rounding: what is in front of the eye and
// what is not, which no bounds in the image hold. The side's plane goes through the eye, and vertices move linearly.
GN_FN bool beside_image(CellTriangle c, vec2 half_size, float slack) {
    float mx = max(max_of(abs(c.a0.x), abs(c.a1.x), abs(c.a2.x)), max_of(abs(c.b0.x), abs(c.b1.x), abs(c.b2.x)));
    float my = max(max_of(abs(c.a0.y), abs(c.a1.y), abs(c.a2.y)), max_of(abs(c.b0.y), abs(c.b1.y), abs(c.b2.y)));
    float mw = max(max_of(abs(c.a0.w), abs(c.a1.w), abs(c.a2.w)), max_of(abs(c.b0.w), abs(c.b1.w), abs(c.b2.w)));
    float rounding = kShiftRounding + 2.0f * slack;
    float across = max(beyond_side(c, 1.0f, 0.0f, half_size.x), beyond_side(c, -1.0f, 0.0f, half_size.x));
    float down = max(beyond_side(c, 0.0f, 1.0f, half_size.y), beyond_side(c, 0.0f, -1.0f, half_size.y));
    return across > rounding * (mx + half_size.x * mw) || down > rounding * (my + half_size.y * mw);
}

// The rows of a tile that the prism may touch, first and last. cy: the tile's centre, reach: half its side, texels.
GN_FN uvec2 tile_rows(CellTriangle c, float cy, float reach, float extent, float slack) {
    CellBox box = cell_box(c, extent, slack);
    float highest = 2.0f * reach - 1.0f;
    float first = max(floor(box.lower.y - cy + reach), 0.0f);
    float last = min(floor(box.upper.y - cy + reach), highest);
    return cell_in_front(c) ? uvec2(uint(min(first, highest)), uint(max(last, 0.0f))) : uvec2(0u, uint(highest));
}

// The bounds of the three edges over a tile.
struct TileBounds {
    EdgeBound e0, e1, e2;
};

// (cx, cy): the tile's centre, reach: half its side, texels. For texels of side 1.
GN_FN TileBounds tile_bounds(CellTriangle c, float cx, float cy, float reach, float extent) {
    vec3 a0 = tile_relative(c.a0, cx, cy), a1 = tile_relative(c.a1, cx, cy), a2 = tile_relative(c.a2, cx, cy);
    vec3 b0 = tile_relative(c.b0, cx, cy), b1 = tile_relative(c.b1, cx, cy), b2 = tile_relative(c.b2, cx, cy);
    BoundScale scale = bound_scale(a0, a1, a2, b0, b1, b2, reach, 0.5f, extent);
    TileBounds bounds;
    bounds.e0 = edge_bound(a1, a2, b1, b2, scale, reach);
    bounds.e1 = edge_bound(a2, a0, b2, b0, scale, reach);
    bounds.e2 = edge_bound(a0, a1, b0, b1, scale, reach);
    return bounds;
}

// Can the triangle a -> b, in this orientation, touch the tile that its vertices are relative to (tile_relative)? reach: half
// the tile's side, texels.
GN_FN bool touches_tile(vec3 a0, vec3 a1, vec3 a2, vec3 b0, vec3 b1, vec3 b2, float reach, float extent, float slack) {
    BoundScale scale = bound_scale(a0, a1, a2, b0, b1, b2, reach, reach, extent);
    EdgeBound e0 = edge_bound(a1, a2, b1, b2, scale, reach);
    EdgeBound e1 = edge_bound(a2, a0, b2, b0, scale, reach);
    EdgeBound e2 = edge_bound(a0, a1, b0, b1, scale, reach);
    float lo = 0.0f, hi = 1.0f, highest = 0.0f;
    clip_to_bound(e0.start.z, e0.end.z, lo, hi, highest);
    clip_to_bound(e1.start.z, e1.end.z, lo, hi, highest);
    clip_to_bound(e2.start.z, e2.end.z, lo, hi, highest);
    return highest >= 0.0f && lo - slack <= hi + slack;
}

// Can the prism touch the tile with its centre at (cx, cy)?
GN_FN bool cell_touches_tile(CellTriangle c, float cx, float cy, float reach, float extent, float slack) {
    CellBox box = cell_box(c, extent, slack);
    bool apart = box.lower.x > cx + reach || box.upper.x < cx - reach || box.lower.y > cy + reach || box.upper.y < cy - reach;
    return !(cell_in_front(c) && apart) &&
           touches_tile(tile_relative(c.a0, cx, cy), tile_relative(c.a1, cx, cy), tile_relative(c.a2, cx, cy),
                        tile_relative(c.b0, cx, cy), tile_relative(c.b1, cx, cy), tile_relative(c.b2, cx, cy), reach, extent,
                        slack);
}

// The bounds of the three edges along a column of texels: linear in the row, at the cell's start and at its end.
struct ColumnBounds {
    vec3 start, start_step;
    vec3 end, end_step;
};

// x: of the column's centre, tile-relative.
GN_FN ColumnBounds column_bounds(TileBounds tile, float x) {
    ColumnBounds column;
    column.start =
        vec3(tile.e0.start.x, tile.e1.start.x, tile.e2.start.x) * x + vec3(tile.e0.start.z, tile.e1.start.z, tile.e2.start.z);
    column.start_step = vec3(tile.e0.start.y, tile.e1.start.y, tile.e2.start.y);
    column.end = vec3(tile.e0.end.x, tile.e1.end.x, tile.e2.end.x) * x + vec3(tile.e0.end.z, tile.e1.end.z, tile.e2.end.z);
    column.end_step = vec3(tile.e0.end.y, tile.e1.end.y, tile.e2.end.y);
    return column;
}

// Times u within the cell, 0 to 1, from x to y, at which the prism may touch the texel at `row` (of its centre, tile-relative);
// z < 0 where it never does. Both ends are still to be widened by time_slack.
GN_FN vec3 texel_times(ColumnBounds column, float row) {
    vec3 s = column.start_step * row + column.start;
    vec3 e = column.end_step * row + column.end;
    float lo = 0.0f, hi = 1.0f, highest = 0.0f;
    clip_to_bound(s.x, e.x, lo, hi, highest);
    clip_to_bound(s.y, e.y, lo, hi, highest);
    clip_to_bound(s.z, e.z, lo, hi, highest);
    return vec3(lo, hi, highest);
}

GN_FN bool touches_texel(vec3 times, float slack) { return times.z >= 0.0f && times.x - slack <= times.y + slack; }

// The range's times in the shutter.
GN_FN vec2 range_times(vec3 times, float cell_start, float per_cell, float slack) {
    return vec2((cell_start + (times.x - slack)) * per_cell, (cell_start + (times.y + slack)) * per_cell);
}

GN_END
#endif
