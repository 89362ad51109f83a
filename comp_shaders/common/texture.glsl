// SPDX-License-Identifier: Apache-2.0
// Base colour textures: bilinear, in linear light, with glTF's wrap modes. Needs: usamplerBuffer texels (RGBA8 in one word), samplerBuffer srgb_to_linear (256).

// Wrap a texel coordinate: 0 repeat, 1 clamp to edge, 2 mirrored repeat.
int wrap_texel(int i, int size, uint mode) {
    int period = mode == 2u ? 2 * size : size;
    int m = i % period;
    m = m < 0 ? m + period : m;
    int mirrored = m < size ? m : period - 1 - m;
    return mode == 1u ? clamp(i, 0, size - 1) : mirrored;
}

vec4 fetch_texel(uint first, ivec2 size, ivec2 at, uint wrap) {
    ivec2 p = ivec2(wrap_texel(at.x, size.x, wrap & 3u), wrap_texel(at.y, size.y, wrap >> 2u));
    uint word = texelFetch(texels, int(first) + p.y * size.x + p.x).x;
    return vec4(texelFetch(srgb_to_linear, int(word & 255u)).x, texelFetch(srgb_to_linear, int((word >> 8u) & 255u)).x,
                texelFetch(srgb_to_linear, int((word >> 16u) & 255u)).x, float(word >> 24u) * (1.0 / 255.0));
}

// image: first texel, width, height, wrap modes (u | v << 2).
vec4 sample_texture(uvec4 image, vec2 uv) {
    ivec2 size = ivec2(image.yz);
    vec2 p = uv * vec2(size) - 0.5;
    vec2 base = floor(p);
    vec2 f = p - base;
    ivec2 i = ivec2(base);
    vec4 top = mix(fetch_texel(image.x, size, i, image.w), fetch_texel(image.x, size, i + ivec2(1, 0), image.w), f.x);
    vec4 bottom = mix(fetch_texel(image.x, size, i + ivec2(0, 1), image.w), fetch_texel(image.x, size, i + ivec2(1, 1), image.w), f.x);
    return mix(top, bottom, f.y);
}
