// SPDX-License-Identifier: Apache-2.0
// What every stage includes first: extensions and the number of its workgroup.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/params.h"

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// a / b for a < 2^24, without lavapipe's slow division: by floats, then put right by the remainder.
uint divide(uint a, uint b) {
    uint q = uint(float(a) / float(b));
    int remainder = int(a - q * b);
    return remainder < 0 ? q - 1u : (remainder >= int(b) ? q + 1u : q);
}
