// SPDX-License-Identifier: Apache-2.0
// The film's planes: sums over the samples of each pixel, float, plane-major.
#ifndef GNOMON_SHARED_FILM_H
#define GNOMON_SHARED_FILM_H
#include "lang.h"
GN_BEGIN

const uint kFilmRed = 0u;
const uint kFilmGreen = 1u;
const uint kFilmBlue = 2u;
const uint kFilmHits = 3u;   // Samples that hit something.
const uint kFilmDepth = 4u;  // Metres along the view axis, over the samples that hit.
// One plane per light, over the samples that hit; then, of fractional visibility, one of squares for each.
const uint kFilmVisibility = 5u;

// Words of a light's record in the lights' buffer (vec4 each): colour times intensity and kind; cone scale, cone offset, range;
// then position and rotation (quaternion x y z w) for each key.
const uint kLightHead = 2u;
const uint kLightPerKey = 2u;
const uint kLightDirectional = 0u;
const uint kLightSpot = 1u;

GN_END
#endif
