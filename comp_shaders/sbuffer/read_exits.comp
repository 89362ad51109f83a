#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the ranges of every list of an S-buffer, with the depth at their exit: how many, or copied one list behind the other.
// Reads:   what the layout says
// Writes:  Places (per list), Found (when copying), Iterators (when lists are walked in parts)
// Grid:    one invocation per list
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#define GN_RANGE_EXIT
#include "sbuffer/read.glsl"
