#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: vertices in a view's raster space (math/cover.h) at one key.
// Reads:   positions (world space)
// Writes:  RasterVertices of the key and the vertices
// Grid:    one invocation per vertex
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1, scalar) writeonly buffer RasterVertices { vec4 raster_vertices[]; };
layout(push_constant, scalar) uniform Push { ProjectParams params; };

float row_times(vec4 row, vec3 p) { return row.x * p.x + row.y * p.y + row.z * p.z + row.w; }

void main() {
    uint v = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (v >= params.vertex_count) return;
    // The origin first: near the view nothing is lost to cancellation.
    vec3 p = texelFetch(positions, int(params.vertex_first + v)).xyz - params.origin;
    raster_vertices[v] = vec4(row_times(params.row_x, p), row_times(params.row_y, p), row_times(params.row_z, p), row_times(params.row_w, p));
}
