// SPDX-License-Identifier: Apache-2.0
// Workgroups numbered so that no thread is left with the heavy part of the picture: lavapipe gives each of its threads one contiguous part of a dispatch, which takes
// every kThreads-th workgroup instead. Neighbours in time stay neighbours in the picture.

// Of a dispatch of at least `group_count` workgroups, all of whose numbers below it are given once.
uint spread_group(uint group_count) {
    uint group = group_index();
    uint part = max(divide(group_count, kThreads), 1u);
    uint of = divide(group, part);
    return kThreads == 1u || group >= part * kThreads ? group : (group - of * part) * kThreads + of;
}
