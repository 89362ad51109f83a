// SPDX-License-Identifier: Apache-2.0
// Rendering one frame: settings in, channels and statistics out.
#pragma once

#include <cstdint>
#include <functional>
#include <gnomon/scene.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// Segments of motion that a frame has at most.
inline constexpr uint32_t kMostSegments = 128;

struct RenderSettings {
    uint32_t width = 1280;  ///< Pixels, 1 to 16384.
    uint32_t height = 720;  ///< Pixels, 1 to 16384.
    uint32_t spp = 16;      ///< Samples per pixel, 1 to 65536.
    uint32_t seed = 0;
    uint32_t camera = 0;         ///< Index into Scene::cameras.
    uint32_t shadow_res = 1024;  ///< Texels along a light view's side, 1 to 16384; of a sun's at most, for exact.
    std::string method = "exact";
    std::string layout = "auto";  ///< A registered layout, a folder that holds one, or auto: what the method is made for.
    std::string raster =
        "auto";  ///< How ranges are found: analytic, conservative, prism, or auto: what the method is made for.
    /// Of an S-buffer are made: "all" its pages, or those that hits ask for ("asked"); "auto": asked where lists are long and
    /// the picture does not depend on the texels.
    std::string pages = "auto";
    /// Cells of time of a light's S-buffer: a multiple of the poses' segments, at most kMostSegments; 0: what is fast. Only of
    /// method exact, whose ranges may be cut where a cell ends.
    uint32_t light_cells = 0;
    /// Of the method, by name (`gnomon methods`); those that are not given have their initial values.
    std::map<std::string, double> parameters = {};
    /// Of closed meshes list one side only, and nothing that shadows nothing, in views of suns that are fitted to what is left,
    /// where the picture does not depend on what is listed (method exact). For comparison.
    bool closed_meshes = true;
    /// List what stands still in a view once, not in each cell of time: the camera's, and lights' of method exact. For
    /// comparison.
    bool static_once = true;
    uint64_t memory_budget = 0;      ///< Most bytes of device memory; 0: half the device's heap.
    bool keep_samples = false;       ///< Fill Frame::samples.
    bool keep_texel_ranges = false;  ///< Fill Frame::texel_ranges. Does what `pages` "all" and no `static_once` do, and leaves
                                     ///< suns' views as they are; so does the next.
    bool keep_ranges = false;        ///< Fill Frame::light_ranges.
    bool keep_list_lengths = false;  ///< Fill Frame::list_lengths: of the S-buffer as it is without the two above.
    bool check_layout = false;       ///< What a layout does not initialise holds 0xcdcdcdcd, so that it shows, and its accesses
                                     ///< are checked: fill Frame::layout_faults.
    bool count_ranges = false;       ///< Count the ranges that the shadow tests look at and test; costs some percent.
    /// Fill Frame::layout_accesses: reads of one in so many groups of shadow tests, 1: of all; 0: count nothing. The frame
    /// takes many times as long. Not together with check_layout.
    uint32_t count_accesses = 0;
};

/// What one camera sample found. Index (y * width + x) * spp + s in Frame::samples.
struct SampleRecord {
    static constexpr uint32_t kMiss = 0xffffffffu;
    uint32_t triangle = kMiss;  ///< Into Scene::triangles.
    float depth = 0.0f;         ///< Metres along the view axis.
    /// Bit i: light i reaches the hit; half of it or more, of a method that gives shares. Of the first 32 lights: Frame::lit
    /// knows all.
    uint32_t lit = 0;
};

/// A range of an S-buffer: while the shutter is open from `enter` to `leave`, 0 to 1 (by rounding up to 1e-5 less or more), a
/// triangle may be seen in a texel of a light's view.
struct TexelRange {
    uint32_t texel = 0;  ///< Row * width + column.
    float enter = 0.0f;
    uint32_t triangle = 0;  ///< Into Scene::triangles.
    float leave = 0.0f;
    float depth = 0.0f;       ///< At the entry, metres along the view's axis; of conservative ranges the nearest.
    float exit_depth = 0.0f;  ///< `depth`, where the method keeps none.

    bool operator==(const TexelRange&) const = default;
};

/// The S-buffer of a light: its ranges, by texel, then by enter, triangle, leave and depths. In 24 bytes each.
struct LightRanges {
    uint32_t width = 0;   ///< Texels.
    uint32_t height = 0;  ///< Of all faces, one below the other.
    uint32_t faces = 0;
    bool exit_depths = false;  ///< The method keeps them.
    std::vector<TexelRange> ranges;
};

/// What a layout did of one kind that it must not, seen with RenderSettings::check_layout.
struct LayoutFault {
    std::string buffer;    ///< Was accessed beyond its end; empty: walks of lists went on without an end.
    uint64_t count = 0;    ///< How often.
    uint64_t element = 0;  ///< The index that was used, once; of walks the list.
};

/// What a frame accesses of its layout, seen with RenderSettings::count_accesses. A group are 32 hits that follow each other in
/// the queue of the shadow tests: what a device with subgroups of 32 tests together, and that walks in step. What is counted
/// does not depend on the subgroups of the device that it is counted on.
struct LayoutAccesses {
    uint64_t groups = 0;           ///< Of the sample; those with a query.
    uint64_t queries = 0;          ///< Hits in the light's view: their lists are asked for what may shadow them.
    uint64_t reads = 0;            ///< Of an element each.
    uint64_t bytes = 0;            ///< Of these elements.
    uint64_t distinct_bytes = 0;   ///< Each byte once in a group; sectors and lines likewise.
    uint64_t sectors = 0;          ///< Of 32 bytes.
    uint64_t lines = 0;            ///< Of 128 bytes.
    uint64_t requests = 0;         ///< Reads of the same buffer that a group makes at one time are one.
    uint64_t request_sectors = 0;  ///< Distinct ones of each request.
    uint64_t turns = 0;            ///< Of walks, which a group makes together.
    uint64_t visits = 0;           ///< Elements that the queries' walks gave, at most 32 a turn.
    uint64_t most_reads = 0;       ///< By one query.
    uint64_t chained_reads =
        0;  ///< Of each query those that it has to make one after the other, each for the next one's index.
    uint64_t longest_chain = 0;  ///< The most of these of one query.
    bool complete = true;        ///< There was room for all records of the sample. Else what is above is of no use.

    uint64_t atomics = 0;       ///< By which the S-buffers were filled.
    uint64_t most_atomics = 0;  ///< On one address, in a band of a light's view.
    uint64_t held_bytes = 0;    ///< Of all bands, the layout's buffers.
    uint64_t used_bytes = 0;    ///< Of these: words that differ from what they were filled with before.
};

struct Channel {
    std::string name;           ///< "R", "A", "visibility.0", ...
    std::vector<float> values;  ///< width * height, rows from the top.
};

/// Seconds on the device and what passed through, by stage and buffer name. Ordered as the stages ran first.
struct FrameStats {
    struct Stage {
        std::string name;
        double seconds = 0.0;
        uint64_t dispatches = 0;
        double map_seconds = 0.0;  ///< Of `seconds`, those that went into what the lights' shadow tests read.
    };
    std::vector<Stage> stages;
    std::map<std::string, uint64_t> buffer_bytes;  ///< Largest size of each buffer.
    uint64_t peak_bytes = 0;                       ///< Most device memory at one time.
    /// triangles, prisms, ranges, samples, hits, shadow_tests, ...; camera_tests, ranges_visited and ranges_tested where
    /// RenderSettings::count_ranges asks for them.
    std::map<std::string, uint64_t> counts;
    bool timed = true;            ///< Stages have seconds; not on devices that cannot tell the time.
    uint64_t submissions = 0;     ///< Of work to the device; each is waited for.
    double longest_dispatch = 0;  ///< Seconds of what ran longest as one.
    double wall_seconds = 0.0;
    std::string device;
    std::string driver;  ///< Its name and version; empty of what has none.

    /// What layouts of a fixed capacity lost, of all lights: the sum of the counts lost.<light>.
    uint64_t lost_ranges() const;
};

struct Frame {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t light_count = 0;
    std::vector<Channel> channels;  ///< R G B A Z, then visibility.<i> and visibility_var.<i> for each light.
    std::vector<SampleRecord> samples;
    std::vector<uint32_t> more_lit;  ///< Bits of lights 32 and up: index word * samples.size() + sample, 32 lights a word.
    std::vector<float> sample_visibility;  ///< Of methods that give shares: index sample * light_count + light.
    /// By light: how many ranges each texel of its view has in the whole shutter (shadow_res squared, rows from the top; of a
    /// light with several faces one face below the other); empty for methods without ranges.
    std::vector<std::vector<uint32_t>> texel_ranges;
    std::vector<LightRanges> light_ranges;  ///< By light; without texels for methods without ranges.
    /// How many lists (of a texel in a cell of time) of all lights have so many ranges, by that number; empty for methods
    /// without ranges, and where pages were made that hits asked for.
    std::vector<uint64_t> list_lengths;
    std::vector<LayoutFault> layout_faults;         ///< By buffer of the manifest.
    std::optional<LayoutAccesses> layout_accesses;  ///< None of methods without an S-buffer.
    std::map<std::string, std::string> effective;  ///< What was really used: method, raster, layout, camera_cells, light_cells.
    FrameStats stats;

    /// Keep so many samples, which no light reaches yet.
    void keep_samples(size_t count) {
        samples.resize(count);
        more_lit.resize(light_count > 32 ? (light_count - 1) / 32 * count : 0);
    }
    /// Does a light reach a sample that was kept?
    bool lit(size_t sample, uint32_t light) const {
        const uint32_t word = light < 32 ? samples[sample].lit : more_lit[(light / 32 - 1) * samples.size() + sample];
        return (word >> light % 32 & 1u) != 0;
    }
    /// Say that it does.
    void set_lit(size_t sample, uint32_t light) {
        uint32_t& word = light < 32 ? samples[sample].lit : more_lit[(light / 32 - 1) * samples.size() + sample];
        word |= 1u << light % 32;
    }
};

/// Called with the share done, 0 to 1, at first and after each submission to the device: about a quarter of a second apart or
/// less, but where the driver compiles. Returning false stops the frame, whose channels are then 0.
using Progress = std::function<bool(double)>;

struct DeviceDescription {
    uint32_t index = 0;
    std::string name;
    std::string type;            ///< "discrete", "integrated", "virtual", "cpu", "other"
    std::string driver;          ///< Its name and version.
    std::string driver_name;     ///< Empty of devices before Vulkan 1.3, as is the version.
    std::string driver_version;  ///< As the driver writes it: "Mesa 22.3.6 (LLVM 15.0.6)".
    std::string vulkan;          ///< The version of Vulkan: "1.3.230".
    uint64_t heap_bytes = 0;     ///< Of the largest heap that is the device's own: all buffers are in it.
    /// What gnomon cuts its work to, by name; names that end in _bytes have that unit. Empty of devices before Vulkan 1.3.
    std::vector<std::pair<std::string, uint64_t>> limits;
    std::vector<std::string> faults;   ///< Known faults of its driver, and how each is avoided.
    std::vector<std::string> missing;  ///< Required features that it lacks; empty: usable.
    bool chosen = false;               ///< What an empty choice would use.
};

/// All Vulkan devices of this machine. An empty list where there is no driver.
std::vector<DeviceDescription> list_devices();

/// What the Vulkan loader says against drivers and layers that it did not load, each once. Empty where nothing is wrong.
std::vector<std::string> loader_errors();

/// What of a scene does not move, on a renderer's device: for frames that differ in pose or settings alone. It refers to the
/// scene, which must not change or go before it.
class LoadedScene {
public:
    const Scene& scene() const;

    struct Impl;

private:
    friend class Renderer;
    std::shared_ptr<const Impl> impl_;
};

/// A Vulkan device with its programs. Construction is expensive, frames are not: keep one.
class Renderer {
public:
    /// device: name (or part of it), index, "cpu" or "gpu"; empty: the first hardware device, else a CPU. validate: with the
    /// Khronos validation layer; any message then is an Error of ErrorKind::internal. Errors: ErrorKind::no_device, naming what
    /// is missing.
    explicit Renderer(const std::string& device = "", bool validate = false);
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    const DeviceDescription& device() const;

    /// Render the scene in these poses (segments + 1 of them, see pose_scene; 2 to kMostSegments + 1). The scene needs a camera
    /// and may have no light. Errors: ErrorKind::usage, input, out_of_memory, device_lost. Deterministic: same arguments, same
    /// bits.
    Frame render(const Scene& scene, const std::vector<Pose>& poses, const RenderSettings& settings,
                 const Progress& progress = {});

    /// Upload the scene for several frames. Errors: ErrorKind::input, out_of_memory, device_lost.
    LoadedScene load(const Scene& scene);
    /// The same frame as of its scene. Errors: also ErrorKind::usage for a scene that another renderer loaded.
    Frame render(const LoadedScene& scene, const std::vector<Pose>& poses, const RenderSettings& settings,
                 const Progress& progress = {});
    /// The same, over a frame that is no longer needed: it gives its memory, since fresh memory for the channels can cost more
    /// than the picture. What it holds after an error is undefined.
    void render(const LoadedScene& scene, const std::vector<Pose>& poses, const RenderSettings& settings, Frame& frame,
                const Progress& progress = {});

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon
