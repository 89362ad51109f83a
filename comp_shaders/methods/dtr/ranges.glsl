// SPDX-License-Identifier: Apache-2.0
// Do the ranges of a hit's list occlude it? One of another triangle whose time includes the hit's does where the depth between its entry and its exit, interpolated
// linearly, is nearer by more than the bias. Needs: GN_RANGE_EXIT, common/shadow_test.glsl, common/read_lists.glsl
// Based on: Hong and Oh 2018, "Motion-blurred shadows utilizing a depth-time ranges shadow map", section 3.3
#include "common/bias.glsl"

// Hit `i` of the queue; its list is walked if `walk`.
bool occluded_by_ranges(uint i, ShadowTest test, bool walk, inout uint visited, inout uint tested) {
    float t = test.receiver.t;
    // Ranges hold metres along the view's axis, which a perspective view's depth is not.
    float limit = biased_metres(test.limit);
    float metres_near = kOrthographic ? params.depth_near : -1.0 / params.depth_near;
    bool occluded = known_shadowed(i, test);
    Query query = Query(t, limit, false);
    Iterator it = walk_from(i, test, query);
    uint steps = 0u;
    bool more = test.here && walk && !occluded && layout_more(it);
    while (more) {
        Range range = layout_next(it, query);
        bool candidate = t >= range.enter && t <= range.leave && (range.entry & ~kReversed) != test.own;
        float depth = mix(range.depth, range.exit_depth, (t - range.enter) / max(range.leave - range.enter, 1e-30));
        occluded = occluded || (candidate && depth > metres_near && depth < limit);
        if (kCount) ++visited;
        if (kCount) tested += candidate ? 1u : 0u;
        ++steps;
        more = layout_more(it) && !occluded && (!kResume || steps < kListChunk);
    }
    leave_walk(i, it);
    return occluded;
}
