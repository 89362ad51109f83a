// SPDX-License-Identifier: Apache-2.0
// One of each kind of declaration, for a test.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(constant_id = 7) const bool kFlag = true;
struct Pair {
    vec3 a;
    float b;
};
layout(scalar, set = 0, binding = 4) uniform Settings {
    vec3 scale;
    uint index;
};
layout(set = 0, binding = 2) uniform usamplerBuffer ids;
layout(set = 0, binding = 3) uniform samplerBuffer points;
layout(scalar, set = 0, binding = 9) readonly buffer Header {
    uvec3 head;
    uint tail[];
};
layout(scalar, set = 0, binding = 0) buffer Sums { vec3 sums[]; };
layout(scalar, push_constant) uniform Params {
    uint first;         // 0
    vec3 direction;     // 4
    mat4x3 matrix;      // 16, four columns of 12
    float weights[5];   // 64
    Pair pairs[2];      // 84, 16 each
    uvec2 last;         // 116
};

void main() {
    vec3 sum = scale * float(index + first + last.x + tail[0]) + direction + matrix * vec4(weights[1]) + pairs[1].a;
    sums[gl_LocalInvocationIndex] = kFlag ? sum + texelFetch(points, int(texelFetch(ids, 0).x + head.x)).xyz : vec3(0);
}
