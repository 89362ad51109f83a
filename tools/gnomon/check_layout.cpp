// SPDX-License-Identifier: Apache-2.0
#include "check_layout.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <gnomon/error.hpp>
#include <optional>
#include <span>

#include "check_scene.hpp"
#include "layouts/layout.hpp"
#include "methods/method.hpp"

namespace gnomon::cli {

namespace {

using Ranges = std::span<const TexelRange>;

/// Of the shutter: nobody asks for other times.
bool contains(const TexelRange& outer, const TexelRange& inner) {
    return outer.triangle == inner.triangle && outer.enter <= std::max(inner.enter, 0.0f) &&
           outer.leave >= std::min(inner.leave, 1.0f) && outer.depth <= inner.depth;
}

/// The first of `these` whose like is not among `those`.
std::optional<TexelRange> missing(Ranges these, Ranges those,
                                  const std::function<bool(const TexelRange&, const TexelRange&)>& like) {
    const auto by_triangle = [](const TexelRange& a, const TexelRange& b) { return a.triangle < b.triangle; };
    std::vector<TexelRange> sorted(those.begin(), those.end());
    std::sort(sorted.begin(), sorted.end(), by_triangle);
    for (const TexelRange& range : these) {
        const auto [begin, end] = std::equal_range(sorted.begin(), sorted.end(), range, by_triangle);
        if (std::none_of(begin, end, [&](const TexelRange& other) { return like(other, range); })) return range;
    }
    return std::nullopt;
}

std::string range_text(const TexelRange& r) {
    return fmt::format("triangle {} from {:.9g} to {:.9g} at {:.9g} m", r.triangle, r.enter, r.leave, r.depth);
}

/// The same triangle's range among these that is not among those, if there is one: what may have become of another.
std::string instead(Ranges these, Ranges those, const TexelRange& range) {
    for (const TexelRange& other : these) {
        const bool known = std::find(those.begin(), those.end(), other) != those.end();
        if (other.triangle == range.triangle && !known) return ", instead of " + range_text(other);
    }
    return "";
}

/// What is wrong with the ranges of a texel; nothing, if they are as the layout says.
std::string compare_texel(const Layout& layout, Ranges found, Ranges exact) {
    const auto same = [](const TexelRange& a, const TexelRange& b) { return a == b; };
    const auto within = [](const TexelRange& a, const TexelRange& b) { return contains(b, a); };
    const std::string count = fmt::format("{} of {} ranges", found.size(), exact.size());
    if (layout.lossless && std::equal(found.begin(), found.end(), exact.begin(), exact.end())) return "";
    if (!layout.only_contains()) {
        if (const auto other = missing(found, exact, same))
            return count + "; there is none of " + range_text(*other) + instead(exact, found, *other);
        if (!layout.lossless) return "";
        if (const auto lost = missing(exact, found, same)) return count + "; lost is " + range_text(*lost);
        return count + ", some of them twice";
    }
    if (const auto lost = missing(exact, found, contains)) return count + "; not contained is " + range_text(*lost);
    if (const auto other = missing(found, exact, within)) return count + "; contains none: " + range_text(*other);
    return "";
}

Ranges texel_of(Ranges ranges) {
    const auto other = [&](const TexelRange& r) { return r.texel != ranges.front().texel; };
    return ranges.first(static_cast<size_t>(std::find_if(ranges.begin(), ranges.end(), other) - ranges.begin()));
}

/// What is wrong with the ranges of a light.
std::string compare_light(const Layout& layout, const LightRanges& found, const LightRanges& exact) {
    Ranges a = found.ranges, b = exact.ranges;
    while (!a.empty() || !b.empty()) {
        const uint32_t texel = std::min(a.empty() ? ~0u : a.front().texel, b.empty() ? ~0u : b.front().texel);
        const Ranges of_a = a.empty() || a.front().texel != texel ? Ranges() : texel_of(a);
        const Ranges of_b = b.empty() || b.front().texel != texel ? Ranges() : texel_of(b);
        const std::string wrong = compare_texel(layout, of_a, of_b);
        if (!wrong.empty()) return fmt::format("texel {},{}: {}", texel % exact.width, texel / exact.width, wrong);
        a = a.subspan(of_a.size());
        b = b.subspan(of_b.size());
    }
    return "";
}

std::string fault_text(const LayoutFault& fault) {
    if (fault.buffer.empty()) return fmt::format("{} walks do not end, one of list {}", fault.count, fault.element);
    return fmt::format("{} accesses beyond the end of buffer '{}', one of element {}", fault.count, fault.buffer,
                       fault.element);
}

/// What is wrong with a frame; nothing, if it is as the layout says.
std::string compare_frames(const Layout& layout, const Frame& frame, const Frame& exact) {
    if (!frame.layout_faults.empty()) return fault_text(frame.layout_faults.front());
    uint64_t lost = 0;
    for (size_t i = 0; i < exact.light_ranges.size(); ++i) {
        const LightRanges &found = frame.light_ranges[i], &all = exact.light_ranges[i];
        const std::string wrong = compare_light(layout, found, all);
        if (!wrong.empty()) return fmt::format("light {}, {}", i, wrong);
        lost += all.ranges.size() - found.ranges.size();
    }
    if (!layout.lossless && !layout.only_contains()) {
        const uint64_t counted = frame.stats.lost_ranges();
        const bool all_known = !exact.light_ranges.empty();
        return !all_known || counted == lost ? "" : fmt::format("{} ranges are lost, and {} counted", lost, counted);
    }
    for (size_t c = 0; c < exact.channels.size(); ++c) {
        const std::vector<float>&a = frame.channels[c].values, &b = exact.channels[c].values;
        const auto [at, expected] = std::mismatch(a.begin(), a.end(), b.begin());
        if (at == a.end()) continue;
        const auto pixel = static_cast<uint32_t>(at - a.begin());
        return fmt::format("pixel {},{}: {} is {:.6g}, and with array {:.6g}", pixel % frame.width, pixel / frame.width,
                           exact.channels[c].name, *at, *expected);
    }
    return "";
}

struct Trial {
    std::string name;
    std::string method = "exact";
    std::vector<LightKind> lights = {LightKind::directional};
    uint32_t segments = 1;
    std::string pages = "all";
    uint32_t share = 1;  ///< Of the S-buffer's memory, one such.
};

std::vector<Trial> trials(const Layout& layout) {
    using enum LightKind;
    const std::vector<LightKind> all = {directional, spot, point};
    std::vector<Trial> result = {{.name = "exact, sun"},
                                 {.name = "exact, spot, three segments", .lights = {spot}, .segments = 3},
                                 {.name = "exact, point", .lights = {point}},
                                 {.name = "exact, three lights", .lights = all},
                                 {.name = "exact, half the memory", .share = 2},
                                 {.name = "exact, a third of the memory", .share = 3},
                                 {.name = "exact, pages", .lights = {spot}, .pages = "asked"}};
    if (layout.only_contains()) return result;
    for (const Method& method : methods()) {
        if (!method.has_s_buffer() || method.name == "exact") continue;
        result.push_back({.name = method.name + ", sun", .method = method.name});
        result.push_back(
            {.name = method.name + ", spot, half the memory", .method = method.name, .lights = {spot}, .share = 2});
    }
    return result;
}

/// Reading ranges back takes some memory of its own.
constexpr uint64_t kReading = uint64_t{8} << 20;

uint64_t s_buffer_bytes(const FrameStats& stats) {
    uint64_t bytes = 0;
    for (const auto& [name, count] : stats.buffer_bytes) bytes += name.starts_with("s_buffer.") ? count : 0;
    return bytes;
}

/// How many there are, and the most of a texel.
std::string counts_text(const Frame& frame) {
    uint64_t ranges = 0, longest = 0;
    for (const LightRanges& light : frame.light_ranges) {
        ranges += light.ranges.size();
        for (Ranges rest = light.ranges; !rest.empty();) {
            const size_t count = texel_of(rest).size();
            longest = std::max<uint64_t>(longest, count);
            rest = rest.subspan(count);
        }
    }
    return frame.light_ranges.empty() ? "the picture" : fmt::format("{} ranges, {} in a texel at most", ranges, longest);
}

uint64_t fills(const FrameStats& stats) {
    uint64_t dispatches = 0;
    for (const FrameStats::Stage& stage : stats.stages) dispatches += stage.name == "raster/fill" ? stage.dispatches : 0;
    return dispatches;
}

LayoutCheck run(Renderer& renderer, const Layout& layout, const std::string& name_or_folder, const Trial& trial) {
    const bool banded = trial.share > 1;
    CheckScene check(trial.lights, trial.segments, !banded);
    RenderSettings& settings = check.settings;
    settings.method = trial.method;
    settings.pages = trial.pages;
    settings.keep_ranges = trial.pages == "all";
    settings.layout = "array";
    const Frame exact = renderer.render(check.scene, check.poses, settings);
    settings.layout = name_or_folder;
    settings.check_layout = true;
    std::string cut;
    try {
        Frame frame = renderer.render(check.scene, check.poses, settings);
        if (banded) {
            const uint64_t whole = fills(frame.stats), held = s_buffer_bytes(frame.stats);
            settings.memory_budget = frame.stats.peak_bytes - held + held / trial.share + kReading;
            frame = renderer.render(check.scene, check.poses, settings);
            cut = fmt::format(", filled in {} parts for {}", fills(frame.stats), whole);
        }
        const std::string wrong = compare_frames(layout, frame, exact);
        if (!wrong.empty()) return {trial.name, false, wrong};
    } catch (const Error& error) {
        // Ranges where there can be none.
        if (error.kind() == ErrorKind::internal) return {trial.name, false, error.what()};
        // Only who says so may need all of it.
        if (error.kind() != ErrorKind::out_of_memory || !banded) throw;
        return {trial.name, !layout.bands, error.what()};
    }
    return {trial.name, true, counts_text(exact) + cut};
}

}  // namespace

void check_layout(Renderer& renderer, const std::string& name_or_folder, const std::function<bool(const LayoutCheck&)>& done) {
    const Layout layout = find_layout(name_or_folder);
    for (const Trial& trial : trials(layout)) {
        if (!done(run(renderer, layout, name_or_folder, trial))) return;
    }
}

}  // namespace gnomon::cli
