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

uint64_t align_down(uint64_t value) { return value / kRangeAlign * kRangeAlign; }

}  // namespace

SBuffer::SBuffer(gpu::Device& device, Programs& programs, std::unique_ptr<RasterStage> raster, const Layout& layout)
    : device_(device),
      programs_(programs),
      raster_(std::move(raster)),
      layout_(layout),
      unbound_(device, layout.buffers.size()) {
    item_count_ = raster_->item_count();
    list_count_ = uint64_t(item_count_) * shared::kTileTexels;
    if (list_count_ + 1 > device.limits().most_elements(4)) {
        throw Error(ErrorKind::out_of_memory,
                    std::to_string(list_count_) + " lists in a light's view are more than the device can bind", "S-buffer",
                    "use a smaller --shadow-res");
    }
    portions_ = raster_->portions();
    if (portions_.empty()) portions_.push_back({0, item_count_});
    uint64_t blocks = groups_of(item_count_, shared::kCountBlock);
    raster_counts_ = device.allocate("raster_counts", blocks * sizeof(glm::uvec2));
    const bool scanned = std::any_of(layout_.buffers.begin(), layout_.buffers.end(), [](const auto& b) { return b.scan; });
    const uint64_t list_elements = scanned ? scan_bytes(list_count_) / 4 : list_count_;
    for (const LayoutBuffer& description : layout_.buffers) {
        uint64_t bytes = description.per == LayoutBuffer::Per::list ? list_elements * description.element_bytes : 4;
        const bool later = description.per == LayoutBuffer::Per::range || copies_sums(description);
        memory_.push_back({description, later ? gpu::Buffer() : device.allocate("s_buffer." + description.block, bytes), {}});
    }
    count();
}

bool SBuffer::copies_sums(const LayoutBuffer& buffer) const {
    return std::any_of(layout_.buffers.begin(), layout_.buffers.end(),
                       [&](const LayoutBuffer& b) { return b.scan && b.per == buffer.per && b.block == buffer.copy_of; });
}

uint64_t SBuffer::bytes_per_range() const {
    uint64_t bytes = 0;
    for (const LayoutBuffer& b : layout_.buffers) bytes += b.per == LayoutBuffer::Per::range ? b.element_bytes : 0;
    return bytes;
}

uint64_t SBuffer::map_bytes() const {
    uint64_t bytes = range_count() * bytes_per_range() + raster_->source_bytes();
    for (const Memory& m : memory_) bytes += m.description.per == LayoutBuffer::Per::list ? m.buffer.bytes() : 0;
    return bytes;
}

std::map<std::string, uint64_t> SBuffer::counts() const {
    std::map<std::string, uint64_t> counts = raster_->counts();
    counts["ranges"] = range_count();
    counts["map_bytes"] = map_bytes();
    return counts;
}

void SBuffer::record_pass(bool fill, const Band& part) {
    gpu::Recorder& recorder = device_.recorder();
    std::vector<gpu::Binding> all = raster_->bindings();
    all.push_back({"RasterCounts", &raster_counts_});
    uint64_t first_bound = std::max<uint64_t>(range_base_, align_down(part.range_first));
    for (size_t i = 0; i < memory_.size(); ++i) {
        const Memory& m = memory_[i];
        uint64_t size = m.description.element_bytes;
        switch (m.description.per) {
            case LayoutBuffer::Per::once:
                all.push_back({m.description.block, &m.buffer});
                break;
            case LayoutBuffer::Per::list:
                if (!m.buffer) {
                    all.push_back(unbound_.at(i, m.description.block));
                    break;
                }
                all.push_back({m.description.block,
                               m.counts ? &m.counts : &m.buffer,
                               {},
                               uint64_t(part.item_first) * shared::kTileTexels * size,
                               uint64_t(part.item_count) * shared::kTileTexels * size});
                break;
            case LayoutBuffer::Per::range:
                if (!m.buffer) {
                    all.push_back(unbound_.at(i, m.description.block));
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
    uint64_t groups = groups_of(part.item_count, raster_->items_per_group());
    for (uint32_t i = 0; i < raster_->part_count(); ++i) {
        recorder.dispatch(
            raster_->timing(fill), raster_->program(fill), all,
            shared::RasterParams{raster_->grid(), part.item_count, part.item_first, i * shared::kListChunk,
                                 static_cast<uint32_t>(first_bound), raster_->fragment_base(), raster_->entry_first()},
            groups);
    }
}

size_t SBuffer::portion_of(uint32_t item) const {
    size_t i = portions_.size() - 1;
    while (portions_[i].item_first > item) --i;
    return i;
}

void SBuffer::prepare(uint32_t item) {
    const size_t portion = portion_of(item);
    if (portion == prepared_) return;
    raster_->prepare(portions_[portion]);
    prepared_ = portion;
}

// What was counted becomes the memory of a copy of its sums, where the layout has one.
std::vector<SBuffer::Memory>::iterator SBuffer::copy_of(const Memory& sums) {
    return std::find_if(memory_.begin(), memory_.end(), [&](const Memory& other) {
        return !other.buffer && other.description.copy_of == sums.description.block;
    });
}

void SBuffer::count() {
    gpu::Recorder& recorder = device_.recorder();
    recorder.fill(raster_->timing(false), raster_counts_, 0);
    for (Memory& m : memory_) {
        if (!m.description.scan) continue;
        const auto copy = copy_of(m);
        m.counts =
            device_.allocate("s_buffer." + (copy == memory_.end() ? "counts" : copy->description.block), m.buffer.bytes());
        recorder.fill(raster_->timing(false), m.counts, 0);
    }
    // Lists are bound in parts that one binding can hold.
    uint64_t widest = 4;
    for (const LayoutBuffer& b : layout_.buffers)
        widest = std::max<uint64_t>(widest, b.per == LayoutBuffer::Per::list ? b.element_bytes : 4);
    uint64_t most_items =
        device_.limits().max_storage_range / (widest * shared::kTileTexels) / shared::kCountBlock * shared::kCountBlock;
    for (const Band& portion : portions_) {
        prepare(portion.item_first);
        for (uint64_t first = 0; first < portion.item_count; first += most_items) {
            const uint64_t items = std::min<uint64_t>(most_items, portion.item_count - first);
            record_pass(false, {static_cast<uint32_t>(portion.item_first + first), static_cast<uint32_t>(items), 0, 0});
        }
    }
    for (Memory& m : memory_) {
        if (!m.counts) continue;
        record_scan(device_, programs_, m.counts, static_cast<uint32_t>(list_count_), m.buffer);
        const auto copy = copy_of(m);
        if (copy != memory_.end()) copy->buffer = std::move(m.counts);
        m.counts = gpu::Buffer();
    }
    const uint64_t blocks = groups_of(item_count_, shared::kCountBlock);
    totals_ = recorder.download(raster_counts_, 0, blocks * sizeof(glm::uvec2));
}

const SBuffer::Counted& SBuffer::counted() const {
    if (counted_) return *counted_;
    Counted counted;
    for (const glm::uvec2& total : gpu::values_of<glm::uvec2>(device_, totals_)) {
        counted.block_ranges.push_back(uint64_t(total.y) << 32 | total.x);
        counted.range_count += counted.block_ranges.back();
    }
    if (counted.range_count >= 0xffffffffull) {
        throw Error(ErrorKind::out_of_memory, std::to_string(counted.range_count) + " ranges in a light's view", "S-buffer",
                    "use a smaller --shadow-res");
    }
    counted_ = std::move(counted);
    return *counted_;
}

std::vector<Band> SBuffer::bands(uint64_t bytes) const {
    // What the device can read through one texel buffer bounds a band too.
    uint64_t most = std::min(bytes / std::max<uint64_t>(1, bytes_per_range()), device_.limits().most_elements(16));
    most = most > 2 * kRangeAlign ? most - 2 * kRangeAlign : 1;
    const std::vector<uint64_t>& block_ranges = counted().block_ranges;
    const uint64_t longest = block_ranges.empty() ? 0 : *std::max_element(block_ranges.begin(), block_ranges.end());
    if (longest > most) {
        throw BandTooLarge("the ranges of one block of tiles", "S-buffer", (longest + 2 * kRangeAlign) * bytes_per_range(),
                           bytes, "a larger --shadow-res");
    }
    std::vector<Band> result(1);
    for (size_t i = 0; i < block_ranges.size(); ++i) {
        Band* band = &result.back();
        if (band->range_count + block_ranges[i] > most) {
            result.push_back({band->item_first + band->item_count, 0, band->range_first + band->range_count, 0});
            band = &result.back();
        }
        band->item_count +=
            std::min<uint32_t>(shared::kCountBlock, item_count_ - static_cast<uint32_t>(i) * shared::kCountBlock);
        band->range_count += block_ranges[i];
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
        uint64_t ranges = counted().block_ranges[item / shared::kCountBlock];
        uint32_t items = std::min(shared::kCountBlock, end - item);
        Band* part = &result.back();
        if (ranges > most_ranges) {
            throw Error(ErrorKind::out_of_memory,
                        std::to_string(ranges) + " ranges in one block of tiles are more than the device can bind", "S-buffer",
                        "use a larger --shadow-res");
        }
        if (part->range_count + ranges > most_ranges || part->item_count + items > most_items ||
            (part->item_count > 0 && portion_of(part->item_first) != portion_of(item))) {
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
        // Kept for smaller bands: what it takes at most is then known when all were filled once.
        const uint64_t bytes = std::max<uint64_t>(1, held) * m.description.element_bytes;
        if (m.description.per != LayoutBuffer::Per::range || m.buffer.bytes() >= bytes) continue;
        m.buffer = gpu::Buffer();
        m.buffer = device_.allocate("s_buffer." + m.description.block, bytes);
    }
    gpu::Recorder& recorder = device_.recorder();
    for (Memory& m : memory_) {
        const LayoutBuffer& d = m.description;
        if (!d.copy_of.empty()) {
            auto source = std::find_if(memory_.begin(), memory_.end(),
                                       [&](const Memory& other) { return other.description.block == d.copy_of; });
            if (source != memory_.end() && !m.buffer)  // A second copy.
                m.buffer = device_.allocate("s_buffer." + d.block, source->buffer.bytes());
            if (source == memory_.end() || source->buffer.bytes() != m.buffer.bytes()) {
                throw Error(ErrorKind::input, "'copy_of' names no buffer of the same size: " + d.copy_of,
                            layout_.name + "/layout.json", "name one of its blocks");
            }
            recorder.copy(raster_->timing(true), source->buffer, 0, m.buffer, 0, m.buffer.bytes());
        }
        if (d.clear == LayoutBuffer::Clear::value) recorder.fill(raster_->timing(true), m.buffer, d.clear_value);
    }
    for (const Band& part : parts(band)) {
        prepare(part.item_first);
        for (const Memory& m : memory_) {
            if (m.description.clear == LayoutBuffer::Clear::range_first)
                recorder.fill(raster_->timing(true), m.buffer, static_cast<uint32_t>(part.range_first));
        }
        record_pass(true, part);
    }
}

std::vector<gpu::Binding> SBuffer::read_bindings() const {
    std::vector<gpu::Binding> result;
    for (const Memory& m : memory_) {
        if (!m.description.texel.empty()) result.push_back({m.description.texel, &m.buffer, m.description.format});
    }
    return result;
}

}  // namespace gnomon
