#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: what a layout makes of each list, or tile, before it is filled.
// Reads, writes: what the layout says
// Grid:    one invocation per list, or tile
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#define LAYOUT_FUNCTION layout_prepare
#define LAYOUT_OF_TILES LAYOUT_PREPARES_TILES
#include "sbuffer/each.glsl"
