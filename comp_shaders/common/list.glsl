// SPDX-License-Identifier: Apache-2.0
// The lists of an S-buffer, for a test that walks them. Needs: common/shadow_test.glsl
uint range_base() { return params.range_first; }
#define ListIterator uvec2
#define LAYOUT_READ
#include "layout.glsl"
