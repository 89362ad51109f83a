#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the queue of the shadow test: the slots that hit something, in order.
// Reads:   hits, runs (scanned)
// Writes:  Queue; ShadowGroups (workgroups of 64 that take the queue), HitTotal (to which the queue's length is added)
// Grid:    one invocation per run
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
READ_UVEC4(0, hits)
READ_UINT(1, runs)
layout(binding = 2, scalar) writeonly buffer Queue { uint queue[]; };
layout(binding = 3, scalar) writeonly buffer ShadowGroups { uvec3 shadow_groups; };
layout(binding = 4, scalar) buffer HitTotal { uvec2 hit_total; };
layout(push_constant, scalar) uniform Push { CompactParams params; };

void main() {
    uint run = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (run >= params.run_count) return;
    if (run == 0u) {
        uint hits = fetch_runs(params.run_count);
        uint groups = (hits + 63u) / 64u;
        uint rows = max((groups + kShadowRow - 1u) / kShadowRow, 1u);
        shadow_groups = uvec3((groups + rows - 1u) / rows, rows, 1u);
        uint low = hit_total.x + hits;
        hit_total = uvec2(low, hit_total.y + (low < hits ? 1u : 0u));
    }
    uint place = fetch_runs(run);
    uint slot = run * kScanRun;
    uint end = slot + kScanRun;
    do {
        uvec4 h = fetch_hits(slot / 4u);
        [[unroll]] for (uint j = 0u; j < 4u; ++j) {
            if (h[j] != kNone) {
                queue[place] = slot + j;
                ++place;
            }
        }
        slot += 4u;
    } while (slot < end);
}
