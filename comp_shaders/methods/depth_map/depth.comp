#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the depth of each sample of a light's view, metres along the view's axis, and how its surface moves, per shutter: along the axis (kFloats 2), or across it too,
//          in texels (kFloats 4: depth, x, y, along). Where nothing was hit: farther than everything, at rest.
// Reads:   hits, triangles, raster_vertices
// Writes:  MapSamples (per tile, stratum and texel of the batch, rows from the top)
// Grid:    one invocation per sample of the batch
// Based on: Akenine-Moller et al. 2007, "Stochastic rasterization using time-continuous triangles", section 5; motion: Andersson et al. 2015, sections 4.1 and 5.1
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOrthographic = false;
layout(constant_id = 1) const bool kStraddle = false;  // As in sample/trace.
layout(constant_id = 2) const uint kFloats = 1u;       // Of a sample.
layout(constant_id = 3) const bool kSliced = false;    // As in sample/trace.
layout(binding = 0) uniform usamplerBuffer hits;
layout(binding = 1) uniform usamplerBuffer triangles;
layout(binding = 2) uniform samplerBuffer raster_vertices;
layout(binding = 3, scalar) writeonly buffer MapSamples { float map_samples[]; };
layout(push_constant, scalar) uniform Push { MapDepthParams params; };
#include "common/triangle.glsl"
#include "common/batch.glsl"
#include "common/receiver.glsl"

// Metres along the view's axis.
float metres_of(vec4 p) { return kOrthographic ? p.z : p.w; }

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    ViewGrid grid = params.grid;
    bool inside = i < params.tile_count * params.stratum_count * kTileTexels;
    i = inside ? i : 0u;
    uint entry = texelFetch(hits, int(i)).x;
    bool hit = entry != kNone;
    entry = hit ? entry & ~kReversed : grid.triangle_count;
    Slot s = unpack_slot(i, params.stratum_count);
    uvec2 texel = slot_pixel(s, params.tile_first, grid.tiles_x);
    uint stratum = params.stratum_first + s.stratum;
    vec3 point = view_sample(kSliced, texel.x, texel.y, stratum, params.stratum_length, params.seed);
    Receiver h = fetch_receiver(entry, texel, point, stratum, params.spp, grid, kStraddle, kOrthographic);
    MovingTriangle m = fetch_moving_triangle(entry, h.segment * grid.vertex_stride, grid.vertex_stride);
    vec4 a = h.barycentrics.x * m.a0 + h.barycentrics.y * m.a1 + h.barycentrics.z * m.a2;
    vec4 d = h.barycentrics.x * m.d0 + h.barycentrics.y * m.d1 + h.barycentrics.z * m.d2;
    float depth = metres_of(a) + h.local_time * metres_of(d);
    float motion = metres_of(d) * float(grid.segment_count);

    uint at = kFloats * ((s.tile * params.stratum_count + s.stratum) * kTileTexels + s.row * kTileSize + s.column);
    if (inside) {
        map_samples[at] = hit ? depth : kFarthest;
        if (kFloats == 2u) map_samples[at + 1u] = hit ? motion : 0.0;
        if (kFloats == 4u) {
            // The image of a point that moves evenly in space: the quotient rule.
            vec4 p = a + h.local_time * d;
            vec2 across = (d.xy - p.xy / p.w * d.w) / p.w * float(grid.segment_count);
            map_samples[at + 1u] = hit ? across.x : 0.0;
            map_samples[at + 2u] = hit ? across.y : 0.0;
            map_samples[at + 3u] = hit ? motion : 0.0;
        }
    }
}
