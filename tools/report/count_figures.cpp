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
};
constexpr Count kCounts[] = {{"sectors_per_query", "sectors"}, {"lines_per_query", "lines"}, {"bytes_per_query", "bytes"}};

bool has(const std::vector<const Case*>& cases, const Count& count) {
    return std::any_of(cases.begin(), cases.end(), [&](const Case* c) { return c->count(count.member).has_value(); });
}

/// A column of bars for each count, each on a scale of its own.
Plot count_plot(const Sources& sources, const std::vector<const Case*>& cases, const std::string& title) {
    double names = 0.0;
    for (const Case* c : cases) names = std::max(names, text_width(c->layout));
    names = std::min(names, kMostName) + 16.0;
    const auto columns = static_cast<double>(
        std::count_if(std::begin(kCounts), std::end(kCounts), [&](const Count& c) { return has(cases, c); }));
    const double column = (kWidth - names) / columns, bars = column - kValue - kGap;
    const double bottom = kTop + kRow * static_cast<double>(cases.size());

    std::string content;
    for (size_t i = 0; i < cases.size(); ++i)
        content += label("name left", names - 8.0, kTop + kRow * (static_cast<double>(i) + 0.5) + 4.0,
                         shortened(cases[i]->layout, kMostName));
    double left = names;
    for (const Count& count : kCounts) {
        if (!has(cases, count)) continue;
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
    for (const Count& count : kCounts) {
        const Case *least = nullptr, *most = nullptr;
        for (const Case* c : cases) {
            const std::optional<double> value = c->count(count.member);
            if (!value || answers_less(*c)) continue;
            if (least == nullptr || *value < *least->count(count.member)) least = c;
            if (most == nullptr || *value > *most->count(count.member)) most = c;
        }
        if (least == nullptr) continue;
        return fmt::format(
            "A query of {} reads the fewest {}, {}, of {} the most, {}. Counted by the accessors, for the queries of a "
            "subgroup "
            "together: distinct 32-byte sectors, distinct 128-byte lines, and bytes asked for.",
            least->layout, count.title, shown(*least->count(count.member)), most->layout, shown(*most->count(count.member)));
    }
    return "Distinct 32-byte sectors, distinct 128-byte lines, and bytes asked for, of the queries of a subgroup.";
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
