// SPDX-License-Identifier: Apache-2.0
// The wavefront camera sampler: trace, compact, shadow test, shade; a queue between the stages, a batch of samples at a time.
#pragma once

#include "stages/s_buffer.hpp"
#include "stages/trace.hpp"

namespace gnomon {

/// A light's side of the shadow test: what there is of one window of one of its faces.
struct LightSide {
    uint32_t light_ix = 0;
    View view;
    Bins bins;
    bool listed = false;           ///< The bins' lists are complete.
    bool asks = false;             ///< Only pages that hits ask for are made of them.
    std::unique_ptr<Pages> asked;  ///< The pages that the map holds, where it does not hold all items.
    std::unique_ptr<ShadowMap> map;
    std::vector<Band> bands;
    size_t filled = ~size_t(0);  ///< Which band is.
};

struct ShadowCounts {
    uint64_t visited = 0;  ///< Ranges looked at.
    uint64_t tested = 0;   ///< Ranges whose triangle was tested.
    uint64_t cast = 0;     ///< Shadow tests: hits in a face's view. Where what stands still has its own, a hit may be in both.
};

struct SamplerSettings {
    std::string shadow_stage;  ///< The method's test, compiled for the layout.
    uint32_t spp = 1;
    uint32_t seed = 0;
    uint32_t light_count = 0;
    uint64_t most_slots = 0;       ///< Of a batch.
    bool fractional = false;       ///< Visibility is a share, not a bit.
    bool shells = true;            ///< The test knows closed shells.
    bool one_sided = false;        ///< Of closed shells the lights' lists hold only what looks away from the light.
    bool keep_depths = false;      ///< Each sample's depth, for batch_depths().
    bool count_ranges = false;     ///< Fill shadow_counts().
    LayoutWatch* watch = nullptr;  ///< Of the layout, where it is watched.
};

/// Planes of a word per slot that say which lights reach it: bits of 32 lights, or the share of one.
uint32_t lit_planes(uint32_t light_count, bool fractional);

class Sampler {
public:
    /// lights: their records (comp_shaders/shared/light.h).
    Sampler(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Bins& bins,
            const gpu::Buffer& lights, const SamplerSettings& settings);

    /// Begin the film of the window that the bins hold.
    void begin_window();
    /// Forget the batch before: find the nearest triangle of each sample, then queue those that hit.
    void trace(const Batch& batch);
    /// Memory for tests that walk lists of so many elements, a part at a time.
    void reserve_walk(uint64_t longest);
    /// Ask for the pages of the light's window that the queue needs.
    void ask(const LightSide& light, float tolerance);
    /// Those whose page is split ask for its parts.
    void descend(const LightSide& light, const Pages::Parts& parts, float tolerance);
    /// Test the queue against a band of a light's S-buffer that is filled now.
    void test_shadows(const LightSide& light, const Band& band, float tolerance);
    /// Add the batch to the film.
    void shade(bool lights_move);

    /// Finish the window's film: its channels as floats, plane-major, rows from the top, in the order of Frame::channels.
    const gpu::Buffer& resolve();
    /// Of all batches. It came with the film, if that was read since it was finished.
    uint64_t hit_count() const;
    /// Samples times triangles that sample/trace tested, whole tiles; where count_ranges.
    uint64_t test_count() const;
    /// cast only where they are counted.
    const ShadowCounts& shadow_counts() const { return counts_; }

    std::vector<uint32_t> batch_hits() const;                   ///< Per slot.
    std::vector<uint32_t> batch_lit(uint32_t word) const;       ///< A bit for each of 32 lights.
    std::vector<float> batch_visibility(uint32_t light) const;  ///< Where it is fractional.
    std::vector<float> batch_depths() const;

private:
    uint64_t number_of(const gpu::Download& low_high) const;
    /// What every stage binds that finds a hit in the light's view.
    std::vector<gpu::Binding> hit_bindings(const LightSide& light) const;
    std::vector<gpu::Binding> shell_bindings() const;
    shared::ShadowParams shadow_params(const LightSide& light, const ItemOrder& order, const Band& band, float tolerance) const;
    uint64_t most_groups() const;
    uint32_t plane_of(uint32_t light) const;
    gpu::Binding lit_plane(uint32_t plane) const;
    /// Where nothing was written to a plane of this batch, all lights reach all of its slots.
    void begin_lit(std::string_view stage, uint32_t plane);

    gpu::Device& device_;
    Programs& programs_;
    const Geometry& geometry_;
    const View& view_;
    const Bins& bins_;
    const gpu::Buffer& lights_;
    SamplerSettings settings_;
    Tracer tracer_;
    std::vector<bool> lit_written_;  ///< Of this batch, each plane.
    glm::uvec2 film_px_{0};          ///< Size of the window.
    Batch batch_;
    uint32_t run_count_ = 0;
    ShadowCounts counts_;
    std::optional<gpu::Download> film_hits_;  ///< When the film was finished.
    gpu::Buffer lit_, queue_, run_hits_, runs_, shadow_groups_, hit_total_, film_, depth_values_, shadow_counts_, iterators_,
        asked_, asked_nodes_, nothing_, srgb_to_linear_;
};

}  // namespace gnomon
