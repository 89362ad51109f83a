// SPDX-License-Identifier: Apache-2.0
// Sums that say when they do not fit: 0xffffffff, and so is everything added to it.

uint saturating_add(uint a, uint b) {
    uint carry;
    uint sum = uaddCarry(a, b, carry);
    return carry != 0u ? 0xffffffffu : sum;
}
