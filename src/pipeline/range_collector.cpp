// SPDX-License-Identifier: Apache-2.0
#include "pipeline/range_collector.hpp"

#include <algorithm>
#include <compare>
#include <gnomon/error.hpp>

#include "stages/read_lists.hpp"

namespace gnomon {
namespace {

// A total order, whatever a layout has made of the floats.
bool comes_before(const TexelRange& a, const TexelRange& b) {
    std::weak_ordering order = a.texel <=> b.texel;
    if (order == 0) order = std::weak_order(a.enter, b.enter);
    if (order == 0) order = a.triangle <=> b.triangle;
    if (order == 0) order = std::weak_order(a.leave, b.leave);
    if (order == 0) order = std::weak_order(a.depth, b.depth);
    if (order == 0) order = std::weak_order(a.exit_depth, b.exit_depth);
    return order < 0;
}

}  // namespace

RangeCollector::RangeCollector(const RenderSettings& settings, bool exit_depths)
    : keep_counts_(settings.keep_texel_ranges), keep_ranges_(settings.keep_ranges), keep_lengths_(settings.keep_list_lengths) {
    light_.exit_depths = exit_depths;
}

void RangeCollector::begin_face(const View& view) {
    row_first_ = light_.height;
    light_.width = view.width;
    light_.height += view.height;
    ++light_.faces;
    reciprocal_depths_ = !view.orthographic && !light_.exit_depths;
    if (keep_counts_) counts_.resize(uint64_t(view.width) * light_.height);
}

void RangeCollector::read(gpu::Device& device, Programs& programs, const SBuffer& s_buffer, const Band& band) {
    any_ = true;
    const shared::ViewGrid& grid = s_buffer.grid();
    const auto metres = [this](float depth) { return reciprocal_depths_ ? -1.0f / depth : depth; };
    const auto add = [&](uint64_t list, std::span<const uint32_t> counts, std::span<const shared::ListRange> ranges) {
        for (const uint32_t count : counts) {
            const auto texel_in_tile = static_cast<uint32_t>(list % shared::kTileTexels);
            const auto item = static_cast<uint32_t>(list++ / shared::kTileTexels);
            if (count == 0 && !keep_lengths_) continue;
            const uint32_t tile = grid.tile_first + item / grid.cell_count;
            const uint32_t column = tile % grid.tiles_x * shared::kTileSize + texel_in_tile % shared::kTileSize;
            const uint32_t row = tile / grid.tiles_x * shared::kTileSize + texel_in_tile / shared::kTileSize;
            const bool outside = column >= grid.width || row >= grid.height;
            if (outside && count > 0) {
                throw Error(ErrorKind::internal, "texels outside of a light's view have ranges", s_buffer.layout().name,
                            "correct the layout, if it is yours, or report it");
            }
            if (keep_lengths_ && !outside) {
                if (count >= lengths_.size()) lengths_.resize(uint64_t{count} + 1);
                ++lengths_[count];
            }
            if (count == 0) continue;
            const uint32_t texel = (row_first_ + row) * light_.width + column;
            if (keep_counts_) counts_[texel] += count;
            if (!keep_ranges_) continue;
            for (const shared::ListRange& r : ranges.first(count))
                light_.ranges.push_back(
                    {texel, r.enter, r.entry & ~shared::kReversed, r.leave, metres(r.depth), metres(r.exit_depth)});
            ranges = ranges.subspan(count);
        }
    };
    read_lists(device, programs, s_buffer, band, {light_.exit_depths, !keep_ranges_}, add);
}

void RangeCollector::finish(Frame& frame) {
    if (!any_) {
        light_ = {};
        counts_.clear();
    }
    std::sort(light_.ranges.begin(), light_.ranges.end(), comes_before);
    if (lengths_.size() > frame.list_lengths.size()) frame.list_lengths.resize(lengths_.size());
    for (size_t i = 0; i < lengths_.size(); ++i) frame.list_lengths[i] += lengths_[i];
    if (keep_counts_) frame.texel_ranges.push_back(std::move(counts_));
    if (keep_ranges_) frame.light_ranges.push_back(std::move(light_));
    light_ = {};
    counts_ = {};
    lengths_ = {};
}

}  // namespace gnomon
