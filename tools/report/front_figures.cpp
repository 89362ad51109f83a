// SPDX-License-Identifier: Apache-2.0
// Bytes against query time.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "html/html.hpp"
#include "html/scale.hpp"
#include "html/svg.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {
namespace {

using namespace html;

constexpr double kWidth = 480.0, kHeight = 340.0, kLeft = 64.0, kRight = 16.0, kTop = 14.0, kBottom = 48.0;
constexpr double kMebibyte = 1024.0 * 1024.0;

struct Point {
    const Case* of = nullptr;
    double x = 0.0, y = 0.0;  // Pixels.
    bool on_front = false;
};

struct Box {
    double left, top, right, bottom;

    bool meets(const Box& o) const { return left < o.right && o.left < right && top < o.bottom && o.top < bottom; }
};

/// Names beside their points where there is room: those on the front choose first. What is left is told by its mark.
std::string names_of(const std::vector<Point>& points) {
    std::vector<Box> taken;
    for (const Point& p : points) taken.push_back({p.x - 5.0, p.y - 5.0, p.x + 5.0, p.y + 5.0});
    std::vector<const Point*> order;
    for (const Point& p : points) order.push_back(&p);
    std::stable_sort(order.begin(), order.end(), [](const Point* a, const Point* b) { return a->on_front > b->on_front; });
    std::string content;
    for (const Point* p : order) {
        const std::string name = shortened(p->of->layout, 130.0);
        const double wide = text_width(name);
        // Of one on the front the steps leave to the right.
        const Box right = {p->x + 7.0, p->y - 7.0, p->x + 7.0 + wide, p->y + 7.0},
                  upper = {p->x + 4.0, p->y - 19.0, p->x + 4.0 + wide, p->y - 5.0};
        const Box places[] = {p->on_front ? upper : right,
                              p->on_front ? right : upper,
                              {p->x - 7.0 - wide, p->y - 7.0, p->x - 7.0, p->y + 7.0},
                              {p->x - 0.5 * wide, p->y - 20.0, p->x + 0.5 * wide, p->y - 6.0},
                              {p->x - 0.5 * wide, p->y + 6.0, p->x + 0.5 * wide, p->y + 20.0},
                              {p->x + 4.0, p->y + 5.0, p->x + 4.0 + wide, p->y + 19.0}};
        for (const Box& box : places) {
            const bool is_inside =
                box.left > kLeft && box.right < kWidth - 4.0 && box.top > 2.0 && box.bottom < kHeight - kBottom;
            if (!is_inside || std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return box.meets(other); }))
                continue;
            content += label("name halo", box.left, box.bottom - 3.0, name);
            taken.push_back(box);
            break;
        }
    }
    return content;
}

/// Steps: at so many bytes nothing on it is faster.
std::string front_line(std::vector<Point> points) {
    std::erase_if(points, [](const Point& p) { return !p.on_front; });
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return std::pair(a.x, -a.y) < std::pair(b.x, -b.y); });
    std::string path;
    for (const Point& p : points)
        path += path.empty() ? fmt::format("M{:.1f} {:.1f}", p.x, p.y) : fmt::format("H{:.1f}V{:.1f}", p.x, p.y);
    if (points.empty()) return "";
    path += fmt::format("H{:.1f}", kWidth - kRight);
    return element("g", {{"class", "c7"}}, element("path", {{"class", "curve"}, {"d", path}}, ""));
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

/// Milliseconds for each byte, of the case that copies most.
std::optional<double> copy_rate(const std::vector<const Case*>& cases) {
    const Case* most = nullptr;
    for (const Case* c : cases)
        if (c->copy_ms && (most == nullptr || *c->count("map_bytes") > *most->count("map_bytes"))) most = c;
    const double bytes = most != nullptr ? *most->count("map_bytes") : 0.0;
    return bytes > 0.0 && *most->copy_ms > 0.0 ? std::optional(*most->copy_ms / bytes) : std::nullopt;
}

Figure front_figure(const Sources& sources, const Setting& setting, const std::vector<const Case*>& cases) {
    double least_bytes = std::numeric_limits<double>::infinity(), most_bytes = 0.0, least_ms = least_bytes, most_ms = 0.0;
    std::optional<double> null_ms;
    for (const Case* c : cases) {
        const double bytes = *c->count("map_bytes") / kMebibyte, ms = c->stage("query")->median;
        if (c->layout == kNullLayout) {
            null_ms = ms;
            continue;
        }
        least_bytes = std::min(least_bytes, bytes);
        most_bytes = std::max(most_bytes, bytes);
        least_ms = std::min(least_ms, ms);
        most_ms = std::max(most_ms, ms);
    }
    const double fastest = least_ms;
    const auto drawn = [&](std::optional<double> floor) {
        return floor && *floor * kFloorWithin >= fastest ? floor : std::nullopt;
    };
    const std::optional<double> rate = copy_rate(cases), null_line = drawn(null_ms);
    const std::optional<double> copy_line = rate ? drawn(*rate * kMebibyte * most_bytes) : std::nullopt;
    if (null_line) least_ms = std::min(least_ms, *null_line);
    if (copy_line) least_ms = std::min(least_ms, std::max(*copy_line * 0.5, *rate * kMebibyte * least_bytes));
    const Scale x = Scale::logarithmic(least_bytes, most_bytes, kLeft, kWidth - kRight),
                y = Scale::logarithmic(least_ms, most_ms, kHeight - kBottom, kTop);

    std::string content;
    for (const double tick : y.ticks()) {
        content += line("grid", kLeft, y.at(tick), kWidth - kRight, y.at(tick));
        content += label("tick left", kLeft - 8.0, y.at(tick) + 4.0, tick_text(tick));
    }
    for (const double tick : x.ticks()) {
        content += line("grid", x.at(tick), kTop, x.at(tick), kHeight - kBottom);
        content += label("tick below", x.at(tick), kHeight - kBottom + 18.0, tick_text(tick));
    }
    content += line("axis", kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom);
    content += label("title below", 0.5 * (kLeft + kWidth - kRight), kHeight - 8.0, "map, MiB, logarithmic");
    content += label_upward("title below", 14.0, 0.5 * (kTop + kHeight - kBottom), "query, ms, logarithmic");
    if (null_line) content += line("floor", kLeft, y.at(*null_line), kWidth - kRight, y.at(*null_line));
    if (copy_line) {
        // Straight, since both scales are logarithmic; it begins where it enters the plot.
        const double begin = std::max(least_bytes, least_ms / (*rate * kMebibyte));
        content += line("floor dots", x.at(begin), y.at(begin * *rate * kMebibyte), x.at(most_bytes), y.at(*copy_line));
    }

    const std::set<const Case*> front = front_of(cases);
    std::vector<Point> points;
    std::vector<LegendEntry> entries;
    std::vector<std::string> on_front, not_all;
    std::string marks;
    for (const Case* c : cases) {
        if (c->layout == kNullLayout) continue;
        const double bytes = *c->count("map_bytes") / kMebibyte, ms = c->stage("query")->median;
        points.push_back({c, x.at(bytes), y.at(ms), front.contains(c)});
        if (front.contains(c)) on_front.push_back(c->layout);
        if (answers_less(*c)) not_all.push_back(c->layout);
        const size_t colour = sources.colour_of(c->layout);
        marks += element("g", {{"class", colour_class(colour)}},
                         marker(colour, x.at(bytes), y.at(ms), fmt::format("{}: {:.4g} MiB, {:.4g} ms", c->layout, bytes, ms)));
        entries.push_back({LegendEntry::Kind::point, colour, c->layout});
    }
    content += front_line(points) + marks + names_of(points);
    if (null_line) entries.push_back({LegendEntry::Kind::floor, 0, "null layout"});
    if (copy_line) entries.push_back({LegendEntry::Kind::dots, 0, "copy of as many bytes"});
    const Legend below = legend(entries, 16.0, kHeight + 4.0, kWidth - 32.0);

    std::string caption =
        on_front.size() == 1
            ? listed(on_front) + " is on the Pareto front: no other layout is as small or as fast."
            : listed(on_front) +
                  " are on the Pareto front, the grey steps: each other layout is beaten by one of them in both.";
    if (!not_all.empty()) caption += " Not counted, since ranges were lost or the picture is another: " + listed(not_all) + ".";
    if (null_ms && !null_line) caption += fmt::format(" The null layout's query, {} ms, is below the plot.", shown(*null_ms));
    if (rate && !copy_line)
        caption += fmt::format(" Copying the largest map takes {} ms, below the plot.", shown(*rate * kMebibyte * most_bytes));
    if (copy_line) caption += " A query that reads less than the whole map may be below the dotted line.";
    return {
        sources.name(*setting.file, "front", setting.title()),
        {"front", sources.title(*setting.file, setting.title()), kWidth, kHeight + below.height + 8.0, content + below.content},
        caption,
        setting.is_first};
}

}  // namespace

std::vector<Figure> front_figures(const Sources& sources) {
    std::vector<Figure> figures;
    for (const BenchFile& file : sources.files()) {
        for (const Setting& setting : settings_of(file)) {
            std::vector<const Case*> cases = cases_with_bytes(setting);
            // A logarithm has no 0.
            std::erase_if(cases, [](const Case* c) {
                return c->layout != kNullLayout && !(*c->count("map_bytes") > 0.0 && c->stage("query")->median > 0.0);
            });
            const auto whole = std::count_if(cases.begin(), cases.end(), [](const Case* c) { return !answers_less(*c); });
            if (whole > 0) figures.push_back(front_figure(sources, setting, cases));
        }
    }
    return figures;
}

}  // namespace gnomon::report
