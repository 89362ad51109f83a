// SPDX-License-Identifier: Apache-2.0
// Workgroups numbered in the order in which they start, so that neighbours in time are neighbours in the image and no thread is left with the heavy half: lavapipe gives
// each of its threads one contiguous part of a dispatch. Needs: a buffer with uint ticket, zero at the start.
shared uint s_ticket;

uint take_ticket() {
    if (gl_LocalInvocationIndex == 0u) s_ticket = atomicAdd(ticket, 1u);
    barrier();
    return s_ticket;
}
