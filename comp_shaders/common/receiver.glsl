// SPDX-License-Identifier: Apache-2.0
// A hit, found again from its sample: where on its triangle it lies. Needs: triangles, raster_vertices (the camera's), common/triangle.glsl
// and common/batch.glsl.

struct Receiver {
    uvec3 vertex;        // Of its triangle, in the triangle's own order.
    uint material;
    vec3 edges;          // The barycentrics times their sum.
    vec3 barycentrics;
    float depth;         // Camera depth z / w.
    float t;
    uint segment;
    float local_time;    // In the segment.
    uvec2 pixel;
};

// p: its sample. The segment is the one whose keys the trace stage used: that of the sample's camera cell.
Receiver fetch_receiver(uint entry, uvec2 pixel, vec3 p, uint stratum, uint spp, ViewGrid grid, bool straddle, bool orthographic) {
    Receiver h;
    h.pixel = pixel;
    h.t = p.z;
    uint cell = straddle ? cell_of(p.z, grid.cell_count) : divide(stratum, spp / grid.cell_count);
    h.segment = divide(cell, grid.cell_count / grid.segment_count);
    h.local_time = local_time_of(p.z, h.segment, grid.segment_count);
    uvec4 tri = fetch_triangles(entry & ~kReversed);
    h.vertex = tri.xyz;
    h.material = tri.w;
    MovingTriangle m = fetch_moving_triangle(entry & ~kReversed, h.segment * grid.vertex_stride, grid.vertex_stride);
    vec4 p0 = vertex_at(m.a0, m.d0, h.local_time);
    vec4 p1 = vertex_at(m.a1, m.d1, h.local_time);
    vec4 p2 = vertex_at(m.a2, m.d2, h.local_time);
    vec3 e = edges_at(p0, p1, p2, p.x - 0.5 * float(grid.width), p.y - 0.5 * float(grid.height));
    h.edges = e;
    h.barycentrics = e / (e.x + e.y + e.z);
    h.depth = orthographic ? depth_orthographic(e, p0, p1, p2) : depth_perspective(e, p0, p1, p2);
    return h;
}
