// SPDX-License-Identifier: Apache-2.0
// 64-bit totals per block of items. Needs: a buffer with uvec2 range_counts[] (low, high).
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

void add_to_block(uint block, uint count) {
    uint before = atomicAdd(range_counts[block].x, count);
    if (before + count < before) atomicAdd(range_counts[block].y, 1u);
}

// All invocations of a subgroup give the same block.
void add_range_count(uint block, uint count) {
    uint sum = subgroupAdd(count);
    if (subgroupElect() && sum > 0u) add_to_block(block, sum);
}
