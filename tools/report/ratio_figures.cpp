// SPDX-License-Identifier: Apache-2.0
// Ratios to the baseline, with their intervals.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "html/html.hpp"
#include "html/scale.hpp"
#include "html/svg.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {
namespace {

using namespace html;

constexpr double kWidth = 480.0, kTop = 10.0, kRow = 24.0, kBottom = 50.0, kValues = 118.0, kMostName = 150.0;
using timing::kSame;

// Blue and orange, which all tell apart; what is undecided is open.
std::string mark(const Comparison& c, const Scale& x, double y) {
    const size_t colour = c.verdict == Verdict::faster ? 0 : c.verdict == Verdict::slower ? 1 : 7;
    std::string content;
    if (c.low && c.high) content += line("curve", x.at(*c.low), y, x.at(*c.high), y);
    content += element(
        "circle",
        {{"class", c.verdict == Verdict::undecided ? "open" : "fill"}, {"cx", at(x.at(c.ratio))}, {"cy", at(y)}, {"r", "4"}},
        "");
    return element("g", {{"class", colour_class(colour)}}, content);
}

std::string caption_of(const BenchFile& file, const std::vector<const Comparison*>& rows, const Comparison* null,
                       const std::string& stage) {
    size_t verdicts[4] = {};
    std::string again;
    for (const Comparison* c : rows) {
        if (!file.cases[c->of].again) {
            ++verdicts[static_cast<size_t>(c->verdict)];
            continue;
        }
        again = fmt::format(" The baseline measured again is at {:.3f}", c->ratio);
        again += c->low && c->high ? fmt::format(" ({:.3f} to {:.3f}).", *c->low, *c->high) : ".";
    }
    const auto count = [&](Verdict verdict) { return verdicts[static_cast<size_t>(verdict)]; };
    return fmt::format(
               "Against {}, the {} of {} layouts is faster, of {} slower, of {} the same and of {} undecided; to the left is "
               "faster. Lines: 95 % "
               "intervals of the median of paired ratios; grey: within 2 %, which counts as the same.",
               file.baseline, stage, count(Verdict::faster), count(Verdict::slower), count(Verdict::same),
               count(Verdict::undecided)) +
           again + (null != nullptr ? fmt::format(" The null layout, the floor, is at {:.3f}.", null->ratio) : "");
}

Plot ratio_plot(const BenchFile& file, const std::vector<const Comparison*>& rows, const std::string& title) {
    double least = kSame.low, most = kSame.high, names = 0.0;
    for (const Comparison* c : rows) {
        for (const double value : {c->ratio, c->low.value_or(c->ratio), c->high.value_or(c->ratio)}) {
            if (value > 0.0) least = std::min(least, value);
            most = std::max(most, value);
        }
        names = std::max(names, text_width(file.cases[c->of].row_name()));
    }
    const double left = std::min(names, kMostName) + 16.0, bottom = kTop + kRow * static_cast<double>(rows.size());
    const Scale x = Scale::logarithmic(least, most, left, kWidth - kValues);
    std::string content = rectangle("zone", x.at(kSame.low), kTop, x.at(kSame.high) - x.at(kSame.low), bottom - kTop, "");
    for (const double tick : x.ticks()) {
        content += line("grid", x.at(tick), kTop, x.at(tick), bottom);
        content += label("tick below", x.at(tick), bottom + 18.0, tick_text(tick));
    }
    content += line("axis", x.at(1.0), kTop, x.at(1.0), bottom);
    content += label("title below", 0.5 * (left + kWidth - kValues), bottom + 38.0,
                     "times of " + shortened(file.baseline, 100.0) + ", logarithmic");
    for (size_t i = 0; i < rows.size(); ++i) {
        const Comparison& c = *rows[i];
        const double y = kTop + kRow * (static_cast<double>(i) + 0.5);
        content += label("name left", left - 8.0, y + 4.0, shortened(file.cases[c.of].row_name(), kMostName));
        content += mark(c, x, y);
        content += label("value", kWidth - kValues + 10.0, y + 4.0, fmt::format("{:.3f} {}", c.ratio, to_string(c.verdict)));
    }
    return {"ratios", title, kWidth, bottom + kBottom, content};
}

}  // namespace

std::vector<Figure> ratio_figures(const Sources& sources, const std::string& stage) {
    std::vector<Figure> figures;
    for (const BenchFile& file : sources.files()) {
        for (const Setting& setting : settings_of(file)) {
            std::vector<const Comparison*> rows;
            const Comparison* null = nullptr;
            for (const Comparison& c : file.comparisons) {
                const Case& of = file.cases[c.of];
                if (c.stage != stage || of.scene != setting.scene || of.values != setting.values) continue;
                // A floor, far from all others: it would leave them no room.
                if (of.layout == kNullLayout)
                    null = &c;
                else
                    rows.push_back(&c);
            }
            if (rows.empty()) continue;
            // The A/A row first: what is no further from 1 than this is noise.
            std::stable_sort(rows.begin(), rows.end(), [&](const Comparison* a, const Comparison* b) {
                const auto key = [&](const Comparison* c) { return std::pair(!file.cases[c->of].again, c->ratio); };
                return key(a) < key(b);
            });
            const std::string title = sources.title(file, fmt::format("{}, {}", setting.title(), stage));
            figures.push_back({sources.name(file, "ratios-" + stage, setting.title()), ratio_plot(file, rows, title),
                               caption_of(file, rows, null, stage), setting.is_first});
        }
    }
    return figures;
}

}  // namespace gnomon::report
