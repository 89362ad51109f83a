// SPDX-License-Identifier: Apache-2.0
// The bias of methods that compare depths. Needs: common/shadow_test.glsl

layout(constant_id = 8) const float kBias = 0.0;        // Metres,
layout(constant_id = 9) const float kBiasTexels = 0.0;  // and so many widths of a texel, a perspective view's at the hit's depth.

// Metres along the light's axis of a depth in the light's view, less the bias.
float biased_metres(float depth) {
    float metres = kOrthographic ? depth : -1.0 / depth;
    float texel = (kOrthographic ? 1.0 : metres) / min(params.scale_x, params.scale_y);
    return metres - (kBias + kBiasTexels * texel);
}
