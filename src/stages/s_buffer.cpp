// SPDX-License-Identifier: Apache-2.0
#include "stages/s_buffer.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "layouts/interface.hpp"
#include "stages/scan.hpp"

namespace gnomon {
namespace {

using gpu::Texel;
using shared::kCountBlock;
using shared::kTileTexels;

// Places in memory are bound from a multiple of this on, which keeps every binding aligned whatever the size of its elements.
constexpr uint64_t kPlaceAlign = 256;
constexpr const char* kScan = "sbuffer/scan";
constexpr uint32_t kCounters = shared::kMostSizes + 1;

uint64_t align_down(uint64_t value) { return value / kPlaceAlign * kPlaceAlign; }

}  // namespace

SBuffer::SBuffer(gpu::Device& device, Programs& programs, std::unique_ptr<RasterStage> raster, const Layout& layout,
                 LayoutWatch* watch)
    : device_(device),
      programs_(programs),
      raster_(std::move(raster)),
      layout_(layout),
      unbound_(device, layout.buffers.size() + 3),
      watch_(watch) {
    item_count_ = raster_->item_count();
    list_count_ = uint64_t(item_count_) * kTileTexels;
    if (list_count_ + 1 > device.limits().most_elements(4)) {
        throw Error(ErrorKind::out_of_memory,
                    std::to_string(list_count_) + " lists in a light's view are more than the device can bind", "S-buffer",
                    "use a smaller --shadow-res");
    }
    portions_ = raster_->portions();
    if (portions_.empty()) portions_.push_back({0, item_count_});
    for (const LayoutBuffer& buffer : layout_.buffers) {
        if (layout_.has(buffer)) memory_.push_back({buffer, written_name(buffer), {}});
    }
    const Totals all{{}, item_count_};
    for (size_t i = 0; i < layout_.sizes.size(); ++i) {
        const LayoutSize& size = layout_.sizes[i];
        if (!knows_each(size)) continue;
        sizes_.push_back(
            {i, read_name(size), device.allocate("s_buffer.each_of_" + size.name, scan_bytes(values_of_size(size, all))), {}});
    }
    if (layout_.counts_up()) counters_ = device.allocate("s_buffer.counters", kCounters * 4);
    count();
}

uint64_t SBuffer::held_bytes(const Totals& band) const {
    uint64_t bytes = 0;
    for (const Memory& m : memory_) bytes += bytes_of(layout_, m.description, band);
    for (const Sizes& s : sizes_) bytes += scan_bytes(values_of_size(layout_.sizes[s.index], band));
    return bytes;
}

// Besides, while it is filled.
uint64_t SBuffer::work_bytes(const Totals& band) const {
    uint64_t bytes = raster_->part_count() > 1 ? band.lists() * 4 : 0;
    for (const Sizes& s : sizes_) {
        const LayoutSize& size = layout_.sizes[s.index];
        const uint64_t count = values_of_size(size, band);
        if (size.as == LayoutSize::As::offsets) bytes += scan_work_bytes(count);
        if (size.per == LayoutSize::Per::tile) bytes += scan_bytes(count);
    }
    return bytes;
}

// What is read is bound as a whole; what is not written in parts is so too.
bool SBuffer::can_be_bound(const Totals& band) const {
    const gpu::Limits& limits = device_.limits();
    return std::all_of(memory_.begin(), memory_.end(), [&](const Memory& m) {
        const uint64_t count = elements_of(layout_, m.description, band), bytes = m.description.element_bytes;
        const bool whole = is_whole(m.description);
        return count <= limits.most_elements(bytes) && count < 0xffffffffull &&
               (!whole || count <= limits.max_storage_range / bytes);
    });
}

uint64_t SBuffer::map_bytes() const {
    uint64_t bytes = held_bytes(counted().back()) + raster_->source_bytes();
    for (const Sizes& s : sizes_) bytes += s.values.bytes();
    return bytes;
}

std::map<std::string, uint64_t> SBuffer::counts() const {
    std::map<std::string, uint64_t> counts = raster_->counts();
    counts["ranges"] = range_count();
    counts["lists"] = list_count();
    counts["map_bytes"] = map_bytes();
    return counts;
}

shared::RasterParams SBuffer::params(const Band& part) const {
    shared::RasterParams params{.grid = raster_->grid(),
                                .item_count = part.item_count,
                                .item_first = part.item_first,
                                .list_first = 0,
                                .last = 1,
                                .band_first = band_.item_first,
                                .place_first = {},
                                .entry_first = raster_->entry_first(),
                                .fragment_item = raster_->fragment_item()};
    const Totals bound = bound_before(part);
    for (size_t i = 0; i < bound.sizes.size(); ++i) params.place_first[i] = static_cast<uint32_t>(bound.sizes[i]);
    return params;
}

// What of the band lies before the first place that is bound for a part.
Totals SBuffer::bound_before(const Band& part) const {
    if (band_.item_count == 0) return {};
    Totals before = totals_of(band_.item_first, part.item_first - band_.item_first);
    for (uint64_t& size : before.sizes) size = align_down(size);
    return before;
}

std::vector<gpu::Binding> SBuffer::write_bindings(const Band* part) const {
    std::vector<gpu::Binding> all;
    if (counters_) all.push_back({"LayoutCounters", &counters_});
    if (watch_ != nullptr) {
        for (const gpu::Binding& binding : watch_->write_bindings())
            all.push_back(part != nullptr ? binding : unbound_.at(memory_.size() + 2, binding.name));
    }
    for (const Sizes& s : sizes_)
        all.push_back(part != nullptr ? gpu::Binding{s.read, &s.band, Texel::r32_uint}
                                      : unbound_.at(memory_.size(), s.read, Texel::r32_uint));
    for (size_t i = 0; i < memory_.size(); ++i) {
        const Memory& m = memory_[i];
        const LayoutBuffer& d = m.description;
        if (part == nullptr) {
            all.push_back(unbound_.at(i, m.written));
            continue;
        }
        const bool whole = is_whole(d);
        const uint64_t first = whole ? 0 : elements_of(layout_, d, bound_before(*part));
        const Band until{band_.item_first, part->item_first - band_.item_first + part->item_count};
        const uint64_t end = elements_of(layout_, d, totals_of(whole ? band_ : until));
        all.push_back(
            {m.written, &m.buffer, {}, first * d.element_bytes, std::max<uint64_t>(1, end - first) * d.element_bytes});
    }
    return all;
}

void SBuffer::record_pass(bool fill, const Band& part, const gpu::Binding& list_state) {
    gpu::Recorder& recorder = device_.recorder();
    std::vector<gpu::Binding> all = raster_->bindings();
    for (const gpu::Binding& binding : write_bindings(fill ? &part : nullptr)) all.push_back(binding);
    if (raster_->keeps_list_state()) all.push_back(list_state);
    all.push_back({"RasterCounts", &range_totals_});
    shared::RasterParams params = this->params(part);
    for (uint32_t i = 0; i < raster_->part_count(); ++i) {
        params.list_first = i * shared::kListChunk;
        params.last = i + 1 == raster_->part_count() ? 1 : 0;
        recorder.dispatch(raster_->timing(fill), raster_->program(fill), all, params,
                          groups_of(part.item_count, raster_->items_per_group()));
    }
}

size_t SBuffer::portion_of(uint32_t item) const {
    size_t i = portions_.size() - 1;
    while (portions_[i].item_first > item) --i;
    return i;
}

void SBuffer::make_source(uint32_t item) {
    const size_t portion = portion_of(item);
    if (portion == prepared_) return;
    raster_->prepare(portions_[portion]);
    prepared_ = portion;
}

void SBuffer::count() {
    gpu::Recorder& recorder = device_.recorder();
    const uint64_t blocks = groups_of(item_count_, kCountBlock);
    range_totals_ = device_.allocate("raster_counts", blocks * sizeof(glm::uvec2));
    recorder.fill(raster_->timing(false), range_totals_, 0);
    for (const Sizes& s : sizes_) recorder.fill(raster_->timing(false), s.values, 0);
    // The counts of lists are a size of their own, or serve to compute others.
    const bool own = !sizes_.empty() && sizes_[0].index == 0;
    const bool kept = layout_.keeps_counts();
    const gpu::Buffer other = kept && !own ? device_.allocate("s_buffer.counts", scan_bytes(list_count_)) : gpu::Buffer();
    const gpu::Buffer& counts = own ? sizes_[0].values : other;
    if (other) recorder.fill(raster_->timing(false), other, 0);
    // Lists are bound in parts that one binding can hold.
    const uint64_t most_items = device_.limits().max_storage_range / (4 * kTileTexels) / kCountBlock * kCountBlock;
    for (const Band& portion : portions_) {
        make_source(portion.item_first);
        for (uint64_t first = 0; first < portion.item_count; first += most_items) {
            const auto items = static_cast<uint32_t>(std::min<uint64_t>(most_items, portion.item_count - first));
            const Band part{static_cast<uint32_t>(portion.item_first + first), items};
            const uint64_t offset = uint64_t(part.item_first) * kTileTexels * 4, bytes = uint64_t(items) * kTileTexels * 4;
            record_pass(
                false, part,
                kept ? gpu::Binding{"ListState", &counts, {}, offset, bytes} : unbound_.at(memory_.size() + 1, "ListState"));
        }
    }
    totals_.push_back(recorder.download(range_totals_, 0, blocks * sizeof(glm::uvec2)));
    if (layout_.sizes.size() > 1) record_sizes(counts, most_items);
}

// The sizes that the layout computes.
void SBuffer::record_sizes(const gpu::Buffer& counts, uint64_t most_items) {
    gpu::Recorder& recorder = device_.recorder();
    const uint64_t blocks = groups_of(item_count_, kCountBlock);
    for (size_t i = 1; i < layout_.sizes.size(); ++i) {
        const LayoutSize& size = layout_.sizes[i];
        const bool tiles = size.per == LayoutSize::Per::tile;
        const auto known = std::find_if(sizes_.begin(), sizes_.end(), [&](const Sizes& s) { return s.index == i; });
        const Totals all{{}, item_count_};
        const gpu::Buffer unkept = known == sizes_.end()
                                       ? device_.allocate("s_buffer.each_of_" + size.name, values_of_size(size, all) * 4)
                                       : gpu::Buffer();
        const gpu::Buffer totals = device_.allocate("size_totals", blocks * sizeof(glm::uvec2));
        recorder.fill("sbuffer/size", totals, 0);
        if (size.listed) {
            record_triangles(known == sizes_.end() ? unkept : known->values, totals);
            totals_.push_back(recorder.download(totals, 0, blocks * sizeof(glm::uvec2)));
            continue;
        }
        for (uint64_t first = 0; first < item_count_; first += most_items) {
            const uint64_t items = std::min<uint64_t>(most_items, item_count_ - first), lists = items * kTileTexels;
            const uint64_t each = tiles ? 4 : 4 * kTileTexels;
            recorder.dispatch(
                "sbuffer/size", programs_.get(layout_.stage("sbuffer/size"), {static_cast<uint32_t>(i), tiles}),
                bindings({{"counts", &counts, Texel::r32_uint},
                          {"Sizes", known == sizes_.end() ? &unkept : &known->values, {}, first * each, items * each},
                          {"SizeTotals", &totals}}),
                shared::SizeParams{static_cast<uint32_t>(first * kTileTexels), static_cast<uint32_t>(lists)},
                groups_of(tiles ? items : lists, 64));
        }
        totals_.push_back(recorder.download(totals, 0, blocks * sizeof(glm::uvec2)));
    }
}

// Those of each tile's list.
void SBuffer::record_triangles(const gpu::Buffer& sizes, const gpu::Buffer& totals) {
    std::vector<gpu::Binding> all = bindings({{"Sizes", &sizes}, {"SizeTotals", &totals}});
    for (const gpu::Binding& binding : raster_->bindings()) {
        if (binding.name != "triangles" && binding.name != "raster_vertices") all.push_back(binding);
    }
    device_.recorder().dispatch("sbuffer/size", programs_.get("sbuffer/triangles", {raster_->asked()}), all,
                                params({0, item_count_}), groups_of(item_count_, 64));
}

const SBuffer::Counted& SBuffer::counted() const {
    if (counted_) return *counted_;
    const uint64_t blocks = groups_of(item_count_, kCountBlock);
    Counted counted(blocks + 1);
    for (size_t i = 0; i < totals_.size(); ++i) {
        const std::vector<glm::uvec2> totals = gpu::values_of<glm::uvec2>(device_, totals_[i]);
        for (size_t block = 0; block < blocks; ++block)
            counted[block + 1].sizes[i] = counted[block].sizes[i] + (uint64_t(totals[block].y) << 32 | totals[block].x);
    }
    for (size_t block = 1; block <= blocks; ++block)
        counted[block].tiles = std::min<uint64_t>(item_count_, block * kCountBlock);
    if (counted.back().sizes[0] >= 0xffffffffull) {
        throw Error(ErrorKind::out_of_memory, std::to_string(counted.back().sizes[0]) + " ranges in a light's view", "S-buffer",
                    "use a smaller --shadow-res");
    }
    counted_ = std::move(counted);
    return *counted_;
}

// Of whole blocks, but for the last.
Totals SBuffer::totals_of(uint32_t item_first, uint32_t item_count) const {
    const Counted& counted = this->counted();
    return counted[groups_of(item_first + uint64_t(item_count), kCountBlock)] - counted[item_first / kCountBlock];
}

std::vector<Band> SBuffer::bands(uint64_t bytes) const {
    const Counted& counted = this->counted();
    const auto fits = [&](const Totals& band) { return held_bytes(band) + work_bytes(band) <= bytes && can_be_bound(band); };
    const auto too_large = [&](const std::string& what, const Totals& totals) {
        return BandTooLarge(what, "S-buffer", held_bytes(totals) + work_bytes(totals), bytes, "a larger --shadow-res");
    };
    if (fits(counted.back())) return {{0, item_count_, 0, range_count()}};
    if (!layout_.bands)
        throw too_large("the ranges of a light's view, whose layout '" + layout_.name + "' has no bands,", counted.back());
    std::vector<Band> result;
    uint64_t needed = 0;
    Totals largest;
    for (size_t first = 0, end = 0; first + 1 < counted.size(); first = end) {
        ++end;
        const Totals block = counted[end] - counted[first];
        if (!fits(block) && held_bytes(block) > needed) {
            needed = held_bytes(block);
            largest = block;
        }
        while (end + 1 < counted.size() && fits(counted[end + 1] - counted[first])) ++end;
        const Totals held = counted[end] - counted[first];
        result.push_back({static_cast<uint32_t>(counted[first].tiles), static_cast<uint32_t>(held.tiles),
                          counted[first].sizes[0], held.sizes[0]});
    }
    if (needed > 0) throw too_large("the ranges of one block of tiles", largest);
    return result;
}

std::vector<Band> SBuffer::parts() const {
    const uint64_t most = device_.limits().max_storage_range;
    const auto fits = [&](const Totals& part) {
        return part.lists() * 4 <= most && std::all_of(memory_.begin(), memory_.end(), [&](const Memory& m) {
                   const LayoutBuffer& d = m.description;
                   return is_whole(d) || (elements_of(layout_, d, part) + kPlaceAlign * d.elements) * d.element_bytes <= most;
               });
    };
    std::vector<Band> result;
    const uint32_t end = band_.item_first + band_.item_count;
    for (uint32_t item = band_.item_first; item < end; item += kCountBlock) {
        const uint32_t items = std::min(kCountBlock, end - item);
        if (!fits(totals_of(item, items))) {
            throw Error(ErrorKind::out_of_memory,
                        std::to_string(totals_of(item, items).sizes[0]) +
                            " ranges in one block of tiles are more than the device can bind",
                        "S-buffer", "use a larger --shadow-res");
        }
        const bool begins = result.empty() || portion_of(result.back().item_first) != portion_of(item) ||
                            !fits(totals_of(result.back().item_first, item + items - result.back().item_first));
        if (begins) result.push_back({item, 0});
        result.back().item_count += items;
    }
    return result;
}

// Memory for a band. Kept for later ones that need no more of anything: what it takes at most is then known when all were
// filled once.
void SBuffer::hold(const Totals& held) {
    struct Need {
        gpu::Buffer* buffer;
        std::string name;
        uint64_t bytes;
    };
    std::vector<Need> needs;
    for (Sizes& s : sizes_) needs.push_back({&s.band, s.read, scan_bytes(values_of_size(layout_.sizes[s.index], held))});
    for (Memory& m : memory_) needs.push_back({&m.buffer, m.description.name, bytes_of(layout_, m.description, held)});
    if (raster_->part_count() > 1) needs.push_back({&cursors_, "cursors", held.lists() * 4});
    if (std::all_of(needs.begin(), needs.end(), [](const Need& need) { return need.buffer->bytes() >= need.bytes; })) return;
    for (const Need& need : needs) *need.buffer = gpu::Buffer();
    for (const Need& need : needs) *need.buffer = device_.allocate("s_buffer." + need.name, need.bytes);
}

// What of each size is read while the band is in memory.
void SBuffer::record_sums(const Totals& held) {
    gpu::Recorder& recorder = device_.recorder();
    for (const Sizes& s : sizes_) {
        const LayoutSize& size = layout_.sizes[s.index];
        const uint64_t count = values_of_size(size, held), first = values_of_size(size, {{}, band_.item_first});
        if (size.as == LayoutSize::As::values) {
            recorder.copy(kScan, s.values, first * 4, s.band, 0, count * 4);
        } else if (size.per == LayoutSize::Per::list || band_.item_count == item_count_) {
            record_scan(device_, programs_, s.values, static_cast<uint32_t>(count), s.band, first, kScan);
        } else {
            const gpu::Buffer own = device_.allocate("s_buffer.scanned", scan_bytes(count));
            recorder.fill(kScan, own, 0);
            recorder.copy(kScan, s.values, first * 4, own, 0, count * 4);
            record_scan(device_, programs_, own, static_cast<uint32_t>(count), s.band, 0, kScan);
        }
    }
}

// Places of a part lie behind those of the parts before.
void SBuffer::begin_counters(const Band& part) {
    const Totals before = totals_of(band_.item_first, part.item_first - band_.item_first);
    for (size_t i = 0; i < layout_.sizes.size(); ++i) {
        if (layout_.sizes[i].as == LayoutSize::As::allocated)
            device_.recorder().fill("sbuffer/clear", counters_, static_cast<uint32_t>(before.sizes[i]), i * 4, 4);
    }
}

void SBuffer::record_lists(const std::string& stage, Layout::Pass pass, const std::vector<Band>& parts) {
    if (pass == Layout::Pass::none) return;
    const gpu::Program& program = programs_.get(layout_.stage(stage + (layout_.exit_depth ? "_exits" : "")));
    for (const Band& part : parts) {
        const uint64_t invocations = uint64_t(part.item_count) * (pass == Layout::Pass::tile ? 1 : kTileTexels);
        device_.recorder().dispatch(stage, program, write_bindings(&part), params(part), groups_of(invocations, 64));
    }
}

void SBuffer::begin_watch(const Totals& held) {
    if (watch_ == nullptr) return;
    std::vector<uint64_t> counts;
    for (const LayoutBuffer& buffer : layout_.buffers)
        counts.push_back(layout_.has(buffer) && buffer.has_atomics() ? elements_of(layout_, buffer, held) : 0);
    counts.insert(counts.end(), layout_.sizes.size() + layout_.counters.size(), 1);
    watch_->begin_fill(std::move(counts));
}

void SBuffer::end_watch(const Totals& held) {
    if (watch_ == nullptr) return;
    watch_->end_fill();
    for (const Memory& m : memory_)
        watch_->count_words(m.buffer, bytes_of(layout_, m.description, held), m.description.initial.value_or(kPoison));
}

void SBuffer::fill(const Band& band) {
    band_ = band;
    const Totals held = totals_of(band);
    hold(held);
    record_sums(held);
    for (const Memory& m : memory_) {
        const std::optional<uint32_t>& initial = m.description.initial;
        if (initial || watch_ != nullptr) device_.recorder().fill("sbuffer/clear", m.buffer, initial.value_or(kPoison));
    }
    if (counters_) device_.recorder().fill("sbuffer/clear", counters_, 0);
    begin_watch(held);
    const std::vector<Band> parts = this->parts();
    record_lists("sbuffer/prepare", layout_.prepare, parts);
    for (const Band& part : parts) {
        make_source(part.item_first);
        begin_counters(part);
        const uint64_t first = uint64_t(part.item_first - band.item_first) * kTileTexels * 4,
                       bytes = uint64_t(part.item_count) * kTileTexels * 4;
        record_pass(
            true, part,
            cursors_ ? gpu::Binding{"ListState", &cursors_, {}, first, bytes} : unbound_.at(memory_.size() + 1, "ListState"));
    }
    record_lists("sbuffer/finish", layout_.finish, parts);
    end_watch(held);
    if (!layout_.counters.empty()) lost_ = device_.recorder().download(counters_, shared::kMostSizes * 4, 4);
}

std::vector<gpu::Binding> SBuffer::read_bindings() const {
    std::vector<gpu::Binding> result;
    if (watch_ != nullptr) result = watch_->read_bindings();
    const Totals held = totals_of(band_);
    for (const Sizes& s : sizes_) result.push_back({s.read, &s.band, Texel::r32_uint});
    for (const Memory& m : memory_) {
        const LayoutBuffer& d = m.description;
        result.push_back({d.name, &m.buffer, d.format, 0, bytes_of(layout_, d, held)});
    }
    return result;
}

}  // namespace gnomon
