// SPDX-License-Identifier: Apache-2.0
#include "methods/fssm.hpp"

#include <algorithm>
#include <bit>
#include <gnomon/error.hpp>

#include "math/fssm.h"
#include "math/sample.h"
#include "stages/grid.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

constexpr uint64_t kTupleBytes = 16, kSampleBytes = 16, kLayerHeadBytes = 16;
// Tuples from one place to the next at which any device can bind them: 256 bytes.
constexpr uint32_t kTupleAlign = 16;
// Strata that one dispatch adds to the grids: an invocation of methods/fssm/reproject goes round once for each of the window's
// samples, at most 256 a stratum, and lavapipe ends its loops after 65,535 iterations.
constexpr uint32_t kStrataAtOnce = 128;

// The paper names a bias and gives no value. The variance takes what tsm's larger bias is for, slopes within a texel; without
// any the rounding of depths shows.
constexpr double kBiasTexels = 0.25;

bool given(const LightContext& light, const std::string& name) { return light.parameter(name).value_or(1) != 0; }

Fssm::Sizes sizes_of(const LightContext& light) {
    const double tile = light.parameter("tile").value_or(8);
    if (tile != 4 && tile != 8) {
        throw Error(ErrorKind::usage, "tile is " + std::to_string(static_cast<int>(tile)), "--tile", "use 4 or 8 texels");
    }
    return tile == 8 ? Fssm::Sizes{8, 16, 16} : Fssm::Sizes{4, 12, 8};
}

uint32_t tuples_of(uint32_t size, uint32_t levels) {
    uint32_t count = 0;
    for (uint32_t level = 0; level < levels; ++level) count += (size >> level) * (size >> level);
    return count;
}

// As methods/fssm/shadow reads them.
std::vector<glm::vec4> view_keys(const View& camera, const View& light) {
    std::vector<glm::vec4> keys;
    for (size_t k = 0; k < light.keys.size(); ++k) {
        const ViewKey &c = camera.keys[k], &l = light.keys[k];
        keys.insert(keys.end(), {c.row_x, c.row_y, camera.orthographic ? c.row_z : c.row_w, glm::vec4(c.origin, 0.0f), l.row_x,
                                 l.row_y, l.row_w, glm::vec4(l.origin, 0.0f)});
    }
    return keys;
}

bool all_same(const View& view) {
    const ViewKey& first = view.keys.front();
    return std::all_of(view.keys.begin(), view.keys.end(), [&](const ViewKey& k) {
        return k.row_x == first.row_x && k.row_y == first.row_y && k.row_z == first.row_z && k.row_w == first.row_w &&
               k.origin == first.origin;
    });
}

}  // namespace

std::vector<Parameter> fssm_parameters() {
    std::vector<Parameter> all = depth_map_parameters(DepthMapKind::stochastic);
    all.back().initial = "a quarter of a texel's width, a spot's at the hit's depth";
    const auto add = [&](const std::string& name, const std::string& unit, const std::string& summary,
                         const std::string& initial, double least, double most) {
        all.push_back({name, unit, summary, initial, least, most, true});
    };
    add("layers", "layers", "Most layers of depth in a tile", "4", 1, shared::kMostLayers);
    add("tile", "texels", "Side of a tile: 8 (window 16, grid 16) or 4 (12, 8)", "8", 4, 8);
    add("footprint", "switch", "Filter along the hit's way during a camera sample's share of the shutter", "1", 0, 1);
    add("widen", "switch", "Widen the filter where it meets no sample", "1", 0, 1);
    add("tent", "switch", "Filter across the motion of fast layers", "1", 0, 1);
    add("neighbours", "switch", "Near a tile's border look some hits up in the neighbour", "1", 0, 1);
    return all;
}

Fssm::Fssm(const LightContext& light, const Bins& bins)
    : light_(light),
      bins_(bins),
      sampling_(map_sampling(light, DepthMapKind::stochastic)),
      bias_(map_bias(light, kBiasTexels)),
      sizes_(sizes_of(light)),
      layer_count_(static_cast<uint32_t>(light.parameter("layers").value_or(shared::kMostLayers))),
      level_count_(given(light, "widen") ? static_cast<uint32_t>(std::bit_width(sizes_.grid)) : 1),
      tuple_count_(tuples_of(sizes_.grid, level_count_)),
      tiles_x_(static_cast<uint32_t>(groups_of(bins.grid.width, sizes_.tile))),
      tiles_y_(static_cast<uint32_t>(groups_of(bins.grid.height, sizes_.tile))),
      rows_(bins.window.tile_count / bins.grid.tiles_x),
      views_move_(!all_same(light.view) || !all_same(*light.camera)),
      views_(gpu::upload_new(light.device, "fssm.views", view_keys(*light.camera, light.view))) {}

std::map<std::string, uint64_t> Fssm::counts() const {
    const uint64_t tiles = uint64_t(tiles_x_) * tiles_y_;
    return {{"map_samples", uint64_t(item_count()) * shared::kTileTexels * sampling_.spp},
            {"map_bytes", tiles * layer_count_ * layer_bytes()},
            {"layer_bytes", tiles * layer_bytes()}};
}

std::map<std::string, std::string> Fssm::effective() const {
    std::map<std::string, std::string> all = map_effective(light_, sampling_, bias_);
    all["layers"] = std::to_string(layer_count_);
    all["tile"] = std::to_string(sizes_.tile);
    for (const char* name : {"footprint", "widen", "tent", "neighbours"}) all[name] = given(light_, name) ? "1" : "0";
    return all;
}

uint64_t Fssm::layer_bytes() const { return tuple_count_ * kTupleBytes + kLayerHeadBytes; }

uint64_t Fssm::row_bytes() const { return tiles_x_ * layer_count_ * layer_bytes(); }

uint64_t Fssm::window_texels(uint32_t row_count) const {
    const shared::ViewGrid& grid = bins_.grid;
    const uint64_t high = uint64_t(row_count) * sizes_.tile + sizes_.window - sizes_.tile;
    const uint64_t rows = std::min<uint64_t>(rows_, groups_of(high, shared::kTileSize) + 1);
    return rows * grid.tiles_x * shared::kTileTexels;
}

uint32_t Fssm::rows_at_once(uint32_t row_count) const {
    const gpu::Limits& limits = light_.device.limits();
    const auto fits = [&](uint32_t rows) {
        const uint64_t texels = window_texels(rows), samples = texels * sampling_.spp;
        return samples * kSampleBytes <= row_count * row_bytes() && samples <= limits.most_elements(16) &&
               texels * kSampleBytes <= limits.max_storage_range && (rows + 1) * row_bytes() <= limits.max_storage_range;
    };
    uint32_t rows = row_count;
    while (rows > 1 && !fits(rows)) --rows;
    return rows;
}

Fssm::Rows Fssm::rows_of(uint32_t first, uint32_t count) const {
    const uint32_t per_row = shared::kTileSize / sizes_.tile;
    const uint32_t from = first * per_row, to = std::min((first + count) * per_row, tiles_y_);
    const uint32_t low = from == 0 ? 0 : from - 1, high = std::min(to + 1, tiles_y_);
    return {low, high - low};
}

std::vector<Band> Fssm::bands(uint64_t bytes) const {
    const gpu::Limits& limits = light_.device.limits();
    const shared::ViewGrid& grid = bins_.grid;
    // Of rows in the middle of the map, which have neighbours on both sides.
    const auto in_memory = [&](uint32_t count) { return std::min(tiles_y_, count * (shared::kTileSize / sizes_.tile) + 2); };
    const auto needed = [&](uint32_t count) {
        const uint32_t rows = in_memory(count);
        return rows * row_bytes() + window_texels(rows_at_once(rows)) * (sampling_.spp * kSampleBytes + sizeof(uint32_t));
    };
    const auto fits = [&](uint32_t count) {
        const uint64_t tuples = uint64_t(in_memory(count)) * tiles_x_ * layer_count_ * tuple_count_;
        const uint64_t samples = window_texels(rows_at_once(in_memory(count))) * sampling_.spp;
        const uint64_t texels = std::max(tuples, samples);
        return needed(count) <= bytes && texels <= limits.most_elements(16) && texels * kTupleBytes <= limits.max_buffer_bytes;
    };
    uint32_t most = rows_;
    while (most > 0 && !fits(most)) --most;
    if (most == 0) {
        throw BandTooLarge("the layers and samples of one row of a light's map", "shadow map", needed(1), bytes,
                           "a smaller --shadow-res or fewer --layers");
    }
    std::vector<Band> result;
    for (uint32_t first = 0; first < rows_; first += most) {
        const uint32_t count = std::min(most, rows_ - first);
        const Rows rows = rows_of(first, count);
        result.push_back({first * grid.tiles_x, count * grid.tiles_x, uint64_t(rows.first) * tiles_x_,
                          uint64_t(rows.count) * tiles_x_, 0.0, 1.0});
    }
    return result;
}

void Fssm::fill(const Band& band) {
    gpu::Device& device = light_.device;
    base_ = static_cast<uint32_t>(band.range_first);
    layers_ = gpu::Buffer();
    tuples_ = gpu::Buffer();
    const Rows rows = {base_ / tiles_x_, static_cast<uint32_t>(band.range_count) / tiles_x_};
    const uint32_t most = rows_at_once(rows.count);
    layers_ = device.allocate("fssm.layers", band.range_count * layer_count_ * kLayerHeadBytes);
    level_first_ = {0};
    const auto layers = static_cast<uint32_t>(band.range_count) * layer_count_;
    for (uint32_t level = 1; level < level_count_; ++level)
        level_first_.push_back(shared::next_level(level_first_.back(), layers, sizes_.grid >> (level - 1)));
    const uint32_t last_size = sizes_.grid >> (level_count_ - 1);
    tuples_ = device.allocate("fssm.tuples", (level_first_.back() + uint64_t(layers) * last_size * last_size) * kTupleBytes);
    samples_ = device.allocate("map_samples", window_texels(most) * sampling_.spp * kSampleBytes);
    Tracer tracer(device, light_.programs, light_.geometry, light_.view, bins_, "map/trace", sampling_, window_texels(most));
    gpu::Recorder& recorder = device.recorder();
    recorder.fill("map/reproject", tuples_, 0);
    for (uint32_t row = 0; row < rows.count; row += most) {
        fill_rows(recorder, tracer, {rows.first + row, std::min(most, rows.count - row)}, rows);
    }
    samples_ = gpu::Buffer();
}

void Fssm::fill_rows(gpu::Recorder& recorder, Tracer& tracer, const Rows& rows, const Rows& band) {
    const shared::ViewGrid& grid = bins_.grid;
    Programs& programs = light_.programs;
    // The rows of 8 x 8 texels that their windows reach.
    const uint32_t margin = (sizes_.window - sizes_.tile) / 2;
    const uint32_t top = rows.first * sizes_.tile, bottom = (rows.first + rows.count) * sizes_.tile + margin;
    const uint32_t first = (top - std::min(margin, top)) / shared::kTileSize;
    const uint32_t last = std::min(static_cast<uint32_t>(groups_of(bottom, shared::kTileSize)), rows_);
    const uint32_t tile_first = first * grid.tiles_x, tile_count = (last - first) * grid.tiles_x;
    const uint32_t stride = tile_count * shared::kTileTexels;
    for (uint32_t s = 0; s < sampling_.spp; ++s) {
        record_depths(recorder, light_, bins_, tracer, sampling_, 4, {tile_first, tile_count, s, 1}, samples_,
                      uint64_t(s) * stride);
    }

    const uint32_t own_first = rows.first * tiles_x_, own_count = rows.count * tiles_x_;
    const uint32_t layer_first = (own_first - band.first * tiles_x_) * layer_count_, layers = own_count * layer_count_;
    const Tuples tuples = tuples_in(0, layer_first, layers);
    shared::FssmParams params{grid,           tiles_x_,   own_first,    own_count,     layer_first,
                              tuples.first,   tile_first, stride,       sampling_.spp, shared::stratum_length(sampling_.spp),
                              sampling_.seed, 0,          sampling_.spp};
    const std::vector<uint32_t> constants = {sizes_.tile, sizes_.window, sizes_.grid, layer_count_};
    recorder.dispatch("map/layers", programs.get("methods/fssm/layers", constants),
                      bindings({{"map_samples", &samples_, Texel::rgba32_float}, {"Layers", &layers_}}), params, own_count);
    const uint64_t stratum_bytes = stride * kSampleBytes;
    for (uint32_t s = 0; s < sampling_.spp; s += kStrataAtOnce) {
        params.stratum_first = s;
        params.stratum_count = std::min(kStrataAtOnce, sampling_.spp - s);
        recorder.dispatch(
            "map/reproject", programs.get("methods/fssm/reproject", constants),
            bindings({{"map_samples", &samples_, Texel::rgba32_float, s * stratum_bytes, params.stratum_count * stratum_bytes},
                      {"layers", &layers_, Texel::rgba32_float},
                      tuples.binding(*this, "Tuples")}),
            params, groups_of(own_count, 64));
    }
    record_mips(recorder, layer_first, layers);
}

Fssm::Tuples Fssm::tuples_in(uint32_t level, uint32_t layer_first, uint32_t layer_count) const {
    const uint32_t size = sizes_.grid >> level;
    const uint32_t begin = layer_first * size * size, bound = begin / kTupleAlign * kTupleAlign;
    return {(level_first_[level] + bound) * kTupleBytes, (begin - bound + uint64_t(layer_count) * size * size) * kTupleBytes,
            begin - bound};
}

void Fssm::record_mips(gpu::Recorder& recorder, uint32_t layer_first, uint32_t layer_count) {
    for (uint32_t level = 1; level < level_count_; ++level) {
        const Tuples read = tuples_in(level - 1, layer_first, layer_count),
                     written = tuples_in(level, layer_first, layer_count);
        const uint32_t size = sizes_.grid >> level;
        recorder.dispatch(
            "map/mips", light_.programs.get("methods/fssm/mips"),
            bindings({read.binding(*this, "tuples"), written.binding(*this, "Tuples")}),
            shared::FssmMipParams{layer_count, read.first, written.first, static_cast<uint32_t>(std::countr_zero(size))},
            groups_of(uint64_t(layer_count) * size * size, 64));
    }
}

std::vector<gpu::Binding> Fssm::read_bindings() const {
    return {{"layers", &layers_, Texel::rgba32_float},
            {"tuples", &tuples_, Texel::rgba32_float},
            {"view_keys", &views_, Texel::rgba32_float}};
}

std::vector<uint32_t> Fssm::test_constants() const {
    std::vector<uint32_t> all = bias_.constants();
    all.insert(all.end(), {sizes_.tile, sizes_.window, sizes_.grid, layer_count_, level_count_, given(light_, "footprint"),
                           given(light_, "tent"), given(light_, "neighbours"), views_move_});
    return all;
}

}  // namespace gnomon
