// SPDX-License-Identifier: Apache-2.0
#include "bench_counts.hpp"

#include <algorithm>

namespace gnomon::cli {

namespace {

// Without the light's number: "ranges.0" is "ranges".
std::string without_light(const std::string& name) {
    const size_t dot = name.rfind('.');
    const bool of_light =
        dot != std::string::npos && dot + 1 < name.size() &&
        std::all_of(name.begin() + static_cast<ptrdiff_t>(dot) + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
    return of_light ? name.substr(0, dot) : name;
}

// What the shadow tests did, of a frame that counts it.
void add_tests(const FrameStats& stats, std::map<std::string, double>& counts) {
    const auto of = [&](const char* name) {
        const auto found = stats.counts.find(name);
        return found == stats.counts.end() ? 0.0 : static_cast<double>(found->second);
    };
    const double queries = of("shadow_tests");
    counts["queries"] = queries;
    counts["candidates_visited"] = of("ranges_visited");
    counts["triangles_tested"] = of("ranges_tested");
    if (queries > 0.0) {
        counts["ranges_visited_per_query"] = of("ranges_visited") / queries;
        counts["triangles_tested_per_query"] = of("ranges_tested") / queries;
    }
}

// The largest sample of shadow tests whose reads can be kept; nothing, where there is no memory to count them.
std::optional<LayoutAccesses> count_accesses(Renderer& renderer, const LoadedScene& scene, const std::vector<Pose>& poses,
                                             RenderSettings settings, Frame& frame) {
    constexpr uint32_t kLeast = 16, kMost = 1u << 20;
    for (settings.count_accesses = kLeast; settings.count_accesses <= kMost; settings.count_accesses *= 4) {
        try {
            renderer.render(scene, poses, settings, frame);
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::out_of_memory) throw;
            return std::nullopt;
        }
        if (!frame.layout_accesses || frame.layout_accesses->complete) return frame.layout_accesses;
    }
    return std::nullopt;
}

}  // namespace

std::map<std::string, double> counts_of(const FrameStats& stats) {
    std::map<std::string, double> counts = {{"peak_bytes", static_cast<double>(stats.peak_bytes)}};
    for (const auto& [name, count] : stats.counts) {
        counts[without_light(name)] += static_cast<double>(count);
    }
    return counts;
}

std::map<std::string, double> counts_of(const LayoutAccesses& accesses) {
    std::map<std::string, double> counts = {{"atomics", static_cast<double>(accesses.atomics)},
                                            {"most_atomics_on_one", static_cast<double>(accesses.most_atomics)},
                                            {"held_bytes", static_cast<double>(accesses.held_bytes)},
                                            {"used_bytes", static_cast<double>(accesses.used_bytes)},
                                            {"counted_groups", static_cast<double>(accesses.groups)},
                                            {"most_reads_of_a_query", static_cast<double>(accesses.most_reads)},
                                            {"longest_chain", static_cast<double>(accesses.longest_chain)}};
    const auto add = [&](const char* name, uint64_t of, uint64_t all) {
        if (all > 0) counts[name] = static_cast<double>(of) / static_cast<double>(all);
    };
    add("reads_per_query", accesses.reads, accesses.queries);
    add("chain_per_query", accesses.chained_reads, accesses.queries);
    add("bytes_per_query", accesses.bytes, accesses.queries);
    add("sectors_per_query", accesses.sectors, accesses.queries);
    add("lines_per_query", accesses.lines, accesses.queries);
    add("sectors_per_request", accesses.request_sectors, accesses.requests);
    add("useful_share", accesses.distinct_bytes, 32 * accesses.sectors);
    add("lane_activity", accesses.visits, 32 * accesses.turns);
    return counts;
}

TexelGrid texel_grid(const std::vector<uint32_t>& ranges, uint32_t width) {
    TexelGrid grid;
    if (ranges.empty() || width == 0) return grid;
    const auto height = static_cast<uint32_t>(ranges.size() / width);
    const uint32_t side = (std::max(width, height) + TexelGrid::kMost - 1) / TexelGrid::kMost;
    grid.width = (width + side - 1) / side;
    grid.height = (height + side - 1) / side;
    grid.ranges.resize(uint64_t{grid.width} * grid.height);
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x)
            grid.ranges[uint64_t{y / side} * grid.width + x / side] += ranges[uint64_t{y} * width + x];
    }
    return grid;
}

void count_case(Renderer& renderer, const LoadedScene& scene, const std::vector<Pose>& poses, const RenderSettings& settings,
                const Frame& timed, bool texels, BenchCase& counted) {
    counted.counts = counts_of(timed.stats);
    const auto pages = timed.effective.find("pages");
    const bool asked = pages != timed.effective.end() && pages->second == "asked";

    RenderSettings counting = settings;
    counting.count_ranges = true;
    counting.keep_list_lengths = !asked;
    Frame frame = renderer.render(scene, poses, counting);
    add_tests(frame.stats, counted.counts);
    if (asked) {  // The lists of all pages.
        counting.count_ranges = false;
        counting.keep_list_lengths = true;
        counting.pages = "all";
        renderer.render(scene, poses, counting, frame);
    }
    counted.lengths = frame.list_lengths;
    if (const auto accesses = count_accesses(renderer, scene, poses, settings, frame))
        counted.counts.merge(counts_of(*accesses));
    if (!texels) return;
    counting = settings;
    counting.keep_texel_ranges = true;
    renderer.render(scene, poses, counting, frame);
    if (!frame.texel_ranges.empty()) counted.texels = texel_grid(frame.texel_ranges.front(), settings.shadow_res);
}

}  // namespace gnomon::cli
