// SPDX-License-Identifier: Apache-2.0
// Every push constant of every stage, scalar layout, shared by host and shader.
#ifndef GNOMON_SHARED_PARAMS_H
#define GNOMON_SHARED_PARAMS_H
#include "lang.h"
GN_BEGIN

// Texels (pixels) along a tile's side; the lanes of a tile's row and the rows that one invocation holds in registers.
const uint kTileSize = 8u;
const uint kTileTexels = 64u;
// Items (a tile in a cell of time) whose ranges are counted together, no fewer than a workgroup handles; bands of the S-buffer
// consist of whole blocks.
const uint kCountBlock = 8u;
// Depth where nothing is.
const float kFarthest = 3.4e38f;
// No triangle.
const uint kNone = 0xffffffffu;
// How a view projects: from an eye, along its axis, or from an eye as one of a light's faces (math/face.h).
const uint kPerspectiveView = 0u;
const uint kOrthographicView = 1u;
const uint kFaceView = 2u;
// Triangles that stand still at all keys may be listed apart from all others.
const uint kWholeScene = 0u;
const uint kStillPart = 1u;
const uint kMovingPart = 2u;
// Set in a list's entry: the triangle with its orientation reversed (vertices 1 and 2 swapped).
const uint kReversed = 0x80000000u;
// Prisms whose bounds in a cell hold at most this many tiles are binned without a closer look.
const uint kSmallTiles = 4u;
// Large prisms are binned by blocks of so many invocations, a tile each in every round; a prism has at most kMostBlocks of
// them.
const uint kBlockTiles = 8u;
const uint kMostBlocks = 256u;
// lavapipe ends every loop after so many turns of an invocation, all its loops together, without a word. What depends on the
// scene is walked in parts.
const uint kMostTurns = 65535u;
// Most list entries that one dispatch walks: raster/conservative goes round up to 10 times for an entry: for itself, for each
// of up to 8 rows, and once for each crew of entries (common/crew.glsl).
const uint kListChunk = 6144u;
// Fragments of a list that one dispatch of raster/prism pairs, up to the end of a prism's: it goes round once for each, and up
// to 7 times for the pairs of a prism, for whose loop being unrolled is a wish.
const uint kPairChunk = 6144u;
// Most workgroups of the shadow test in a row; its dispatch can be cut between rows.
const uint kShadowRow = 128u;
// Sizes of a layout, with the ranges.
const uint kMostSizes = 4u;
// The specialization constant of all stages: see common/stage.glsl.
const uint kThreadsConstant = 100u;
// Triangles that one invocation bounds.
const uint kBoundsRun = 16u;
// Elements that one invocation scans.
const uint kScanRun = 64u;
#ifdef __cplusplus
static_assert(kListChunk * 10u < kMostTurns && kPairChunk * 9u < kMostTurns && kMostBlocks < kMostTurns);
#endif

// Strata of a batch: sample/shade goes round twice for each, and twice for each of its lights.
GN_FN uint most_strata_of(uint light_count) { return kMostTurns / (2u * light_count + 3u); }
// So that there is one.
const uint kMostLights = (kMostTurns - 3u) / 2u;

// A view's image and how its prisms are listed.
struct ViewGrid {
    uint width;  // Texels.
    uint height;
    uint tiles_x;
    uint tile_first;  // Of the window, a run of tiles whose lists are in memory; items are numbered from there.
    uint cell_count;  // Equal parts of the shutter; a multiple of segment_count.
    uint segment_count;
    uint triangle_count;
    uint vertex_stride;  // Vertices from one key to the next.
};

struct PoseParams {
    uint vertex_first;  // Of the dispatch; what it writes is bound from there on.
    uint vertex_count;
};

struct BoundsParams {
    uint triangle_count;
    uint vertex_stride;
    uint key_count;
};

struct ExtentParams {
    ViewGrid grid;
    vec3 box_lower;  // Of the scene, at all keys.
    vec3 box_upper;
};

struct ProjectParams {
    vec4 row_x;  // raster = rows * (position - origin, 1)
    vec4 row_y;
    vec4 row_z;
    vec4 row_w;
    vec3 origin;
    uint vertex_count;
    uint vertex_first;  // In the positions; what is written is bound from there on.
};

struct PrismParams {
    ViewGrid grid;
    uint cell;
    uint triangle_first;  // Triangles [triangle_first, triangle_first + triangle_count), whose rectangles are in memory.
    uint triangle_count;
    uint part_log2;      // Their blocks are counted in parts of 2^part_log2 triangles,
    uint part_first;     // the first of this cell's being this one.
    uvec2 window_first;  // The window's first and last column and row of tiles.
    uvec2 window_last;
    vec3 box_lower;  // Of the scene, at all keys.
    vec3 box_upper;
    uint spp;  // Where only samples are asked for: math/sample.h
    float stratum_length;
    uint seed;
};

struct BinParams {
    ViewGrid grid;
    uint cell;            // bin/small, bin/blocks.
    uint triangle_first;  // Triangles [triangle_first, triangle_first + triangle_count). bin/large: the first in memory.
    uint triangle_count;
    uint rect_first;   // Where the first triangle's rectangle is among those that are bound.
    uint rect_stride;  // bin/large: rectangles from one cell to the next.
    uint block_count;  // bin/large.
    uint seen;         // bin/small: orientations whose turn it is.
};

struct ScanParams {
    uint count;      // Elements of the whole array.
    uint run_first;  // scan/spread: the first run of this dispatch, whose first element is the first of the bound memory.
    uint run_count;
};

// Pages with longer lists are split in four, in space (kSplitSpace) or in time, while that thins their lists.
const uint kLongPage = 256u;
const uint kSplitSpace = 1u;
const uint kSplitTime = 2u;
const uint kMostLevel = 8u;      // Of texels: each has half the side of those of the level before.
const uint kMostTimeLevel = 3u;  // Of cells: each lasts a quarter of those of the level before.
// Entries of a page that 8 invocations hand down to the pages that it is split into: a unit.
const uint kPageUnit = 512u;
// Invocations that count the entries of a unit, each for each of the four.
const uint kUnitCounts = 32u;

struct PageParams {
    ViewGrid grid;
    uint page_first;  // Pages [page_first, page_first + page_count) are new: split, or not.
    uint page_count;
    uint unit_count;   // Of those that are split.
    uint node_first;   // The number of the first node that they are split into: items of the window, then four for each unit.
    uint entry_first;  // Of a list's entries those from here on were handed down to pages, the others are the bins'.
    uint entry_next;   // Where those begin that are handed down now.
};

struct RasterParams {
    ViewGrid grid;
    uint item_count;  // Items (a tile of the window in a cell: tile * cell_count + cell), or pages, of this dispatch.
    uint item_first;
    uint list_first;               // Walk entries [list_first, list_first + kListChunk) of each list.
    uint last;                     // No dispatch after this one walks these lists on.
    uint band_first;               // The first item of the band that is made.
    uint place_first[kMostSizes];  // Of each size of the layout: the place in the band that is bound as the first.
    uint entry_first;              // As in PageParams.
    uint fragment_item;            // raster/prism: the first item whose fragments are in memory.
};

struct SizeParams {
    uint list_first;  // Lists [list_first, list_first + list_count) of the window.
    uint list_count;
};

struct ReadListsParams {
    uint list_first;  // Lists [list_first, list_first + list_count) of the band.
    uint list_count;
    uint part;  // How many times kListChunk ranges of each list were walked before.
};

// What shadow tests read of a layout, of some groups of kReadGroup hits that follow each other in the queue: a record of each
// query, each turn of its walk and each read.
const uint kReadGroup = 32u;
const uint kQueryBegins = 0xffffffffu;
const uint kTurnBegins = 0xfffffffeu;
struct LayoutRead {
    uint hit;   // Of the queue.
    uint when;  // Hits of a group read at one time what they read at the same: a round of the test << 16, and of its turns.
    uint what;  // A buffer of the layout; behind these, a size; or what begins.
    uint element;
};
struct ReadsHead {
    uint count;  // Of records; more than `most` were not kept.
    uint most;
    uint below;  // Of groups those whose hash is at most this.
};

// A range of an S-buffer as sbuffer/read gives it. Times are of the shutter. Depths are as the raster stage writes them: with
// one at the exit, metres along the view's axis; else the view's depth (math/cover.h).
struct ListRange {
    float enter;
    float leave;
    float depth;       // At the entry; of a conservative range the nearest.
    float exit_depth;  // `depth`, where ranges have none at their exit.
    uint entry;        // The triangle, and kReversed.
};

struct TraceParams {
    ViewGrid grid;
    uint tile_first;  // The batch: tiles [tile_first, tile_first + tile_count), strata [stratum_first, ...).
    uint tile_count;
    uint stratum_first;
    uint stratum_count;
    uint spp;
    float stratum_length;  // math/sample.h
    uint seed;
    uint list_first;   // Of each list kListChunk entries are walked, from this one on,
    uint cell_turn;    // in the cell that comes so many after the stratum's first.
    float depth_near;  // A hit's depth is > depth_near and < depth_far.
    float depth_far;
};

struct MapDepthParams {
    ViewGrid grid;
    uint tile_first;  // The batch, as in TraceParams.
    uint tile_count;
    uint stratum_first;
    uint stratum_count;
    uint spp;
    float stratum_length;  // math/sample.h
    uint seed;
};

struct ClusterParams {
    uint tile_count;  // Of the batch.
    uint spp;
    uint texel_first;        // Its place among the map's.
    uint cluster_first;      // The number of its first cluster.
    float extent;            // Of a cluster: metres,
    float extent_per_metre;  // and so many more for each metre of its nearest sample's depth.
};

// methods/fssm/layers and reproject. Tiles are the method's own, rows of tiles_x.
struct FssmParams {
    ViewGrid grid;  // Of the light's map.
    uint tiles_x;
    uint tile_first;  // Tiles [tile_first, tile_first + tile_count) of the map.
    uint tile_count;
    uint layer_first;        // Where the first tile's layers are in memory,
    uint tuple_first;        // and the tuples of its grid in the bound memory.
    uint sample_tile_first;  // The tile of the map, of 8 x 8 texels, whose samples are the first in memory,
    uint sample_stride;      // and samples from one stratum to the next.
    uint spp;
    float stratum_length;  // math/sample.h
    uint seed;
    uint stratum_first;  // Strata [stratum_first, stratum_first + stratum_count).
    uint stratum_count;
};

struct FssmMipParams {
    uint layer_count;
    uint read_first;   // Where the first layer's tuples are in the bound memory of the level that is read,
    uint write_first;  // and in that of the level that is written,
    uint level_bits;   // whose width is 2^level_bits texels.
};

struct CompactParams {
    uint run_count;  // Runs of kScanRun samples.
};

struct ShadowParams {
    ViewGrid camera;
    uint run_count;  // The number of hits is behind so many sums of runs.
    uint tile_first;
    uint stratum_first;
    uint stratum_count;
    uint spp;
    float stratum_length;  // math/sample.h
    uint seed;
    uint light;
    uint face;        // math/face.h
    uint light_size;  // Texels along either side of the light's view.
    uint light_cell_count;
    uint light_tile_first;  // Of the window of the light's view.
    uint light_tile_count;
    uint light_cell_major;  // 0: item of tile and cell is tile * light_cell_count + cell; else cell * light_tile_count + tile.
    float light_cell_length;  // Of the shutter.
    float scale_x;            // Raster units per metre (orthographic), or per unit slope (perspective).
    float scale_y;
    float cone;  // Squared tangent of a spot's outer half angle; of a light of several faces its cosine, less than -1 for all
                 // directions.
    float tolerance;   // The least metres along a hit's normal within which nothing occludes.
    float depth_near;  // Occluders are deeper than this.
    uint item_first;   // Items of the window, or pages, whose ranges are in memory. sample/descend: new pages.
    uint item_count;
    uint range_first;  // The number of the first range in memory. sample/descend: PageParams::node_first.
    uint part;         // How many times kListChunk ranges of each list were walked before.
};

struct ShadeParams {
    ViewGrid grid;
    uint tile_first;
    uint tile_count;
    uint stratum_first;
    uint stratum_count;
    uint spp;
    float stratum_length;  // math/sample.h
    uint seed;
    uint light_count;
    uint key_count;
    uint film_width;  // Pixels of the window, rows from the top: its film.
    uint film_pixels;
    uint lit_stride;  // Slots from one word of the lights' bits to the next; of fractional visibility, from one light's to the
                      // next.
};

struct ResolveParams {
    uint pixel_count;  // Of the film.
    uint spp;
    uint light_count;
};

GN_END
#endif
