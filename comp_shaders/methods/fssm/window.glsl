// SPDX-License-Identifier: Apache-2.0
// The samples of a tile's search window. Needs: samplerBuffer map_samples (depth, motion in x, y and depth; per stratum, tile of 8 x 8 and texel), FssmParams params,
// common/batch.glsl.
#include "math/fssm.h"

layout(constant_id = 0) const uint kTile = 8u;     // Texels along a side of the method's tiles,
layout(constant_id = 1) const uint kWindow = 16u;  // of the window around each,
layout(constant_id = 2) const uint kGrid = 16u;    // of a layer's grid,
layout(constant_id = 3) const uint kLayers = 4u;   // layers of a tile, 1 to kMostLayers.

// A texel of the window. Samples are walked texel by texel: what they share is computed once.
struct WindowTexel {
    bool there;   // In the map.
    uvec2 place;  // In the map.
    uint hash;
    uint at;      // Of its sample of stratum params.stratum_first.
};

WindowTexel window_texel(uvec2 tile, uint x, uint y) {
    int tx = int(tile.x * kTile + x) - int((kWindow - kTile) / 2u);
    int ty = int(tile.y * kTile + y) - int((kWindow - kTile) / 2u);
    WindowTexel w;
    w.there = tx >= 0 && ty >= 0 && tx < int(params.grid.width) && ty < int(params.grid.height);
    w.place = uvec2(w.there ? tx : int(tile.x * kTile), w.there ? ty : int(tile.y * kTile));
    w.hash = pixel_hash(w.place.x, w.place.y, params.seed);
    uint map_tile = (w.place.y / kTileSize) * params.grid.tiles_x + w.place.x / kTileSize;
    w.at = (map_tile - params.sample_tile_first) * kTileTexels + (w.place.y & 7u) * kTileSize + (w.place.x & 7u);
    return w;
}

struct WindowSample {
    bool hit;
    vec2 place;   // Texels from the tile's centre.
    float t;
    float depth;
    vec3 motion;
};

WindowSample window_sample(WindowTexel texel, uvec2 tile, uint stratum) {
    vec4 s = texelFetch(map_samples, int(texel.at + (stratum - params.stratum_first) * params.sample_stride));
    vec3 point = sample_point(texel.hash, texel.place.x, texel.place.y, stratum, params.stratum_length);
    WindowSample w;
    w.hit = texel.there && s.x < kFarthest;
    w.place = point.xy - (vec2(tile) + 0.5) * float(kTile);
    w.t = point.z;
    w.depth = s.x;
    w.motion = s.yzw;
    return w;
}
