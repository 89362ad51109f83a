// SPDX-License-Identifier: Apache-2.0
// A crew: neighbouring invocations that walk one list together. Each prepares an element of its own and shows it to the others in turn, which takes a shuffle a
// number instead of a fetch and a preparation each. kCrew invocations, or a whole subgroup where that is smaller. A subgroup may hold several crews, whose lists
// have different lengths: its loops around shuffles go round as often as the longest needs, so that all invocations leave them together. Needs: kCrew, 1, 2, 4 or 8.
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

struct Crew {
    uint size;
    uint first;  // gl_SubgroupInvocationID of its first.
    uint place;  // This one's.
};

Crew join_crew() {
    Crew crew;
    crew.size = min(kCrew, gl_SubgroupSize);
    crew.place = gl_SubgroupInvocationID & (crew.size - 1u);
    crew.first = gl_SubgroupInvocationID - crew.place;
    return crew;
}

// The same for all invocations of the subgroup: the most that one of them asks for.
uint rounds_of(uint own) { return subgroupMax(own); }

// The invocation's number in a workgroup of whole subgroups, by which a crew's are neighbours.
uint crewed_invocation() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// The largest value of the crew, for all of it.
float crew_max(Crew crew, float value) {
    [[unroll]] for (uint apart = 1u; apart < 8u; apart *= 2u) {
        float other = subgroupShuffle(value, apart < crew.size ? gl_SubgroupInvocationID ^ apart : gl_SubgroupInvocationID);
        value = max(value, other);
    }
    return value;
}
