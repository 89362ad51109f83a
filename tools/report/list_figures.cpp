// SPDX-License-Identifier: Apache-2.0
// How long lists are, and how many ranges each texel has.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "html/html.hpp"
#include "html/image.hpp"
#include "html/scale.hpp"
#include "html/svg.hpp"
#include "io/heatmap.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {
namespace {

using namespace html;

constexpr double kWidth = 480.0;

/// Layouts that have the same of something: most have, since all keep the same ranges.
template <class Value>
struct Same {
    Value value;
    std::vector<std::string> layouts;
};

template <class Value, class ValueOf>
std::vector<Same<Value>> grouped(const Setting& setting, ValueOf value_of) {
    std::vector<Same<Value>> groups;
    for (const Case* c : setting.cases) {
        const Value* value = value_of(*c);
        if (c->again || value == nullptr) continue;
        const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.value == *value; });
        if (found == groups.end())
            groups.push_back({*value, {c->layout}});
        else
            found->layouts.push_back(c->layout);
    }
    return groups;
}

std::string whose(const std::vector<std::string>& layouts) {
    if (layouts.size() == 1) return "of layout " + layouts[0];
    constexpr size_t kNamed = 8;
    std::string text = "the same of layouts ";
    for (size_t i = 0; i < std::min(layouts.size(), kNamed); ++i) text += (i == 0 ? "" : ", ") + layouts[i];
    return layouts.size() > kNamed ? text + fmt::format(" and {} more", layouts.size() - kNamed) : text;
}

std::string short_name(const std::vector<std::string>& layouts) {
    return layouts.size() > 1 ? layouts[0] + " and others" : layouts[0];
}

std::string bin_text(const Lengths& bin) {
    return bin.from == bin.to ? shown(static_cast<double>(bin.from))
                              : shown(static_cast<double>(bin.from)) + " to " + shown(static_cast<double>(bin.to));
}

Plot length_plot(const std::vector<Lengths>& lengths, const std::string& title, bool& logarithmic) {
    constexpr double kHeight = 260.0, kLeft = 84.0, kRight = 12.0, kTop = 24.0, kBottom = 48.0;
    double least = 0.0, most = 1.0;
    for (const Lengths& bin : lengths) {
        const auto lists = static_cast<double>(bin.lists);
        if (lists > 0.0) least = least > 0.0 ? std::min(least, lists) : lists;
        most = std::max(most, lists);
    }
    logarithmic = most > 40.0 * least && least > 0.0;
    const double bottom = kHeight - kBottom;
    // Bars stand on half a list, so that one list is seen.
    const Scale y = logarithmic ? Scale::logarithmic(0.5, most, bottom, kTop) : Scale::linear(most, bottom, kTop);
    const double step = (kWidth - kLeft - kRight) / static_cast<double>(lengths.size()), gap = std::min(3.0, 0.2 * step);

    std::string content;
    for (const double tick : y.ticks()) {
        if (tick > 0.0) content += line("grid", kLeft, y.at(tick), kWidth - kRight, y.at(tick));
        content += label("tick left", kLeft - 8.0, y.at(tick) + 4.0, shown(tick));
    }
    double free_from = 0.0;
    for (size_t i = 0; i < lengths.size(); ++i) {
        const Lengths& bin = lengths[i];
        const double left = kLeft + step * static_cast<double>(i),
                     top = bin.lists > 0 ? y.at(static_cast<double>(bin.lists)) : bottom;
        content += rectangle("part c0", left + gap, top, step - 2.0 * gap, bottom - top,
                             fmt::format("{} ranges: {} lists", bin_text(bin), shown(static_cast<double>(bin.lists))));
        const std::string text = shown(static_cast<double>(bin.from));
        const double middle = left + 0.5 * step, half = 0.5 * text_width(text);
        if (middle - half < free_from) continue;
        content += label("tick below", middle, bottom + 18.0, text);
        free_from = middle + half + 6.0;
    }
    content += line("axis", kLeft, bottom, kWidth - kRight, bottom);
    content += label("title below", 0.5 * (kLeft + kWidth - kRight), kHeight - 8.0, "ranges in a list, from this many on");
    content += label_upward("title below", 12.0, 0.5 * (kTop + bottom), logarithmic ? "lists, logarithmic" : "lists");
    return {"lengths", title, kWidth, kHeight, content};
}

std::string length_caption(const Same<std::vector<Lengths>>& group, bool logarithmic) {
    double lists = 0.0, empty = 0.0;
    const Lengths* longest = nullptr;
    for (const Lengths& bin : group.value) {
        lists += static_cast<double>(bin.lists);
        if (bin.to == 0) empty += static_cast<double>(bin.lists);
        if (bin.lists > 0) longest = &bin;
    }
    return fmt::format("Of {} lists {:.0f} % are empty, and the longest have {} ranges; {}.{}", shown(lists),
                       lists > 0.0 ? 100.0 * empty / lists : 0.0, longest != nullptr ? bin_text(*longest) : "no",
                       whose(group.layouts), logarithmic ? " The scale of lists is logarithmic." : "");
}

double share_of(uint32_t count, uint32_t most) { return most > 1 ? std::log(count) / std::log(most) : 1.0; }

/// The colours of io::heatmap, in a plot that grows with the page.
Plot texel_plot(const Texels& texels, uint32_t most, const std::string& title) {
    constexpr double kMargin = 8.0, kMostHeight = 464.0, kScale = 200.0;
    std::vector<uint8_t> rgb;
    rgb.reserve(texels.ranges.size() * 3);
    for (const uint32_t count : texels.ranges) {
        const auto colour = count == 0 ? std::array<uint8_t, 3>{} : io::viridis(share_of(count, most));
        rgb.insert(rgb.end(), colour.begin(), colour.end());
    }
    const double fit = std::min((kWidth - 2.0 * kMargin) / texels.width, kMostHeight / texels.height);
    const double width = fit * texels.width, height = fit * texels.height, below = height + kMargin + 14.0;
    std::string content = empty_element("image", {{"x", at(kMargin)},
                                                  {"y", at(kMargin)},
                                                  {"width", at(width)},
                                                  {"height", at(height)},
                                                  {"preserveAspectRatio", "none"},
                                                  {"style", "image-rendering: pixelated"},
                                                  {"href", png_address(texels.width, texels.height, rgb)}});
    content.insert(content.size() - 1, "/");
    content += element("rect", {{"x", at(kMargin)}, {"y", at(below)}, {"width", "14"}, {"height", "14"}, {"fill", "#000"}}, "");
    content += label("tick", kMargin + 20.0, below + 11.0, "none");
    const double left = kMargin + 64.0;
    constexpr int kSteps = 50;
    for (int i = 0; i < kSteps && most > 0; ++i) {
        const auto colour = io::viridis((i + 0.5) / kSteps);
        content += element("rect",
                           {{"x", at(left + kScale * i / kSteps)},
                            {"y", at(below)},
                            {"width", at(kScale / kSteps + 0.5)},
                            {"height", "14"},
                            {"fill", fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2])}},
                           "");
    }
    content += label("tick", left, below + 30.0, "1");
    if (most > 3) content += label("tick below", left + 0.5 * kScale, below + 30.0, shown(std::round(std::sqrt(most))));
    content += label("tick left", left + kScale, below + 30.0, shown(most));
    content += label("title", left + kScale + 12.0, below + 11.0, "ranges per texel, logarithmic");
    return {"texels", title, kWidth, below + 38.0, content};
}

}  // namespace

std::vector<Figure> length_figures(const Sources& sources) {
    std::vector<Figure> figures;
    for (const BenchFile& file : sources.files()) {
        for (const Setting& setting : settings_of(file)) {
            const auto groups =
                grouped<std::vector<Lengths>>(setting, [](const Case& c) { return c.lengths.empty() ? nullptr : &c.lengths; });
            for (const auto& group : groups) {
                const std::string what =
                    groups.size() > 1 ? setting.title() + ", " + short_name(group.layouts) : setting.title();
                bool logarithmic = false;
                const Plot plot = length_plot(group.value, sources.title(file, what), logarithmic);
                figures.push_back(
                    {sources.name(file, "lengths", what), plot, length_caption(group, logarithmic), setting.is_first});
            }
        }
    }
    return figures;
}

std::vector<Figure> texel_figures(const Sources& sources) {
    std::vector<Figure> figures;
    for (const BenchFile& file : sources.files()) {
        for (const Setting& setting : settings_of(file)) {
            const auto groups = grouped<Texels>(setting, [](const Case& c) { return c.texels ? &*c.texels : nullptr; });
            for (const auto& group : groups) {
                const std::string what =
                    groups.size() > 1 ? setting.title() + ", " + short_name(group.layouts) : setting.title();
                const std::vector<uint32_t>& ranges = group.value.ranges;
                const uint32_t most = *std::max_element(ranges.begin(), ranges.end());
                const double sum = std::accumulate(ranges.begin(), ranges.end(), 0.0);
                figures.push_back(
                    {sources.name(file, "texels", what), texel_plot(group.value, most, sources.title(file, what)),
                     fmt::format("The light's view, brought down to {}x{}: {} ranges per texel in the mean and {} at most; {}.",
                                 group.value.width, group.value.height, shown(sum / static_cast<double>(ranges.size())),
                                 shown(most), whose(group.layouts)),
                     setting.is_first});
            }
        }
    }
    return figures;
}

}  // namespace gnomon::report
