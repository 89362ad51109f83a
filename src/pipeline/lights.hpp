// SPDX-License-Identifier: Apache-2.0
// The lights of a frame, as a list of faces. What their shadow tests read is made for a window of a face's view at a time,
// stays in memory while there is room, and is made again when it is needed again.
#pragma once

#include <exception>

#include "methods/method.hpp"
#include "stages/sample.hpp"

namespace gnomon {

class Lights {
public:
    /// What all lights of a frame share.
    struct Shared {
        gpu::Device& device;
        Programs& programs;
        const Geometry& geometry;
        const RenderSettings& settings;
        const Method& method;
        Layout layout;
        std::string raster;
        LayoutWatch* watch;  ///< As LightContext's.
        const View& camera;
        Sampler& sampler;
        uint64_t room = 0;     ///< Bytes of the budget that were shared out.
        bool still = false;    ///< Nothing moves.
        std::string pages;     ///< As RenderSettings::pages; empty: there are none.
        bool casting = false;  ///< List only what may shadow something.
    };

    /// Nothing is made yet.
    Lights(Shared shared, const Scene& scene, const std::vector<Pose>& poses, const Bounds& bounds);

    /// Make each face's first window, and count every window's ranges, so that what cannot be rendered is refused before it is
    /// begun. Errors: ErrorKind::out_of_memory where not even a tile of a light's view fits.
    void prepare();
    /// Free what can be made again; false where there is nothing.
    bool release();

    /// Most strata of a batch: what shading can walk; and where a map is cut in time, so are the samples, so that it is filled
    /// once.
    uint32_t most_strata() const;
    /// Test the sampler's hits, of the batch, against every light. False, if may_give_up, where the pages that they ask for do
    /// not fit into memory: those that fewer hits ask for may.
    bool test_shadows(const Batch& batch, bool may_give_up);

    /// Write counts, by "name.light", and what was really used.
    void report(Frame& frame) const;
    /// Fill Frame::texel_ranges, Frame::light_ranges and Frame::list_lengths, as far as the settings ask for them. Everything
    /// is made once more.
    void read_ranges(Frame& frame);

private:
    /// One projection of a light, of the scene or a part of it.
    struct Face {
        LightSide side;
        Part part = Part::whole;
        std::vector<Window> windows;
        bool fitted = false;                                         ///< Its view was, or need not be.
        std::map<uint32_t, std::map<std::string, uint64_t>> counts;  ///< Of each window that was made, by its first tile.
        std::map<std::string, std::string> effective;
        /// What the layout lost in a band.
        struct Lost {
            Window window;
            uint32_t item_first;
            gpu::Download count;
        };
        std::vector<Lost> lost;
    };
    static void keep_lost(Face& face, const Band& band);

    std::vector<Part> parts_of(const View& view) const;
    uint32_t cells(size_t face) const;
    uint64_t most_tiles(size_t face) const;
    Listing listing() const;
    bool asks(const Bins& bins) const;
    void make_together();
    /// Have windows[window] of the face in memory. Where it does not fit, other faces go, then it is halved.
    void make(size_t face, size_t window);
    // Steps of it.
    void cut_to_fit(size_t face, size_t window, bool only_count);  ///< Count: nothing need be filled.
    bool fits(size_t face, size_t window);                         ///< Without halving it; then it is in memory.
    void project(size_t face);
    /// Fit the projected face's view to what may shadow something, once; true where that changed it.
    bool fit(size_t face);
    void ask(size_t face);
    void map_lists(size_t face);
    void finish_map(size_t face);
    bool release_others(size_t face);
    /// Record the work, which counts to the lights' maps; where it does not fit into memory, release the other faces and try
    /// again. False where that is in vain.
    template <class Work>
    bool with_room(size_t face, Work work);
    uint64_t share() const;  ///< Bytes for the bands of one face.
    [[noreturn]] void refuse(const BandTooLarge& error) const;

    Shared shared_;
    uint32_t light_count_;
    float tolerance_;
    std::vector<Face> faces_;
    std::vector<LightContext> contexts_;  ///< Of each face; its map refers to it.
    bool alone_ = false;                  ///< The other faces gave way to the one that is worked on.
    bool counting_ = false;               ///< Nobody can ask yet.
    std::exception_ptr failure_;          ///< Why something did not fit.
};

}  // namespace gnomon
