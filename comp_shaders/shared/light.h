// SPDX-License-Identifier: Apache-2.0
// A light's record in the lights' buffer, and the bits of the lights that reach a hit.
#ifndef GNOMON_SHARED_LIGHT_H
#define GNOMON_SHARED_LIGHT_H
#include "lang.h"
GN_BEGIN

// Words of a record (vec4 each): colour times intensity and kind; cone scale, cone offset, range; then for each key the
// position with the angle between its rotation and the next key's (radians, as quaternions), and the rotation (quaternion x y z
// w). A point light is a spot whose cone is everything, and does not turn.
const uint kLightHead = 2u;
const uint kLightPerKey = 2u;
const uint kLightDirectional = 0u;
const uint kLightSpot = 1u;

GN_FN uint light_record(uint light, uint key_count) { return light * (kLightHead + kLightPerKey * key_count); }
GN_FN uint light_key(uint light, uint key, uint key_count) {
    return light_record(light, key_count) + kLightHead + kLightPerKey * key;
}

// A hit has a bit for each light, in words of a plane each.
GN_FN uint lit_words(uint light_count) { return max((light_count + 31u) / 32u, 1u); }
GN_FN uint lit_word(uint light) { return light / 32u; }
GN_FN uint lit_bit(uint light) { return light & 31u; }

GN_END
#endif
