// SPDX-License-Identifier: Apache-2.0
// Every arithmetic instruction on floats, some of it precise, some on integers, and a subgroup operation, for a test.
#version 460
#extension GL_KHR_shader_subgroup_arithmetic : require
layout(local_size_x = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Input {
    mat4 m;
    vec4 v;
    float s;
    uint n;
};
layout(std430, set = 0, binding = 1) buffer Output {
    mat4 matrices[3];
    vec4 vectors[3];
    float scalars[4];
    uint integers[2];
};

void main() {
    precise float exact = s * s + v.x;
    scalars[0] = exact - v.y / s;
    scalars[1] = -mod(s, v.z);
    scalars[2] = dot(v, v.wzyx);
    scalars[3] = subgroupAdd(s * v.w);
    vectors[0] = v * s;
    vectors[1] = m * v;
    vectors[2] = v * m;
    matrices[0] = m * s;
    matrices[1] = m * m;
    matrices[2] = outerProduct(v, v);
    integers[0] = n * 3 + 1;
    integers[1] = n - 1;
}
