// SPDX-License-Identifier: Apache-2.0
#include "depth_time_diagram.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "html/html.hpp"

namespace gnomon::cli {
namespace {

constexpr size_t kMostTexels = 8;
constexpr double kWidth = 980, kHeight = 470;                         // Of a texel's diagram.
constexpr double kLeft = 84, kRight = 720, kTop = 64, kBottom = 404;  // Its plot.
constexpr size_t kMostBands = 16;                                     // Above that what lies behind ranges is not tinted.
// Okabe and Ito 2008, "Color universal design", without yellow and black, which are the samples'; then what is left over.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"};
constexpr const char* kOther = "#8a8f98";

/// 1, 2 or 5 times a power of ten: some five steps to the length.
double nice_step(double length) {
    const double rough = length / 5.0, power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= rough) return factor * power;
    return 10.0 * power;
}

class Panel {
public:
    Panel(const ProbedTexel& texel, const DiagramText& text) : texel_(texel), text_(text) {
        choose_colours();
        choose_depths();
    }

    std::string svg() {
        frame();
        for (const TexelRange& r : texel_.ranges) band(r);
        for (const ProbedSample& s : texel_.samples) shadow(s);
        for (const TexelRange& r : texel_.ranges) range(r);
        for (const ProbedSample& s : texel_.samples) sample(s);
        legend();
        return std::move(out_);
    }

private:
    /// Those with most shadows, then most time, have a colour of their own.
    void choose_colours() {
        std::map<uint32_t, double> weights;
        for (const TexelRange& r : texel_.ranges) weights[r.triangle] += double(r.leave) - r.enter;
        for (const ProbedSample& s : texel_.samples)
            if (s.shadowed_by) weights[*s.shadowed_by] += 1e3;
        std::vector<std::pair<double, uint32_t>> sorted;
        for (const auto& [triangle, weight] : weights) sorted.emplace_back(-weight, triangle);
        std::sort(sorted.begin(), sorted.end());
        for (size_t i = 0; i < sorted.size() && i < std::size(kColours); ++i) {
            colours_[sorted[i].second] = kColours[i];
            named_.push_back(sorted[i].second);
        }
        triangles_ = weights.size();
    }

    void choose_depths() {
        std::vector<double> depths;
        for (const TexelRange& r : texel_.ranges) depths.insert(depths.end(), {r.depth, r.exit_depth});
        for (const ProbedSample& s : texel_.samples) depths.push_back(s.depth);
        std::erase_if(depths, [](double depth) { return !std::isfinite(depth); });
        if (depths.empty()) depths = {0.0, 1.0};
        const auto [least, most] = std::minmax_element(depths.begin(), depths.end());
        const double margin = std::max(0.06 * (*most - *least), 1e-3 * std::max(1e-3, std::abs(*most)));
        nearest_ = *least - margin;
        farthest_ = *most + margin;
    }

    double x(double time) const { return kLeft + std::clamp(time, 0.0, 1.0) * (kRight - kLeft); }
    double y(double depth) const { return kTop + (depth - nearest_) / (farthest_ - nearest_) * (kBottom - kTop); }
    const char* colour(uint32_t triangle) const {
        const auto found = colours_.find(triangle);
        return found == colours_.end() ? kOther : found->second;
    }

    template <class... Values>
    void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Values>(values)...);
        out_ += '\n';
    }

    void frame() {
        const size_t lit = static_cast<size_t>(
            std::count_if(texel_.samples.begin(), texel_.samples.end(), [](const ProbedSample& s) { return s.lit; }));
        add(R"(<text x="{}" y="26" class="title">{}, texel {},{}</text>)", kLeft, html::escaped(text_.title), texel_.texel.x,
            texel_.texel.y);
        add(R"(<text x="{}" y="46" class="note">{} ranges of {} triangles; {} samples ask, {} lit and {} dark</text>)", kLeft,
            texel_.ranges.size(), triangles_, texel_.samples.size(), lit, texel_.samples.size() - lit);
        add(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="#fbfcfe" stroke="#c3c9d4"/>)", kLeft, kTop, kRight - kLeft,
            kBottom - kTop);
        for (int i = 0; i <= 10; ++i) {
            const double at = x(0.1 * i);
            add(R"(<line x1="{0:.2f}" y1="{1}" x2="{0:.2f}" y2="{2}" class="grid"/>)", at, kTop, kBottom);
            if (i % 2 == 0)
                add(R"(<text x="{:.2f}" y="{}" class="tick" text-anchor="middle">{:.1f}</text>)", at, kBottom + 18, 0.1 * i);
        }
        const double step = nice_step(farthest_ - nearest_);
        for (double k = std::ceil(nearest_ / step); k * step <= farthest_; ++k) {
            const double at = y(k * step);
            add(R"(<line x1="{1}" y1="{0:.2f}" x2="{2}" y2="{0:.2f}" class="grid"/>)", at, kLeft, kRight);
            add(R"(<text x="{}" y="{:.2f}" class="tick" text-anchor="end">{:.6g}</text>)", kLeft - 8, at + 4, k * step + 0.0);
        }
        add(R"(<text x="{}" y="{}" class="axis" text-anchor="middle">time, shares of the shutter ({:.6g} s to {:.6g} s)</text>)",
            0.5 * (kLeft + kRight), kBottom + 42, text_.shutter_open, text_.shutter_close);
        add(R"svg(<text transform="translate(22 {}) rotate(-90)" class="axis" text-anchor="middle">depth along the light's axis, m (light above)</text>)svg",
            0.5 * (kTop + kBottom));
    }

    /// What may be hidden by a range of which the nearest depth is known.
    void band(const TexelRange& r) {
        if (text_.exit_depths || texel_.ranges.size() > kMostBands) return;
        add(R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="{}" fill-opacity="0.07"/>)", x(r.enter),
            y(r.depth), x(r.leave) - x(r.enter), kBottom - y(r.depth), colour(r.triangle));
    }

    void range(const TexelRange& r) {
        add(R"(<line x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}" stroke="{}" stroke-width="4" stroke-linecap="round"><title>triangle {}: {:.6g} to {:.6g}, {:.6g} m to {:.6g} m</title></line>)",
            x(r.enter), y(r.depth), x(r.leave), y(r.exit_depth), colour(r.triangle), r.triangle, r.enter, r.leave, r.depth,
            r.exit_depth);
    }

    /// From a dark sample to what hides it.
    void shadow(const ProbedSample& s) {
        if (!s.shadowed_by) return;
        add(R"(<line x1="{0:.2f}" y1="{1:.2f}" x2="{0:.2f}" y2="{2:.2f}" stroke="{3}" stroke-width="0.8" stroke-opacity="0.6"/>)",
            x(s.time), y(s.depth), y(s.shadow_depth), colour(*s.shadowed_by));
        add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="2" fill="{}"/>)", x(s.time), y(s.shadow_depth), colour(*s.shadowed_by));
    }

    void sample(const ProbedSample& s) {
        add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="4" class="{}"><title>pixel {},{}, sample {}: {}, t {:.6g}, {:.6g} m, of triangle {}{}</title></circle>)",
            x(s.time), y(s.depth), s.lit ? "lit" : "dark", s.pixel.x, s.pixel.y, s.number, s.lit ? "lit" : "dark", s.time,
            s.depth, s.triangle,
            s.shadowed_by             ? fmt::format(", shadowed by {}", *s.shadowed_by)
            : !s.lit && s.turned_away ? ", turned away from the light"
                                      : "");
    }

    void legend() {
        double at = kTop + 10;
        const auto line = [&](const std::string& mark, const std::string& label) {
            add(R"svg(<g transform="translate({} {})">{}<text x="40" y="4" class="label">{}</text></g>)svg", kRight + 24, at,
                mark, label);
            at += 24;
        };
        const auto bar = [](const char* stroke) {
            return fmt::format(R"(<line x1="4" y1="0" x2="28" y2="0" stroke="{}" stroke-width="4" stroke-linecap="round"/>)",
                               stroke);
        };
        line(R"(<circle cx="16" cy="0" r="4" class="lit"/>)", "sample, lit");
        line(R"(<circle cx="16" cy="0" r="4" class="dark"/>)", "sample, dark");
        line(
            R"(<line x1="16" y1="-8" x2="16" y2="8" stroke="#8a8f98" stroke-width="0.8"/><circle cx="16" cy="-8" r="2" fill="#8a8f98"/>)",
            "what hides it");
        at += 10;
        add(R"(<text x="{}" y="{}" class="note">{}</text>)", kRight + 28, at + 4,
            text_.exit_depths ? "ranges, entry to exit" : "ranges, at their nearest depth");
        at += 24;
        for (const uint32_t triangle : named_) line(bar(colour(triangle)), fmt::format("triangle {}", triangle));
        if (triangles_ > named_.size()) line(bar(kOther), fmt::format("{} other triangles", triangles_ - named_.size()));
    }

    const ProbedTexel& texel_;
    const DiagramText& text_;
    std::map<uint32_t, const char*> colours_;
    std::vector<uint32_t> named_;
    size_t triangles_ = 0;
    double nearest_ = 0.0, farthest_ = 1.0;
    std::string out_;
};

}  // namespace

std::string depth_time_diagram(const std::vector<ProbedTexel>& texels, const DiagramText& text) {
    const size_t shown = std::min(texels.size(), kMostTexels);
    const bool more = texels.size() > shown;
    const double height = kHeight * static_cast<double>(std::max<size_t>(1, shown)) + (more ? 30 : 0);
    std::string svg = fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">
<style>
text {{ font-family: "DejaVu Sans", Verdana, sans-serif; fill: #1d2330 }}
.title {{ font-size: 16px; font-weight: bold }}
.axis, .label {{ font-size: 13px }}
.note {{ font-size: 13px; fill: #5b6475 }}
.tick {{ font-size: 12px; fill: #3c4454 }}
.grid {{ stroke: #e3e7ee; stroke-width: 1 }}
.lit {{ fill: #ffe680; stroke: #8a6d00; stroke-width: 1.2 }}
.dark {{ fill: #1d2330; stroke: #ffffff; stroke-width: 1 }}
</style>
<rect width="{0}" height="{1}" fill="#ffffff"/>
)",
                                  kWidth, height);
    for (size_t i = 0; i < shown; ++i) {
        svg += fmt::format("<g transform=\"translate(0 {})\">\n", kHeight * static_cast<double>(i));
        svg += Panel(texels[i], text).svg() + "</g>\n";
    }
    if (texels.empty())
        svg += fmt::format("<text x=\"{}\" y=\"60\" class=\"title\">{}: no sample of the pixel asks</text>\n", kLeft,
                           html::escaped(text.title));
    if (more)
        svg += fmt::format("<text x=\"{}\" y=\"{}\" class=\"note\">and {} more texels</text>\n", kLeft, height - 12,
                           texels.size() - shown);
    return svg + "</svg>\n";
}

}  // namespace gnomon::cli
