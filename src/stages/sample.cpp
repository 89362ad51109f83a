// SPDX-License-Identifier: Apache-2.0
#include "stages/sample.hpp"

#include <bit>
#include <cmath>

#include "math/sample.h"
#include "shared/film.h"
#include "shared/light.h"
#include "stages/grid.hpp"
#include "stages/scan.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

// Hits whose shadow counts share one set of 32-bit counters.
constexpr uint32_t kCountersHits = 65536;

uint32_t walk_parts(uint64_t longest) {
    return static_cast<uint32_t>(groups_of(std::max<uint64_t>(1, longest), shared::kListChunk));
}

std::vector<float> srgb_table() {
    std::vector<float> table(256);
    for (int i = 0; i < 256; ++i) {
        double c = i / 255.0;
        table[static_cast<size_t>(i)] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
}

}  // namespace

uint32_t lit_planes(uint32_t light_count, bool fractional) {
    return fractional ? std::max(1u, light_count) : shared::lit_words(light_count);
}

Sampler::Sampler(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Bins& bins,
                 const gpu::Buffer& lights, const SamplerSettings& settings)
    : device_(device),
      programs_(programs),
      geometry_(geometry),
      view_(view),
      bins_(bins),
      lights_(lights),
      settings_(settings),
      tracer_(device, programs, geometry, view, bins, "sample/trace",
              {settings.spp, settings.seed, false, settings.count_ranges}, settings.most_slots) {
    const uint64_t most_slots = settings.most_slots;
    const uint32_t planes = lit_planes(settings.light_count, settings.fractional);
    lit_ = device.allocate("lit", most_slots * 4 * planes);
    lit_written_.resize(planes);
    queue_ = device.allocate("queue", most_slots * 4);
    run_hits_ = device.allocate("run_hits", scan_bytes(most_slots / shared::kScanRun));
    runs_ = device.allocate("runs", scan_bytes(most_slots / shared::kScanRun));
    shadow_groups_ = device.allocate("shadow_groups", 12);
    hit_total_ = gpu::upload_new(device, "hit_total", std::vector<uint32_t>(2));
    nothing_ = device.allocate("unbound", sizeof(glm::vec4));
    depth_values_ = device.allocate("depths", settings.keep_depths ? most_slots * 4 : 4);
    shadow_counts_ = device.allocate("shadow_counts", (most_slots / kCountersHits + 1) * 12);
    srgb_to_linear_ = gpu::upload_new(device, "srgb_to_linear", srgb_table());
}

void Sampler::begin_window() {
    film_px_ = rect_of(view_, bins_.window).size_px;
    const uint64_t bytes = uint64_t(film_px_.x) * film_px_.y * shared::film_planes(settings_.light_count) * 4;
    if (film_.bytes() < bytes) {
        film_ = gpu::Buffer();
        film_ = device_.allocate("film", bytes);
    }
    gpu::Recorder& recorder = device_.recorder();
    recorder.fill("sample/shade", film_, 0);
}

void Sampler::trace(const Batch& batch) {
    batch_ = batch;
    film_hits_.reset();
    run_count_ = static_cast<uint32_t>(batch.slot_count() / shared::kScanRun);
    gpu::Recorder& recorder = device_.recorder();
    tracer_.record(recorder, batch);
    lit_written_.assign(lit_written_.size(), false);
    recorder.fill("sample/compact", run_hits_, 0);
    const shared::CompactParams params{run_count_};
    recorder.dispatch("sample/compact", programs_.get("sample/count_hits"),
                      bindings({{"hits", &tracer_.hits(), Texel::rgba32_uint}, {"Runs", &run_hits_}}), params,
                      groups_of(run_count_, 64));
    record_scan(device_, programs_, run_hits_, run_count_, runs_);
    recorder.dispatch("sample/compact", programs_.get("sample/compact"),
                      bindings({{"hits", &tracer_.hits(), Texel::rgba32_uint},
                                {"runs", &runs_, Texel::r32_uint},
                                {"Queue", &queue_},
                                {"ShadowGroups", &shadow_groups_},
                                {"HitTotal", &hit_total_}}),
                      params, groups_of(run_count_, 64));
}

void Sampler::reserve_walk(uint64_t longest) {
    const uint64_t bytes = walk_parts(longest) > 1 ? tracer_.hits().bytes() * 4 : 16;
    if (!iterators_ || iterators_.bytes() < bytes) iterators_ = device_.allocate("iterators", bytes);
}

std::vector<gpu::Binding> Sampler::shell_bindings() const {
    return {{"shells", &geometry_.scene->shells, Texel::r32_uint}, {"closed", &geometry_.closed, Texel::r32_uint}};
}

std::vector<gpu::Binding> Sampler::hit_bindings(const LightSide& light) const {
    return {{"queue", &queue_, Texel::r32_uint},
            {"runs", &runs_, Texel::r32_uint},
            {"hits", &tracer_.hits(), Texel::r32_uint},
            {"triangles", &geometry_.scene->triangles, Texel::rgba32_uint},
            {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
            {"light_vertices", &light.bins.raster_vertices, Texel::rgba32_float},
            {"positions", &geometry_.positions, Texel::rgba32_float},
            {"lights", &lights_, Texel::rgba32_float}};
}

shared::ShadowParams Sampler::shadow_params(const LightSide& light, const ItemOrder& order, const Band& band,
                                            float tolerance) const {
    return {bins_.grid,
            run_count_,
            batch_.tile_first,
            batch_.stratum_first,
            batch_.stratum_count,
            settings_.spp,
            shared::stratum_length(settings_.spp),
            settings_.seed,
            light.light_ix,
            light.view.face,
            light.view.width,
            order.cell_count,
            light.bins.window.tile_first,
            light.bins.window.tile_count,
            order.cell_major,
            shared::stratum_length(order.cell_count),
            light.view.scale_x,
            light.view.scale_y,
            light.view.cone,
            tolerance,
            light.view.depth_near,
            band.item_first,
            band.item_count,
            0,
            0};
}

uint32_t Sampler::plane_of(uint32_t light) const { return settings_.fractional ? light : shared::lit_word(light); }

gpu::Binding Sampler::lit_plane(uint32_t plane) const {
    const uint64_t bytes = settings_.most_slots * 4;
    return {"Lit", &lit_, {}, plane * bytes, bytes};
}

void Sampler::begin_lit(std::string_view stage, uint32_t plane) {
    if (lit_written_[plane]) return;
    lit_written_[plane] = true;
    const uint64_t bytes = settings_.most_slots * 4;
    device_.recorder().fill(stage, lit_, settings_.fractional ? std::bit_cast<uint32_t>(1.0f) : ~0u, plane * bytes, bytes);
}

// Of the indirect dispatches over the queue. Rows are of equal length: up to one more in each.
uint64_t Sampler::most_groups() const {
    const uint64_t hit_groups = groups_of(batch_.slot_count(), 64);
    return hit_groups + groups_of(hit_groups, shared::kShadowRow);
}

void Sampler::ask(const LightSide& light, float tolerance) {
    const uint64_t slots = batch_.slot_count();
    if (asked_nodes_.bytes() < slots * sizeof(glm::uvec2)) {
        asked_ = gpu::Buffer();
        asked_nodes_ = gpu::Buffer();
        asked_ = device_.allocate("asked", slots * sizeof(glm::vec4));
        asked_nodes_ = device_.allocate("asked_nodes", slots * sizeof(glm::uvec2));
    }
    std::vector<gpu::Binding> all = hit_bindings(light);
    for (const gpu::Binding& b : shell_bindings()) all.push_back(b);
    all.insert(all.end(), {{"Asked", &asked_},
                           {"AskedNodes", &asked_nodes_},
                           {"Receivers", &light.asked->receivers()},
                           lit_plane(plane_of(light.light_ix))});
    gpu::Recorder& recorder = device_.recorder();
    begin_lit("sample/shadow", plane_of(light.light_ix));
    recorder.dispatch_indirect(
        "sample/ask",
        programs_.get("sample/ask", {light.view.projection(), view_.orthographic, tracer_.straddle(), settings_.one_sided}),
        all, shadow_params(light, {light.bins.grid.cell_count}, {0, light.bins.item_count()}, tolerance), shadow_groups_, 0,
        most_groups());
}

void Sampler::descend(const LightSide& light, const Pages::Parts& parts, float tolerance) {
    std::vector<gpu::Binding> all = hit_bindings(light);
    all.insert(all.end(), {{"asked", &asked_, Texel::rgba32_float},
                           {"leaves", &light.asked->leaves(), Texel::r32_uint},
                           {"pages", &light.asked->pages(), Texel::rgba32_uint},
                           {"units", &parts.units, Texel::r32_uint},
                           {"Receivers", &parts.receivers},
                           {"AskedNodes", &asked_nodes_}});
    shared::ShadowParams params = shadow_params(light, {light.bins.grid.cell_count}, {parts.page_first, 0}, tolerance);
    params.range_first = parts.node_first;
    gpu::Recorder& recorder = device_.recorder();
    recorder.dispatch_indirect(
        "sample/ask",
        programs_.get("sample/descend", {light.view.projection(), view_.orthographic, tracer_.straddle(), settings_.one_sided}),
        all, params, shadow_groups_, 0, most_groups());
}

void Sampler::test_shadows(const LightSide& light, const Band& band, float tolerance) {
    const uint32_t parts = walk_parts(light.map->longest());
    reserve_walk(light.map->longest());
    const uint32_t plane = plane_of(light.light_ix);
    std::vector<gpu::Binding> all = hit_bindings(light);
    all.insert(all.end(), {lit_plane(plane),
                           {"ShadowCounts", &shadow_counts_},
                           {"asked", light.asked ? &asked_ : &nothing_, Texel::rgba32_float},
                           {"asked_nodes", light.asked ? &asked_nodes_ : &nothing_, Texel::rg32_uint},
                           {"leaves", light.asked ? &light.asked->leaves() : &nothing_, Texel::r32_uint}});
    if (settings_.shells)
        for (const gpu::Binding& b : shell_bindings()) all.push_back(b);
    for (const gpu::Binding& b : light.map->read_bindings()) all.push_back(b);
    if (light.map->s_buffer() != nullptr) all.push_back({"Iterators", &iterators_});
    // The first pass over the queue for a plane writes every hit's word, later ones clear bits in it.
    const Window& window = light.bins.window;
    const bool whole =
        window.tile_count == tiles_across(light.view) * tiles_down(light.view) && band.item_count == light.map->item_count();
    const bool first = !settings_.fractional && !lit_written_[plane] && parts == 1 && whole;
    gpu::Recorder& recorder = device_.recorder();
    if (first) lit_written_[plane] = true;
    begin_lit("sample/shadow", plane);
    recorder.fill("sample/shadow", shadow_counts_, 0);
    std::vector<uint32_t> constants = {light.view.projection(),
                                       view_.orthographic,
                                       tracer_.straddle(),
                                       settings_.one_sided,
                                       settings_.count_ranges,
                                       parts > 1,
                                       first,
                                       light.asked != nullptr};
    const std::vector<uint32_t> own = light.map->test_constants();
    constants.insert(constants.end(), own.begin(), own.end());
    shared::ShadowParams params = shadow_params(light, light.map->order(), band, tolerance);
    params.range_first = light.map->range_base();
    for (params.part = 0; params.part < parts; ++params.part) {
        recorder.dispatch_indirect("sample/shadow", programs_.get(settings_.shadow_stage, constants), all, params,
                                   shadow_groups_, 0, most_groups());
        if (settings_.watch != nullptr) settings_.watch->count_reads();
    }
    if (!settings_.count_ranges) return;
    const uint64_t blocks = groups_of(batch_.slot_count(), kCountersHits);
    const std::vector<uint32_t> values = gpu::download_vector<uint32_t>(device_, shadow_counts_, blocks * 3);
    for (uint64_t i = 0; i < blocks; ++i) {
        counts_.visited += values[i * 3];
        counts_.tested += values[i * 3 + 1];
        counts_.cast += values[i * 3 + 2] / parts;
    }
}

void Sampler::shade(bool lights_move) {
    gpu::Recorder& recorder = device_.recorder();
    for (uint32_t plane = 0; plane < lit_written_.size(); ++plane) begin_lit("sample/shade", plane);
    recorder.dispatch(
        "sample/shade",
        programs_.get("sample/shade", {view_.orthographic, tracer_.straddle(), settings_.keep_depths, geometry_.scene->textured,
                                       geometry_.scene->smooth, lights_move, settings_.fractional}),
        bindings({{"hits", &tracer_.hits(), Texel::r32_uint},
                  {"lit", &lit_, Texel::r32_uint},
                  {"triangles", &geometry_.scene->triangles, Texel::rgba32_uint},
                  {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                  {"positions", &geometry_.positions, Texel::rgba32_float},
                  {"normals", &geometry_.normals, Texel::rgba32_float},
                  {"attributes", &geometry_.scene->attributes, Texel::rgba32_float},
                  {"materials", &geometry_.scene->materials, Texel::rgba32_uint},
                  {"texels", &geometry_.scene->texels, Texel::rgba32_uint},
                  {"srgb_to_linear", &srgb_to_linear_, Texel::r32_float},
                  {"lights", &lights_, Texel::rgba32_float},
                  {"Film", &film_},
                  {"Depths", &depth_values_}}),
        shared::ShadeParams{bins_.grid, batch_.tile_first, batch_.tile_count, batch_.stratum_first, batch_.stratum_count,
                            settings_.spp, shared::stratum_length(settings_.spp), settings_.seed, settings_.light_count,
                            static_cast<uint32_t>(view_.keys.size()), film_px_.x, film_px_.x * film_px_.y,
                            static_cast<uint32_t>(settings_.most_slots)},
        batch_.tile_count);
}

const gpu::Buffer& Sampler::resolve() {
    const uint32_t pixels = film_px_.x * film_px_.y;
    gpu::Recorder& recorder = device_.recorder();
    recorder.dispatch("sample/resolve", programs_.get("sample/resolve", {settings_.fractional}), bindings({{"Film", &film_}}),
                      shared::ResolveParams{pixels, settings_.spp, settings_.light_count}, groups_of(pixels, 64));
    film_hits_ = recorder.download(hit_total_, 0, 8);
    return film_;
}

uint64_t Sampler::hit_count() const {
    return number_of(film_hits_ ? *film_hits_ : device_.recorder().download(hit_total_, 0, 8));
}

uint64_t Sampler::test_count() const { return number_of(device_.recorder().download(tracer_.test_count(), 0, 8)); }

uint64_t Sampler::number_of(const gpu::Download& low_high) const {
    const std::vector<uint32_t> words = gpu::values_of<uint32_t>(device_, low_high);
    return uint64_t(words[1]) << 32 | words[0];
}

std::vector<uint32_t> Sampler::batch_hits() const {
    return gpu::download_vector<uint32_t>(device_, tracer_.hits(), batch_.slot_count());
}
std::vector<uint32_t> Sampler::batch_lit(uint32_t word) const {
    return gpu::download_vector<uint32_t>(device_, lit_, batch_.slot_count(), word * settings_.most_slots * 4);
}
std::vector<float> Sampler::batch_visibility(uint32_t light) const {
    return gpu::download_vector<float>(device_, lit_, batch_.slot_count(), light * settings_.most_slots * 4);
}
std::vector<float> Sampler::batch_depths() const {
    return gpu::download_vector<float>(device_, depth_values_, batch_.slot_count());
}

}  // namespace gnomon
