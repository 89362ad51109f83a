// SPDX-License-Identifier: Apache-2.0
// Workgroups numbered so that no thread is left with the heavy part of the picture: lavapipe gives each of its threads one contiguous part of a dispatch, which takes
// every kThreads-th workgroup instead. Neighbours in time stay neighbours in the picture.

// The first of the items that this workgroup takes, `per_group` each, of a dispatch that has enough workgroups for `item_count`: each item is taken once.
uint spread_first(uint item_count, uint per_group) {
    uint group = group_index();
    uint part = max(divide((item_count + per_group - 1u) / per_group, kThreads), 1u);
    uint of = divide(group, part);
    return (kThreads == 1u || group >= part * kThreads ? group : (group - of * part) * kThreads + of) * per_group;
}
