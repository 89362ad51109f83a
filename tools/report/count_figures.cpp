// SPDX-License-Identifier: Apache-2.0
// What a query reads.
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "html/html.hpp"
#include "html/svg.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {
namespace {

using namespace html;

constexpr double kWidth = 480.0, kTop = 30.0, kRow = 24.0, kBar = 14.0, kMostName = 140.0, kValue = 52.0, kGap = 10.0;

struct Count {
    const char* member;
    const char* title;
    const char* meaning;
};
/// By what they say of memory: the first that were counted are shown.
constexpr Count kCounts[] = {
    {"sectors_per_query", "sectors", "distinct 32-byte sectors that 32 neighbouring queries read, shared out among them"},
    {"lines_per_query", "lines", "128-byte lines likewise"},
    {"bytes_per_query", "bytes", "bytes that are read, each time they are"},
    {"ranges_visited_per_query", "ranges", "ranges visited"},
    {"triangles_tested_per_query", "tests", "triangles tested"}};
constexpr size_t kMostColumns = 3;

bool has(const std::vector<const Case*>& cases, const Count& count) {
    return std::any_of(cases.begin(), cases.end(), [&](const Case* c) { return c->count(count.member).has_value(); });
}

std::vector<Count> shown_counts(const std::vector<const Case*>& cases) {
    std::vector<Count> counts;
    for (const Count& count : kCounts)
        if (counts.size() < kMostColumns && has(cases, count)) counts.push_back(count);
    return counts;
}

/// A column of bars for each count, each on a scale of its own.
Plot count_plot(const Sources& sources, const std::vector<const Case*>& cases, const std::string& title) {
    double names = 0.0;
    for (const Case* c : cases) names = std::max(names, text_width(c->layout));
    names = std::min(names, kMostName) + 16.0;
    const std::vector<Count> counts = shown_counts(cases);
    const double column = (kWidth - names) / static_cast<double>(counts.size()), bars = column - kValue - kGap;
    const double bottom = kTop + kRow * static_cast<double>(cases.size());

    std::string content;
    for (size_t i = 0; i < cases.size(); ++i)
        content += label("name left", names - 8.0, kTop + kRow * (static_cast<double>(i) + 0.5) + 4.0,
                         shortened(cases[i]->layout, kMostName));
    double left = names;
    for (const Count& count : counts) {
        double most = 0.0;
        for (const Case* c : cases) most = std::max(most, c->count(count.member).value_or(0.0));
        content += label("title", left, 18.0, count.title) + line("axis", left, kTop, left, bottom);
        for (size_t i = 0; i < cases.size(); ++i) {
            const std::optional<double> value = cases[i]->count(count.member);
            const double middle = kTop + kRow * (static_cast<double>(i) + 0.5),
                         length = value && most > 0.0 ? bars * *value / most : 0.0;
            content += rectangle("part " + colour_class(sources.colour_of(cases[i]->layout)), left, middle - 0.5 * kBar, length,
                                 kBar, "");
            content += label("value", left + length + 4.0, middle + 4.0, value ? shown(*value) : "–");
        }
        left += column;
    }
    return {"counts", title, kWidth, bottom + 10.0, content};
}

std::string caption_of(const std::vector<const Case*>& cases) {
    const std::vector<Count> counts = shown_counts(cases);
    std::string caption, meanings;
    for (const Count& count : counts) {
        meanings += fmt::format("{} {}: {}", meanings.empty() ? "" : ";", count.title, count.meaning);
        const Case *least = nullptr, *most = nullptr;
        for (const Case* c : cases) {
            const std::optional<double> value = c->count(count.member);
            if (!value || answers_less(*c)) continue;
            if (least == nullptr || *value < *least->count(count.member)) least = c;
            if (most == nullptr || *value > *most->count(count.member)) most = c;
        }
        if (least != nullptr && caption.empty())
            caption = fmt::format("A query of {} has the fewest {}, {}, of {} the most, {}.", least->layout, count.title,
                                  shown(*least->count(count.member)), most->layout, shown(*most->count(count.member)));
    }
    return caption + " Counted, not timed:" + meanings + ".";
}

}  // namespace

std::vector<Figure> count_figures(const Sources& sources) {
    std::vector<Figure> figures;
    for (const BenchFile& file : sources.files()) {
        for (const Setting& setting : settings_of(file)) {
            std::vector<const Case*> cases = setting.cases;
            std::erase_if(cases, [](const Case* c) {
                return c->again || std::none_of(std::begin(kCounts), std::end(kCounts),
                                                [&](const Count& count) { return c->count(count.member); });
            });
            if (cases.empty()) continue;
            figures.push_back({sources.name(file, "counts", setting.title()),
                               count_plot(sources, cases, sources.title(file, setting.title())), caption_of(cases),
                               setting.is_first});
        }
    }
    return figures;
}

}  // namespace gnomon::report
