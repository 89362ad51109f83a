// SPDX-License-Identifier: Apache-2.0
#include "stages/raster.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "stages/grid.hpp"
#include "stages/scan.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

// Ranges in memory start at a multiple of this, which keeps every binding aligned whatever the size of its elements.
constexpr uint64_t kRangeAlign = 64;

struct RasterStage {
    uint32_t items_per_group;   // Of one workgroup.
    uint32_t ranges_per_prism;  // Most in one list.
};

RasterStage raster_stage(const std::string& raster) {
    if (raster == "raster/conservative") return {8, 1};
    if (raster == "raster/analytic") return {1, 4};
    throw Error(ErrorKind::internal, "no such raster stage", raster, "report this as a bug");
}

uint64_t align_down(uint64_t value) { return value / kRangeAlign * kRangeAlign; }

}  // namespace

SBuffer::SBuffer(gpu::Device& device, Programs& programs, const Geometry& geometry, const Bins& bins, const Layout& layout,
                 const std::string& raster, bool orthographic)
    : device_(device),
      programs_(programs),
      geometry_(geometry),
      bins_(bins),
      layout_(layout),
      raster_(layout.stage(raster)),
      items_per_group_(raster_stage(raster).items_per_group),
      longest_(uint64_t(bins.longest) * raster_stage(raster).ranges_per_prism),
      orthographic_(orthographic) {
    item_count_ = bins.grid.tiles_x * bins.grid.tiles_y * bins.grid.cell_count;
    list_count_ = uint64_t(item_count_) * shared::kTileTexels;
    uint64_t blocks = groups_of(item_count_, shared::kCountBlock);
    range_counts_ = device.allocate("range_counts", blocks * sizeof(glm::uvec2));
    ticket_ = device.allocate("ticket", 4);
    unbound_ = device.allocate("unbound", 16);
    for (const LayoutBuffer& description : layout_.buffers) {
        uint64_t bytes =
            description.per == LayoutBuffer::Per::list ? scan_bytes(list_count_) / 4 * description.element_bytes : 4;
        gpu::Buffer buffer = description.per == LayoutBuffer::Per::range
                                 ? gpu::Buffer()
                                 : device.allocate("s_buffer." + description.block, bytes);
        memory_.push_back({description, std::move(buffer)});
    }
    count();
}

uint64_t SBuffer::bytes_per_range() const {
    uint64_t bytes = 0;
    for (const LayoutBuffer& b : layout_.buffers) bytes += b.per == LayoutBuffer::Per::range ? b.element_bytes : 0;
    return bytes;
}

void SBuffer::record_pass(gpu::Recorder& recorder, bool fill, const Band& part) {
    std::vector<gpu::Binding> all = {{"bin_offsets", &bins_.offsets, Texel::r32_uint},
                                     {"bin_entries", &bins_.entries, Texel::r32_uint},
                                     {"triangles", &geometry_.triangles, Texel::rgba32_uint},
                                     {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                                     {"RangeCounts", &range_counts_},
                                     {"Ticket", &ticket_}};
    uint64_t first_bound = std::max<uint64_t>(range_base_, align_down(part.range_first));
    for (const Memory& m : memory_) {
        uint64_t size = m.description.element_bytes;
        switch (m.description.per) {
            case LayoutBuffer::Per::once:
                all.push_back({m.description.block, &m.buffer});
                break;
            case LayoutBuffer::Per::list:
                all.push_back({m.description.block,
                               &m.buffer,
                               {},
                               uint64_t(part.item_first) * shared::kTileTexels * size,
                               uint64_t(part.item_count) * shared::kTileTexels * size});
                break;
            case LayoutBuffer::Per::range:
                if (!m.buffer) {
                    all.push_back({m.description.block, &unbound_});
                } else {
                    all.push_back({m.description.block,
                                   &m.buffer,
                                   {},
                                   (first_bound - range_base_) * size,
                                   std::max<uint64_t>(1, part.range_first + part.range_count - first_bound) * size});
                }
                break;
        }
    }
    uint64_t groups = groups_of(part.item_count, items_per_group_);
    for (uint32_t first = 0; first == 0 || first < bins_.longest; first += shared::kListChunk) {
        recorder.fill(fill ? "raster/fill" : "raster/count", ticket_, 0);
        recorder.dispatch(
            fill ? "raster/fill" : "raster/count", programs_.get(raster_, {fill, orthographic_}), all,
            shared::RasterParams{bins_.grid, part.item_count, part.item_first, first, static_cast<uint32_t>(first_bound)},
            groups);
    }
}

void SBuffer::count() {
    gpu::Recorder recorder(device_);
    recorder.fill("raster/count", range_counts_, 0);
    for (const Memory& m : memory_) {
        if (m.description.per == LayoutBuffer::Per::list && m.description.scan) recorder.fill("raster/count", m.buffer, 0);
    }
    // Lists are bound in parts that one binding can hold.
    uint64_t widest = 4;
    for (const LayoutBuffer& b : layout_.buffers)
        widest = std::max<uint64_t>(widest, b.per == LayoutBuffer::Per::list ? b.element_bytes : 4);
    uint64_t most_items =
        device_.limits().max_storage_range / (widest * shared::kTileTexels) / shared::kCountBlock * shared::kCountBlock;
    for (uint64_t first = 0; first < item_count_; first += most_items) {
        record_pass(
            recorder, false,
            {static_cast<uint32_t>(first), static_cast<uint32_t>(std::min<uint64_t>(most_items, item_count_ - first)), 0, 0});
    }
    std::vector<Scan> scans;
    for (const Memory& m : memory_) {
        if (m.description.scan)
            scans.push_back(record_scan(device_, programs_, recorder, m.buffer, static_cast<uint32_t>(list_count_)));
    }
    recorder.submit();
    for (const glm::uvec2& total :
         gpu::download_vector<glm::uvec2>(device_, range_counts_, groups_of(item_count_, shared::kCountBlock))) {
        block_ranges_.push_back(uint64_t(total.y) << 32 | total.x);
        range_count_ += block_ranges_.back();
    }
    if (range_count_ >= 0xffffffffull) {
        throw Error(ErrorKind::out_of_memory, std::to_string(range_count_) + " ranges in a light's view", "S-buffer",
                    "use a smaller --shadow-res");
    }
}

std::vector<Band> SBuffer::bands(uint64_t bytes) const {
    // What the device can read through one texel buffer bounds a band too.
    uint64_t most = std::min(bytes / std::max<uint64_t>(1, bytes_per_range()), device_.limits().max_texels);
    most = most > 2 * kRangeAlign ? most - 2 * kRangeAlign : 1;
    std::vector<Band> result(1);
    for (size_t i = 0; i < block_ranges_.size(); ++i) {
        Band* band = &result.back();
        if (block_ranges_[i] > most) {
            throw Error(
                ErrorKind::out_of_memory,
                "the ranges of one block of tiles take " + std::to_string(block_ranges_[i] * bytes_per_range()) + " bytes",
                "S-buffer", "allow a larger --memory-budget or use a larger --shadow-res");
        }
        if (band->range_count + block_ranges_[i] > most) {
            result.push_back({band->item_first + band->item_count, 0, band->range_first + band->range_count, 0});
            band = &result.back();
        }
        band->item_count +=
            std::min<uint32_t>(shared::kCountBlock, item_count_ - static_cast<uint32_t>(i) * shared::kCountBlock);
        band->range_count += block_ranges_[i];
    }
    return result;
}

std::vector<Band> SBuffer::parts(const Band& band) const {
    uint64_t widest = 4;
    for (const LayoutBuffer& b : layout_.buffers) widest = std::max<uint64_t>(widest, b.element_bytes);
    uint64_t most_ranges = device_.limits().max_storage_range / widest - 2 * kRangeAlign;
    uint32_t most_items = static_cast<uint32_t>(std::min<uint64_t>(
        item_count_,
        device_.limits().max_storage_range / (widest * shared::kTileTexels) / shared::kCountBlock * shared::kCountBlock));
    std::vector<Band> result = {{band.item_first, 0, band.range_first, 0}};
    uint32_t end = band.item_first + band.item_count;
    for (uint32_t item = band.item_first; item < end; item += shared::kCountBlock) {
        uint64_t ranges = block_ranges_[item / shared::kCountBlock];
        uint32_t items = std::min(shared::kCountBlock, end - item);
        Band* part = &result.back();
        if (ranges > most_ranges) {
            throw Error(ErrorKind::out_of_memory,
                        std::to_string(ranges) + " ranges in one block of tiles are more than the device can bind", "S-buffer",
                        "use a larger --shadow-res");
        }
        if (part->range_count + ranges > most_ranges || part->item_count + items > most_items) {
            result.push_back({item, 0, part->range_first + part->range_count, 0});
            part = &result.back();
        }
        part->item_count += items;
        part->range_count += ranges;
    }
    return result;
}

void SBuffer::fill(const Band& band) {
    range_base_ = static_cast<uint32_t>(align_down(band.range_first));
    uint64_t held = band.range_first + band.range_count - range_base_;
    for (Memory& m : memory_) {
        if (m.description.per != LayoutBuffer::Per::range) continue;
        m.buffer = gpu::Buffer();
        m.buffer =
            device_.allocate("s_buffer." + m.description.block, std::max<uint64_t>(1, held) * m.description.element_bytes);
    }
    gpu::Recorder recorder(device_);
    for (const Memory& m : memory_) {
        const LayoutBuffer& d = m.description;
        if (!d.copy_of.empty()) {
            auto source = std::find_if(memory_.begin(), memory_.end(),
                                       [&](const Memory& other) { return other.description.block == d.copy_of; });
            if (source == memory_.end() || source->buffer.bytes() != m.buffer.bytes()) {
                throw Error(ErrorKind::input, "'copy_of' names no buffer of the same size: " + d.copy_of,
                            layout_.name + "/layout.json", "name one of its blocks");
            }
            recorder.copy("raster/fill", source->buffer, 0, m.buffer, 0, m.buffer.bytes());
        }
        if (d.clear == LayoutBuffer::Clear::value) recorder.fill("raster/fill", m.buffer, d.clear_value);
    }
    for (const Band& part : parts(band)) {
        for (const Memory& m : memory_) {
            if (m.description.clear == LayoutBuffer::Clear::range_first)
                recorder.fill("raster/fill", m.buffer, static_cast<uint32_t>(part.range_first));
        }
        record_pass(recorder, true, part);
    }
    recorder.submit();
}

std::vector<gpu::Binding> SBuffer::read_bindings() const {
    std::vector<gpu::Binding> result;
    for (const Memory& m : memory_) {
        if (!m.description.texel.empty()) result.push_back({m.description.texel, &m.buffer, m.description.format});
    }
    return result;
}

}  // namespace gnomon
