// SPDX-License-Identifier: Apache-2.0
// Filtered stochastic shadow maps: a tile of a stochastic light map as layers of depth, each moved to the middle of the shutter
// along its mean motion onto a grid of its own.
// Based on: Andersson et al. 2015, "Filtered stochastic shadow mapping using a layered approach", sections 4 and 5; layers:
// Andersson et al. 2011, "Depth buffer compression for stochastic motion blur rasterization".
//
// Places are texels of the light map from the tile's centre, t is in the shutter, motion is per shutter, depth in metres along
// the light's axis. A grid is `size` texels wide and made from a window of `window` texels.
#ifndef GNOMON_MATH_FSSM_H
#define GNOMON_MATH_FSSM_H
#include "../shared/params.h"
#include "range.h"
GN_BEGIN

const uint kMostLayers = 4u;
// Equal intervals of a tile's depths.
const uint kIntervals = 64u;

// The depth at t = 1/2 of what is at `depth` at t (with the layer's motion z_reproj of section 4.1).
GN_FN float depth_at_middle(float depth, float motion, float t) {
    float z = depth + (0.5f - t) * motion;
    return z;
}

// The interval of [low, high] that a depth lies in.
GN_FN uint interval_of(float depth, float low, float high) {
    float place = high > low ? (depth - low) / (high - low) * float(kIntervals) : 0.0f;
    return min(uint(place), kIntervals - 1u);
}

// A set of intervals, 32 a word.
GN_FN uvec2 with_interval(uvec2 set, uint i) {
    return i < 32u ? uvec2(set.x | 1u << i, set.y) : uvec2(set.x, set.y | 1u << (i & 31u));
}
GN_FN bool has_interval(uvec2 set, uint i) { return (((i < 32u ? set.x : set.y) >> (i & 31u)) & 1u) != 0u; }

// The depth in the middle of a gap (its length and the interval behind it), or kFarthest for none.
GN_FN float gap_depth(uvec2 gap, float low, float high) {
    float place = (float(gap.y) - 0.5f * float(gap.x)) * (1.0f / float(kIntervals));
    return gap.x > 0u ? low + place * (high - low) : kFarthest;
}

// The far ends of at most `most` layers: in the middle of the longest gaps between occupied intervals, of equally long ones the
// nearer. The last layer ends half an interval behind `high`; layers that are not needed end at kFarthest.
GN_FN vec4 split_layers(uvec2 occupied, float low, float high, uint most) {
    uvec2 longest = uvec2(0u, 0u);
    uvec2 second = longest;
    uvec2 third = longest;
    uint run = 0u;
    for (uint i = 0u; i < kIntervals; ++i) {
        bool taken = has_interval(occupied, i);
        uvec2 gap = uvec2(taken ? run : 0u, i);
        bool first = gap.x > longest.x;
        bool next = gap.x > second.x;
        bool last = gap.x > third.x;
        third = next ? second : (last ? gap : third);
        second = first ? longest : (next ? gap : second);
        longest = first ? gap : longest;
        run = taken ? 0u : run + 1u;
    }
    float a = most > 1u ? gap_depth(longest, low, high) : kFarthest;
    float b = most > 2u ? gap_depth(second, low, high) : kFarthest;
    float c = most > 3u ? gap_depth(third, low, high) : kFarthest;
    vec3 split = vec3(min_of(a, b, c), max(min(a, b), min(max(a, b), c)), max_of(a, b, c));
    float end = high + (high - low) * (0.5f / float(kIntervals));
    vec4 ends;
    ends.x = split.x < kFarthest ? split.x : end;
    ends.y = split.x < kFarthest ? (split.y < kFarthest ? split.y : end) : kFarthest;
    ends.z = split.y < kFarthest ? (split.z < kFarthest ? split.z : end) : kFarthest;
    ends.w = split.z < kFarthest ? end : kFarthest;
    return ends;
}

// Levels of the layers' grids lie one behind the other in memory, each of all layers, from where any device can bind them.
// Where the next one begins, in tuples; size: the level's width.
GN_FN uint next_level(uint first, uint layer_count, uint size) { return (first + layer_count * size * size + 15u) / 16u * 16u; }

// Layers with samples.
GN_FN uint layer_count(vec4 ends) {
    return (ends.x < kFarthest ? 1u : 0u) + (ends.y < kFarthest ? 1u : 0u) + (ends.z < kFarthest ? 1u : 0u) +
           (ends.w < kFarthest ? 1u : 0u);
}

// The layer of a depth at t = 1/2; layer_count where it is behind all.
GN_FN uint layer_of(float depth, vec4 ends) {
    return (depth > ends.x ? 1u : 0u) + (depth > ends.y ? 1u : 0u) + (depth > ends.z ? 1u : 0u) + (depth > ends.w ? 1u : 0u);
}

// The transform M of a layer: u along its mean motion (x, y), v across.
struct LayerGrid {
    vec2 axis;     // Of u, a unit vector.
    float motion;  // Texels of the light map per shutter.
    vec2 scale;    // Eq. 11.
};

GN_FN LayerGrid layer_grid(vec2 motion, float window, float size) {
    float length = sqrt(motion.x * motion.x + motion.y * motion.y);
    LayerGrid g;
    g.motion = length;
    g.axis = length > 0.0f ? vec2(motion.x / length, motion.y / length) : vec2(1.0f, 0.0f);
    g.scale = vec2(size / (window + length), size / window);
    return g;
}

// Eq. 6 at t = 1/2: where on the grid, in its texels from its corner, a place at time t moves to.
GN_FN vec2 grid_point(LayerGrid g, vec2 place, float t, float size) {
    float along = g.axis.x * place.x + g.axis.y * place.y + g.motion * (0.5f - t);
    float across = g.axis.x * place.y - g.axis.y * place.x;
    return vec2(g.scale.x * along + 0.5f * size, g.scale.y * across + 0.5f * size);
}

// Where the filter reads: nothing beyond the centres of the grid's outermost texels.
GN_FN vec2 clamp_to_grid(vec2 p, float size) {
    return vec2(min(max(p.x, 0.5f), size - 0.5f), min(max(p.y, 0.5f), size - 0.5f));
}

// The share of light that a layer lets through to `depth`, measured as the tuple's depths are. tuple: eq. 7, sums of w a z, w a
// z^2, w a and w. Eq. 8 to 10; no shadow in front of the mean (Donnelly and Lauritzen 2006).
GN_FN float layer_visibility(vec4 tuple, float depth) {
    float mean = tuple.x / tuple.z;
    float variance = max(tuple.y / tuple.z - mean * mean, 0.0f);
    float behind = depth - mean;
    float lit = behind > 0.0f ? variance / (variance + behind * behind) : 1.0f;
    return tuple.z > 0.0f && tuple.w > 0.0f ? 1.0f - tuple.z / tuple.w * (1.0f - lit) : 1.0f;
}

// Half the base of the tent filter along v, in texels of the grid; no more than half the grid.
GN_FN float tent_reach(float motion, float size) { return min(0.5f * max(0.0f, 0.05f * (motion - 2.0f)), 0.5f * size); }

// The chance that a lookup goes to the neighbour in a place's direction, along one axis; place: tile widths from the centre.
GN_FN float neighbour_chance(float place) { return max(0.0f, 3.0f * (abs(place) - 1.0f / 3.0f)); }

// The neighbour along one axis that a lookup goes to: -1, 0 (the tile itself) or 1; random in [0, 1).
GN_FN float choose_neighbour(float place, float random) {
    return random < neighbour_chance(place) ? (place < 0.0f ? -1.0f : 1.0f) : 0.0f;
}

GN_END
#endif
