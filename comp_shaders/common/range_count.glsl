// SPDX-License-Identifier: Apache-2.0
// 64-bit totals of ranges per block of items. Needs: a buffer with uvec2 range_counts[] (low, high). All invocations of a subgroup give the same block.
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

void add_range_count(uint block, uint count) {
    uint sum = subgroupAdd(count);
    if (subgroupElect() && sum > 0u) {
        uint before = atomicAdd(range_counts[block].x, sum);
        if (before + sum < before) atomicAdd(range_counts[block].y, 1u);
    }
}
