// SPDX-License-Identifier: Apache-2.0
#include "stages/bin.hpp"

#include <algorithm>
#include <bit>
#include <gnomon/error.hpp>
#include <optional>

#include "math/orientation.h"
#include "math/sample.h"
#include "shared/rect.h"
#include "stages/grid.hpp"
#include "stages/scan.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

// A block's rounds in bin/large.
constexpr uint32_t kMostTiles = (16384 / shared::kTileSize) * (16384 / shared::kTileSize);
static_assert(kMostTiles / (shared::kMostBlocks * shared::kBlockTiles) < shared::kMostTurns);

// From so many entries in a list on, in the mean, it pays to put them in order and to pass over some.
constexpr uint64_t kLongList = 32;

// Rectangles, and blocks, in memory at one time: what they take is seldom more.
constexpr uint64_t kRectBytes = uint64_t{64} << 20;
constexpr uint64_t kLeastBytes = uint64_t{1} << 18;
// Triangles of a chunk or a part are a multiple of this, which keeps every binding of rectangles aligned.
constexpr uint32_t kTriangleAlign = 64;

// Triangles [first, first + count).
struct Run {
    uint32_t first = 0;
    uint32_t count = 0;
};

// Blocks of large prisms that are in memory at one time: of each cell, those of a run of triangles.
struct BlockPass {
    struct Piece {
        uint32_t cell = 0;
        Run run;
    };
    std::vector<Piece> pieces;
    uint32_t block_count = 0;
};

[[noreturn]] void fail_lists(const View& view, const std::string& what) {
    throw Error(ErrorKind::out_of_memory, what + " in the tiles of a view are more than the device can bind",
                std::to_string(view.width) + "x" + std::to_string(view.height),
                "all lie in one of its tiles: use a larger --size or --shadow-res, or fewer --time-steps");
}

}  // namespace

// Lists the prisms of one window; counts first, fills after.
class Lister {
public:
    Lister(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, Listing listing, Bins& bins)
        : device_(device),
          programs_(programs),
          geometry_(geometry),
          rect_(rect_of(view, bins.window)),
          by_bounds_(listing == Listing::bounds),
          casting_(listing == Listing::casting),
          bins_(bins) {
        const gpu::Limits& limits = device.limits();
        const uint64_t cells = bins.tile_lists();
        const uint64_t bytes = std::min({kRectBytes, limits.max_storage_range, limits.most_elements(8) * sizeof(glm::uvec2),
                                         std::max(kLeastBytes, device.budget_left() / 8)});
        const uint64_t most =
            std::max<uint64_t>(kTriangleAlign, bytes / (cells * sizeof(glm::uvec2)) & ~(kTriangleAlign - 1ull));
        chunk_ = static_cast<uint32_t>(
            std::min<uint64_t>(most, groups_of(geometry.scene->triangle_count, kTriangleAlign) * kTriangleAlign));
        // Blocks of a part of one cell's triangles fit into one binding even if all are as large as can be.
        most_blocks_ = static_cast<uint32_t>(bytes / sizeof(glm::uvec2));
        part_log2_ = static_cast<uint32_t>(std::bit_width(std::max(kTriangleAlign, most_blocks_ / shared::kMostBlocks)) - 1);
        parts_ = static_cast<uint32_t>(groups_of(chunk_, 1ull << part_log2_));
        rects_ = device.allocate("rects", cells * chunk_ * sizeof(glm::uvec2));
        block_counts_ = device.allocate("block_counts", cells * parts_ * 4);
        block_cursor_ = device.allocate("block_cursor", 4);
        set_up({0, std::min(chunk_, bins.grid.triangle_count)});
    }

    /// One pass over all prisms. fill: the lists' cursors and entries, else only their counts.
    void run(bool fill, const gpu::Buffer& lists, const gpu::Buffer& entries) {
        for (uint32_t first = 0; first < bins_.grid.triangle_count; first += chunk_) {
            const Run chunk{first, std::min(chunk_, bins_.grid.triangle_count - first)};
            if (chunk.first != chunk_in_memory_.first) set_up(chunk);
            make_passes();
            // Entries get their places about in the order of the dispatches.
            const bool in_turns = fill && bins_.facing_first;
            list_small(fill, in_turns ? shared::kSeenFacing : shared::kSeenAny, chunk, lists, entries);
            for (const BlockPass& pass : passes_) list_large(fill, chunk, pass, lists, entries);
            if (in_turns) list_small(fill, shared::kSeenAway, chunk, lists, entries);
        }
    }

private:
    // The rectangles of a chunk.
    void set_up(const Run& chunk) {
        gpu::Recorder& recorder = device_.recorder();
        const uint32_t cells = bins_.tile_lists();
        const Lattice lattice = bins_.lattice.value_or(Lattice{});
        recorder.fill("setup/prisms", block_counts_, 0);
        for (uint32_t cell = 0; cell < cells; ++cell) {
            recorder.dispatch("setup/prisms",
                              programs_.get("setup/prisms", {casting_, part_of(cell), bins_.lattice.has_value()}),
                              bindings({{"triangles", &geometry_.scene->triangles, Texel::rgba32_uint},
                                        {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                                        {"shells", &geometry_.scene->shells, Texel::r32_uint},
                                        {"closed", &geometry_.closed, Texel::r32_uint},
                                        {"positions", &geometry_.positions, Texel::rgba32_float},
                                        {"still", &geometry_.still, Texel::r32_uint},
                                        {"Rects", &rects_, {}, rect_bytes(cell, 0), rect_bytes(0, chunk_)},
                                        {"BlockCounts", &block_counts_}}),
                              shared::PrismParams{bins_.grid, cell, chunk.first, chunk.count, part_log2_, cell * parts_,
                                                  rect_.first_tile, rect_.last_tile, geometry_.box.lower, geometry_.box.upper,
                                                  lattice.spp, shared::stratum_length(lattice.spp), lattice.seed},
                              groups_of(chunk.count, 64));
        }
        blocks_of_chunk_ = recorder.download(block_counts_, 0, uint64_t(cells) * parts_ * 4);
        chunk_in_memory_ = chunk;
    }

    // Of the chunk's blocks.
    void make_passes() {
        if (!blocks_of_chunk_) return;
        const std::vector<uint32_t> counts = gpu::values_of<uint32_t>(device_, *blocks_of_chunk_);
        blocks_of_chunk_.reset();
        passes_.clear();
        uint32_t most = 0;
        const uint32_t cells = bins_.tile_lists();
        for (uint32_t cell = 0; cell < cells; ++cell) {
            for (uint32_t part = 0; part < parts_; ++part) {
                const uint32_t blocks = counts[cell * parts_ + part];
                if (blocks == 0) continue;
                if (passes_.empty() || passes_.back().block_count + uint64_t(blocks) > most_blocks_) passes_.emplace_back();
                BlockPass& pass = passes_.back();
                const uint32_t first = part << part_log2_;
                pass.pieces.push_back({cell, {first, std::min(1u << part_log2_, chunk_in_memory_.count - first)}});
                pass.block_count += blocks;
                most = std::max(most, pass.block_count);
            }
        }
        const uint64_t bytes = uint64_t(most) * sizeof(glm::uvec2);
        if (!blocks_ || blocks_.bytes() < bytes) {
            blocks_ = gpu::Buffer();
            blocks_ = device_.allocate("blocks", bytes);
        }
    }

    // seen: the orientations whose turn it is.
    void list_small(bool fill, uint32_t seen, const Run& chunk, const gpu::Buffer& lists, const gpu::Buffer& entries) const {
        for (uint32_t cell = 0; cell < bins_.tile_lists(); ++cell) {
            device_.recorder().dispatch(
                fill ? "bin/fill" : "bin/count", programs_.get("bin/small", {fill, by_bounds_, apart()}),
                bindings({{"rects", &rects_, Texel::rg32_uint, rect_bytes(cell, 0), rect_bytes(0, chunk_)},
                          {"Lists", &lists},
                          {"Entries", &entries}}),
                shared::BinParams{bins_.grid, cell, chunk.first, chunk.count, 0, 0, 0, seen}, groups_of(chunk.count, 64));
        }
    }

    void list_large(bool fill, const Run& chunk, const BlockPass& pass, const gpu::Buffer& lists,
                    const gpu::Buffer& entries) const {
        gpu::Recorder& recorder = device_.recorder();
        recorder.fill("bin/blocks", block_cursor_, 0);
        for (const BlockPass::Piece& piece : pass.pieces) {
            recorder.dispatch("bin/blocks", programs_.get("bin/blocks"),
                              bindings({{"rects", &rects_, Texel::rg32_uint, rect_bytes(piece.cell, 0), rect_bytes(0, chunk_)},
                                        {"Blocks", &blocks_},
                                        {"BlockCount", &block_cursor_}}),
                              shared::BinParams{bins_.grid, piece.cell, chunk.first + piece.run.first, piece.run.count,
                                                piece.run.first, 0, 0, 0},
                              groups_of(piece.run.count, 64));
        }
        recorder.dispatch(fill ? "bin/fill_large" : "bin/count_large", programs_.get("bin/large", {fill, by_bounds_, apart()}),
                          bindings({{"blocks", &blocks_, Texel::rg32_uint},
                                    {"rects", &rects_, Texel::rg32_uint},
                                    {"triangles", &geometry_.scene->triangles, Texel::rgba32_uint},
                                    {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                                    {"Lists", &lists},
                                    {"Entries", &entries}}),
                          shared::BinParams{bins_.grid, 0, chunk.first, chunk.count, 0, chunk_, pass.block_count, 0},
                          groups_of(uint64_t(pass.block_count) * shared::kBlockTiles, 64));
    }

    bool apart() const { return bins_.part == Part::apart; }
    // That a cell lists.
    uint32_t part_of(uint32_t cell) const {
        const Part part = !apart() ? bins_.part : cell < bins_.grid.cell_count ? Part::moving : Part::still;
        return static_cast<uint32_t>(part);
    }

    // Of so many cells and triangles.
    uint64_t rect_bytes(uint64_t cells, uint64_t triangles) const { return (cells * chunk_ + triangles) * sizeof(glm::uvec2); }

    gpu::Device& device_;
    Programs& programs_;
    const Geometry& geometry_;
    WindowRect rect_;
    bool by_bounds_;
    bool casting_;
    Bins& bins_;
    uint32_t chunk_ = 0;      // Triangles whose rectangles are in memory at one time.
    uint32_t parts_ = 0;      // Of a chunk, in which blocks are counted.
    uint32_t part_log2_ = 0;  // Triangles of a part.
    uint32_t most_blocks_ = 0;
    Run chunk_in_memory_;
    std::vector<BlockPass> passes_;
    gpu::Buffer rects_, block_counts_, block_cursor_, blocks_;
    std::optional<gpu::Download> blocks_of_chunk_;  // Until passes are made of them.
};

Bins project_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, uint32_t cell_count,
                    Part part) {
    Bins bins;
    bins.part = part;
    bins.grid = {view.width,
                 view.height,
                 tiles_across(view),
                 0,
                 cell_count,
                 part == Part::still ? 1 : geometry.segment_count,
                 geometry.scene->triangle_count,
                 geometry.vertex_stride};
    const uint64_t stride = geometry.vertex_stride;
    bins.raster_vertices = device.allocate("raster_vertices", stride * view.keys.size() * sizeof(glm::vec4));
    gpu::Recorder& recorder = device.recorder();
    for (size_t k = 0; k < view.keys.size(); ++k) {
        const ViewKey& key = view.keys[k];
        for (const VertexRun& run : vertex_runs(device, geometry)) {
            const uint64_t first = k * stride + run.first;
            shared::ProjectParams params{
                key.row_x, key.row_y, key.row_z, key.row_w, key.origin, run.count, static_cast<uint32_t>(first)};
            recorder.dispatch(
                "setup/project", programs.get("setup/project"),
                bindings(
                    {{"positions", &geometry.positions, Texel::rgba32_float},
                     {"RasterVertices", &bins.raster_vertices, {}, first * sizeof(glm::vec4), run.count * sizeof(glm::vec4)}}),
                params, groups_of(run.count, 64));
        }
    }
    return bins;
}

Binning::Binning(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Window& window,
                 Listing listing, Bins& bins)
    : device_(device), programs_(programs), view_(view), listing_(listing), bins_(bins) {
    const gpu::Limits& limits = device.limits();
    bins.window = window;
    bins.grid.tile_first = window.tile_first;
    bins.offsets = gpu::Buffer();
    bins.entries = gpu::Buffer();
    const uint64_t lists = bins.item_count();
    if (scan_bytes(lists) > std::min(limits.max_storage_range, limits.most_elements(4) * 4))
        fail_lists(view, std::to_string(lists) + " lists");
    bins.offsets = device.allocate("bin_offsets", scan_bytes(lists));
    cursors_ = device.allocate("bin_cursors", scan_bytes(lists));
    lister_ = std::make_unique<Lister>(device, programs, geometry, view, listing, bins);
}

Binning::~Binning() = default;
Binning::Binning(Binning&&) noexcept = default;

void Binning::count() {
    gpu::Recorder& recorder = device_.recorder();
    const uint64_t lists = bins_.item_count();
    recorder.fill("bin/count", cursors_, 0);
    lister_->run(false, cursors_, device_.allocate("bin_entries", 4));
    const Scan scan = record_scan(device_, programs_, cursors_, static_cast<uint32_t>(lists), bins_.offsets);
    recorder.copy("bin/fill", bins_.offsets, 0, cursors_, 0, scan_bytes(lists));
    total_ = recorder.download(bins_.offsets, lists * 4, 4);
    longest_ = recorder.download(scan.longest, 0, 4);
}

void Binning::fill() {
    const gpu::Limits& limits = device_.limits();
    bins_.entry_count = gpu::values_of<uint32_t>(device_, total_)[0];
    bins_.longest = gpu::values_of<uint32_t>(device_, longest_)[0];
    if (bins_.entry_count == shared::kNone) fail_lists(view_, "more than 2^32 prisms");
    if (bins_.entry_count > std::min(limits.max_storage_range / 4, limits.most_elements(4)))
        fail_lists(view_, std::to_string(bins_.entry_count) + " prisms");
    bins_.facing_first = listing_ == Listing::facing_first && bins_.entry_count >= uint64_t(bins_.item_count()) * kLongList;
    bins_.entries = device_.allocate("bin_entries", uint64_t(bins_.entry_count) * 4);
    if (bins_.entry_count > 0) lister_->run(true, cursors_, bins_.entries);
    if (bins_.in_order) put_in_order();
}

// On the host: it is for counting only.
void Binning::put_in_order() {
    const std::vector<uint32_t> offsets = gpu::download_vector<uint32_t>(device_, bins_.offsets, bins_.item_count() + 1);
    std::vector<uint32_t> entries = gpu::download_vector<uint32_t>(device_, bins_.entries, bins_.entry_count);
    for (size_t i = 0; i + 1 < offsets.size(); ++i)
        std::sort(entries.begin() + offsets[i], entries.begin() + offsets[i + 1],
                  [](uint32_t a, uint32_t b) { return std::rotl(a, 1) < std::rotl(b, 1); });  // kReversed last.
    if (!entries.empty()) gpu::upload(device_, bins_.entries, std::as_bytes(std::span(entries)));
}

void list_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Window& window,
                 Listing listing, Bins& bins) {
    Binning binning(device, programs, geometry, view, window, listing, bins);
    binning.count();
    binning.fill();
}

Bins bin_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, uint32_t cell_count,
                Listing listing, Part part) {
    Bins bins = project_prisms(device, programs, geometry, view, cell_count, part);
    list_prisms(device, programs, geometry, view, {0, tiles_across(view) * tiles_down(view)}, listing, bins);
    return bins;
}

}  // namespace gnomon
