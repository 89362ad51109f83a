// SPDX-License-Identifier: Apache-2.0
#include "pipeline/lights.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <optional>

#include "pipeline/range_collector.hpp"
#include "stages/cells.hpp"
#include "stages/extent.hpp"

namespace gnomon {
namespace {

constexpr size_t kNotFilled = ~size_t(0);
// A sixth at least of what is shared out is left for a band: of it a quarter goes to the batch; of the rest a quarter to the
// film, and half to the camera's lists; of what remains at most a ninth to the lists of one tile.
constexpr uint64_t kLeastShare = 6;

// Texels along the side of a view of so many triangles: some to each, where they lie in one layer.
uint32_t fitted_resolution(uint64_t triangles, uint32_t most) {
    constexpr double kTexels = 2.0;
    constexpr double kLeast = 360.0;
    const double side = std::max(kLeast, std::sqrt(kTexels * static_cast<double>(triangles)));
    return std::min(most, static_cast<uint32_t>(std::ceil(side / shared::kTileSize)) * shared::kTileSize);
}

/// While this lives, commands count as marked.
class Marked {
public:
    explicit Marked(gpu::Recorder& recorder) : recorder_(recorder), before_(recorder.mark(true)) {}
    ~Marked() { recorder_.mark(before_); }
    Marked(const Marked&) = delete;
    Marked& operator=(const Marked&) = delete;

private:
    gpu::Recorder& recorder_;
    bool before_;
};

void release_side(LightSide& side) {
    side.map.reset();
    side.asked.reset();
    side.bands.clear();
    side.bins = Bins();
    side.listed = false;
    side.filled = kNotFilled;
}

}  // namespace

Lights::Lights(Shared shared, const Scene& scene, const std::vector<Pose>& poses, const Bounds& bounds)
    : shared_(std::move(shared)),
      light_count_(static_cast<uint32_t>(scene.lights.size())),
      tolerance_(least_tolerance(bounds)) {
    constexpr double kNearest = 1e-5;  // Ten times the metres below which a light does not get brighter: sample/shade.
    for (uint32_t i = 0; i < light_count_; ++i) {
        const bool has_place = scene.lights[i].kind != LightKind::directional;
        for (const View& view : light_faces(scene.lights[i], poses, i, bounds, shared_.settings.shadow_res)) {
            check_reach(view, bounds, "light " + std::to_string(i), scene.path.string(), has_place ? kNearest : 0.0);
            for (const Part part : parts_of(view)) {
                Face& face = faces_.emplace_back();
                face.part = part;
                face.side.light_ix = i;
                face.side.view = view;
            }
        }
    }
    for (Face& face : faces_) {
        contexts_.push_back({shared_.device, shared_.programs, shared_.geometry, shared_.settings, shared_.method,
                             face.side.view, face.side.light_ix, shared_.still, 0, shared_.layout, shared_.raster,
                             shared_.watch, &shared_.camera});
        const uint64_t all = uint64_t(tiles_across(face.side.view)) * tiles_down(face.side.view);
        face.windows = windows_of(face.side.view, shared_.method.windowed ? most_tiles(contexts_.size() - 1) : all);
    }
}

// What stands still is listed apart where that is worth a second way through the queue of hits.
std::vector<Part> Lights::parts_of(const View& view) const {
    constexpr uint64_t kPrismHits = 4;  // Shadow tests that take as long as listing a prism and finding its ranges.
    const RenderSettings& settings = shared_.settings;
    if (!settings.static_once || keeps_ranges(settings) || !shared_.method.any_texels || !view.still()) return {Part::whole};
    const uint32_t triangles = shared_.geometry.scene->triangle_count;
    const uint32_t still = gpu::values_of<uint32_t>(shared_.device, shared_.geometry.still_triangles)[0];
    if (still == triangles) return {Part::still};
    const uint32_t cells = light_cells(shared_.geometry.segment_count, shared_.still, settings.light_cells);
    const uint64_t samples = uint64_t(settings.width) * settings.height * settings.spp;
    if (!worth_apart(still, triangles, cells) || uint64_t(still) * (cells - 1) * kPrismHits < samples) return {Part::whole};
    return {Part::still, Part::moving};
}

uint32_t Lights::cells(size_t face) const {
    return faces_[face].part == Part::still ? 1 : shared_.method.light_cells(contexts_[face]);
}

// So that what there is of each list can be bound. What depends on the scene is found when a window is made.
uint64_t Lights::most_tiles(size_t face) const {
    const gpu::Limits& limits = shared_.device.limits();
    const uint64_t cells = this->cells(face);
    const uint64_t lists = std::min(limits.max_storage_range / 4, limits.most_elements(4)) - shared::kScanRun;
    // A map without ranges has at most 8 bytes for a texel in one binding.
    const uint64_t texels = shared_.method.has_s_buffer() ? (limits.most_elements(4) - shared::kScanRun) / cells
                                                          : std::min(limits.max_storage_range, limits.most_elements(4) * 4) / 8;
    return std::min(lists / cells, texels / shared::kTileTexels);
}

Listing Lights::listing() const {
    if (shared_.raster == "prism") return Listing::bounds;
    return shared_.casting ? Listing::casting : Listing::swept;
}

// Where a list of an S-buffer is long, so are the ways through it of the few hits there: pages that may be split are then worth
// the asking.
bool Lights::asks(const Bins& bins) const {
    constexpr uint32_t kLongList = 2048;
    return shared_.pages == "asked" || (shared_.pages == "auto" && shared_.method.any_texels && bins.longest > kLongList);
}

void Lights::prepare() {
    make_together();
    counting_ = true;
    // Only a count tells whether the ranges of a window fit. To make one may cut it in two.
    std::optional<BandTooLarge> worst;
    for (size_t i = 0; i < faces_.size(); ++i) {
        for (size_t w = 0; w < (shared_.method.has_s_buffer() ? faces_[i].windows.size() : 1); ++w) {
            try {
                cut_to_fit(i, w, worst.has_value());
            } catch (const BandTooLarge& error) {
                if (!worst || error.needed > worst->needed) worst = error;
            }
        }
    }
    counting_ = false;
    if (worst) refuse(*worst);
}

// Step by step for all faces, so that the host waits for all of them at once. Where they do not fit, nothing is made.
void Lights::make_together() {
    const Marked marked(shared_.device.recorder());
    try {
        std::vector<Binning> binnings;
        for (size_t i = 0; i < faces_.size(); ++i) {
            LightSide& side = faces_[i].side;
            project(i);
            binnings.emplace_back(shared_.device, shared_.programs, shared_.geometry, side.view, faces_[i].windows[0],
                                  listing(), side.bins);
        }
        for (Binning& binning : binnings) binning.count();
        for (Binning& binning : binnings) binning.fill();
        for (Face& face : faces_) {
            face.side.listed = true;
            face.side.asks = asks(face.side.bins);
        }
        for (size_t i = 0; i < faces_.size(); ++i) {
            if (!faces_[i].side.asks) map_lists(i);
        }
        for (size_t i = 0; i < faces_.size(); ++i) {
            if (!faces_[i].side.asks) finish_map(i);
        }
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::out_of_memory) throw;
        release();
    }
}

bool Lights::release() {
    bool any = false;
    for (Face& face : faces_) {
        any = any || face.side.bins.raster_vertices;
        release_side(face.side);
    }
    return any;
}

bool Lights::release_others(size_t face) {
    bool any = false;
    for (size_t i = 0; i < faces_.size(); ++i) {
        if (i == face) continue;
        any = any || faces_[i].side.bins.raster_vertices;
        release_side(faces_[i].side);
    }
    return any;
}

template <class Work>
bool Lights::with_room(size_t face, Work work) {
    const Marked marked(shared_.device.recorder());
    bool fits = false, more = true;
    while (!fits && more) {
        try {
            work();
            fits = true;
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::out_of_memory) throw;
            failure_ = std::current_exception();
            more = release_others(face);
            alone_ = true;
        }
    }
    alone_ = false;
    return fits;
}

void Lights::refuse(const BandTooLarge& error) const {
    if (error.needed <= error.available)
        throw Error(error.kind(), std::string(error.what()) + ", more than the device can bind", "", "use " + error.other);
    const uint64_t budget = shared_.device.budget(), others = budget - shared_.room;
    const uint64_t enough =
        std::max(others + kLeastShare * error.needed, budget + kLeastShare * (error.needed - error.available));
    throw Error(error.kind(), error.what(), "",
                "use --memory-budget " + std::to_string((enough >> 20) + 1) + "M or more, or " + error.other +
                    "; the device says that it has " + std::to_string(shared_.device.limits().heap_bytes >> 20) + " MiB");
}

uint64_t Lights::share() const {
    if (alone_) return shared_.device.budget_left();
    const auto unfilled =
        std::count_if(faces_.begin(), faces_.end(), [](const Face& face) { return face.side.filled == kNotFilled; });
    return shared_.device.budget_left() / static_cast<uint64_t>(std::max<std::ptrdiff_t>(1, unfilled));
}

void Lights::project(size_t face) {
    LightSide& side = faces_[face].side;
    side.map.reset();
    side.filled = kNotFilled;
    if (side.bins.raster_vertices) return;
    do {
        side.bins = Bins();
        side.bins =
            project_prisms(shared_.device, shared_.programs, shared_.geometry, side.view, cells(face), faces_[face].part);
    } while (fit(face));
    side.bins.in_order = shared_.settings.count_ranges || shared_.settings.count_accesses > 0;
}

bool Lights::fit(size_t face) {
    Face& made = faces_[face];
    LightSide& side = made.side;
    if (made.fitted || !shared_.casting || !side.view.orthographic || keeps_ranges(shared_.settings)) return false;
    const Extents extents = casting_extents(shared_.device, shared_.programs, shared_.geometry, side.bins);
    made.fitted = true;
    if (extents.boxes.empty()) return false;
    side.view = fitted(side.view, fitted_resolution(extents.triangles, shared_.settings.shadow_res), extents.boxes);
    made.windows = windows_of(side.view, most_tiles(face));
    return true;
}

void Lights::map_lists(size_t face) {
    contexts_[face].bytes = share();
    faces_[face].side.map = shared_.method.make_map(contexts_[face], faces_[face].side.bins);
}

void Lights::finish_map(size_t face) {
    Face& made = faces_[face];
    LightSide& side = made.side;
    shared_.sampler.reserve_walk(side.map->longest());  // Before the bands take what is left.
    side.bands = side.map->bands(share());
    std::map<std::string, uint64_t>& counts = made.counts[side.bins.window.tile_first];
    if (!side.asks) counts.clear();
    for (const auto& [name, count] : side.map->counts()) counts[name] += count;
    counts["bin_entries"] = side.bins.entry_count;
    if (side.asked) counts["pages"] += side.asked->count();
    made.effective = side.map->effective();
    if (shared_.method.has_s_buffer()) made.effective["pages"] = side.asks ? "asked" : "all";
    made.effective["light_cells"] = std::to_string(side.bins.grid.cell_count);
}

bool Lights::fits(size_t face, size_t window) {
    Face& made = faces_[face];
    LightSide& side = made.side;
    if (side.map && side.bins.window == made.windows[window]) return true;
    const bool fits = with_room(face, [&] {
        project(face);
        if (!side.listed || side.bins.window != made.windows[window]) {
            side.listed = false;
            list_prisms(shared_.device, shared_.programs, shared_.geometry, side.view, made.windows[window], listing(),
                        side.bins);
            side.listed = true;
            side.asks = asks(side.bins);
        }
        // Which pages are asked for is known when there are hits.
        contexts_[face].asked = nullptr;
        if (side.asks && counting_) return;
        if (side.asks) ask(face);
        if (side.asked && side.asked->count() == 0) return;
        map_lists(face);
        finish_map(face);
    });
    if (!fits) release_side(side);
    return fits;
}

void Lights::ask(size_t face) {
    LightSide& side = faces_[face].side;
    side.asked.reset();
    side.asked = std::make_unique<Pages>(shared_.device, shared_.programs, shared_.geometry, side.bins);
    shared_.sampler.ask(side, tolerance_);
    side.asked->list();
    if (shared_.method.any_texels)
        side.asked->refine(side.view.orthographic,
                           [&](const Pages::Parts& parts) { shared_.sampler.descend(side, parts, tolerance_); });
    contexts_[face].asked = side.asked.get();
}

void Lights::cut_to_fit(size_t face, size_t window, bool only_count) {
    Face& made = faces_[face];
    while (!fits(face, window)) {
        try {
            std::rethrow_exception(failure_);
        } catch (const BandTooLarge&) {
            if (only_count || !shared_.method.windowed || !halve(made.windows, window, made.side.view)) throw;
        } catch (const Error&) {
            if (!shared_.method.windowed || !halve(made.windows, window, made.side.view)) throw;
        }
    }
}

void Lights::make(size_t face, size_t window) {
    try {
        cut_to_fit(face, window, false);
    } catch (const BandTooLarge& error) {
        refuse(error);
    }
}

uint32_t Lights::most_strata() const {
    const uint32_t spp = shared_.settings.spp;
    uint32_t most = std::min(spp, shared::most_strata_of(light_count_));
    for (const Face& face : faces_) {
        if (face.side.bands.empty()) continue;
        const double longest = face.side.bands[0].t_close - face.side.bands[0].t_open;
        most = std::min(most, static_cast<uint32_t>(std::max(1.0, std::floor(longest * spp))));
    }
    return most;
}

bool Lights::test_shadows(const Batch& batch, bool may_give_up) {
    const double open = static_cast<double>(batch.stratum_first) / shared_.settings.spp;
    const double close = static_cast<double>(batch.stratum_first + batch.stratum_count) / shared_.settings.spp;
    for (size_t i = 0; i < faces_.size(); ++i) {
        Face& face = faces_[i];
        for (size_t w = 0; w < face.windows.size(); ++w) {
            LightSide& side = face.side;
            const bool made = may_give_up && fits(i, w);
            if (may_give_up && !made && side.asks) return false;
            if (!made) make(i, w);
            for (size_t b = 0; b < side.bands.size(); ++b) {
                const Band& band = side.bands[b];
                if (band.t_close <= open || band.t_open >= close) continue;
                if (side.filled != b && !with_room(i, [&] { side.map->fill(band); })) std::rethrow_exception(failure_);
                if (side.filled != b) keep_lost(face, band);
                side.filled = b;
                shared_.sampler.test_shadows(side, band, tolerance_);
            }
            // The next batch asks for others.
            if (!side.asks) continue;
            side.map.reset();
            side.asked.reset();
            side.bands.clear();
            side.filled = kNotFilled;
        }
    }
    return true;
}

// A band may be filled again, and windows be cut; pages are others for each batch.
void Lights::keep_lost(Face& face, const Band& band) {
    const SBuffer* s_buffer = face.side.map->s_buffer();
    if (s_buffer == nullptr || !s_buffer->lost()) return;
    const Window& window = face.side.bins.window;
    const auto replaced = [&](const Face::Lost& other) {
        const bool apart = other.window.tile_first + other.window.tile_count <= window.tile_first ||
                           window.tile_first + window.tile_count <= other.window.tile_first;
        return !apart && (other.window != window || other.item_first == band.item_first);
    };
    if (!face.side.asks) std::erase_if(face.lost, replaced);
    face.lost.push_back({window, band.item_first, *s_buffer->lost()});
}

void Lights::report(Frame& frame) const {
    for (const Face& face : faces_) {
        const std::string suffix = "." + std::to_string(face.side.light_ix);
        if (!shared_.layout.counters.empty()) frame.stats.counts["lost" + suffix] += 0;
        for (const Face::Lost& lost : face.lost)
            frame.stats.counts["lost" + suffix] += gpu::values_of<uint32_t>(shared_.device, lost.count)[0];
        for (const auto& [tile, counts] : face.counts) {
            for (const auto& [name, count] : counts) frame.stats.counts[name + suffix] += count;
        }
        for (const auto& [name, value] : face.effective) frame.effective[name] = value;
    }
}

void Lights::read_ranges(Frame& frame) {
    bool asked = false;
    std::vector<RangeCollector> lights(light_count_, RangeCollector(shared_.settings, shared_.method.exit_depth));
    for (size_t i = 0; i < faces_.size(); ++i) {
        LightSide& side = faces_[i].side;
        RangeCollector& light = lights[side.light_ix];
        light.begin_face(side.view);
        for (size_t w = 0; w < faces_[i].windows.size(); ++w) {
            // What was filled before has no room beside it; half of what there is goes to what is read.
            release();
            make(i, w);
            // Pages are others for each batch; ranges are kept where there are none.
            asked = asked || side.asks;
            if (side.asks) continue;
            const SBuffer* s_buffer = side.map->s_buffer();
            if (s_buffer == nullptr) continue;
            try {
                side.bands = side.map->bands(shared_.device.budget_left() / 2);
            } catch (const BandTooLarge& error) {
                refuse({error, 2});
            }
            for (const Band& band : side.bands) {
                side.map->fill(band);
                light.read(shared_.device, shared_.programs, *s_buffer, band);
            }
        }
    }
    release();
    for (RangeCollector& light : lights) light.finish(frame);
    if (asked) frame.list_lengths.clear();
}

}  // namespace gnomon
