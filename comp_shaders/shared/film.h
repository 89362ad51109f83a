// SPDX-License-Identifier: Apache-2.0
// The film's planes: sums over the samples of each pixel, float, plane-major; sample/resolve makes them the picture's channels.
#ifndef GNOMON_SHARED_FILM_H
#define GNOMON_SHARED_FILM_H
#include "lang.h"
GN_BEGIN

const uint kFilmRed = 0u;
const uint kFilmGreen = 1u;
const uint kFilmBlue = 2u;
const uint kFilmHits = 3u;    // Samples that hit something.
const uint kFilmDepth = 4u;   // Metres along the view axis, over the samples that hit.
const uint kFilmLights = 5u;  // Planes before those of the lights.

// Visibility of a light, over the samples that hit; in the plane behind it its squares, which become its standard error.
GN_FN uint film_visibility(uint light) { return kFilmLights + 2u * light; }

GN_FN uint film_planes(uint lights) { return kFilmLights + 2u * lights; }

GN_END
#endif
