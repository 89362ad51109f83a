// SPDX-License-Identifier: Apache-2.0
// Base colour textures: bilinear, in linear light, with glTF's wrap modes. Needs: usamplerBuffer texels (RGBA8 in one word, four of them an element), samplerBuffer srgb_to_linear (256).

// Farther ones are taken for this one: floats of their size hold no texel exactly, integers hold them no more.
const float kFarthestTexel = 1073741824.0;

// Wrap a texel coordinate: 0 repeat, 1 clamp to edge, 2 mirrored repeat. The remainder of a negative number is undefined.
uint wrap_texel(int i, uint size, uint mode) {
    uint period = mode == 2u ? 2u * size : size;
    uint m = i < 0 ? period - 1u - uint(-1 - i) % period : uint(i) % period;
    uint mirrored = m < size ? m : period - 1u - m;
    return mode == 1u ? uint(clamp(i, 0, int(size) - 1)) : mirrored;
}

vec4 fetch_texel(uint first, uvec2 size, ivec2 at, uint wrap) {
    uint place = first + wrap_texel(at.y, size.y, wrap >> 2u) * size.x + wrap_texel(at.x, size.x, wrap & 3u);
    uint word = texelFetch(texels, int(place / 4u))[place & 3u];
    return vec4(texelFetch(srgb_to_linear, int(word & 255u)).x, texelFetch(srgb_to_linear, int((word >> 8u) & 255u)).x,
                texelFetch(srgb_to_linear, int((word >> 16u) & 255u)).x, float(word >> 24u) * (1.0 / 255.0));
}

// image: first texel, width, height, wrap modes (u | v << 2).
vec4 sample_texture(uvec4 image, vec2 uv) {
    uvec2 size = image.yz;
    vec2 p = uv * vec2(size) - 0.5;
    vec2 base = floor(p);
    vec2 f = p - base;
    ivec2 i = ivec2(clamp(base, vec2(-kFarthestTexel), vec2(kFarthestTexel)));
    vec4 top = mix(fetch_texel(image.x, size, i, image.w), fetch_texel(image.x, size, i + ivec2(1, 0), image.w), f.x);
    vec4 bottom = mix(fetch_texel(image.x, size, i + ivec2(0, 1), image.w), fetch_texel(image.x, size, i + ivec2(1, 1), image.w), f.x);
    return mix(top, bottom, f.y);
}
