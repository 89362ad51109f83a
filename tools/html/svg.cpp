// SPDX-License-Identifier: Apache-2.0
// What plots are drawn with, as text of SVG.
#include "html/svg.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "html/html.hpp"

namespace gnomon::html {
namespace {

constexpr double kCharacter = 7.2;  // Of 12 pixels, in DejaVu Sans; other fonts are narrower.
constexpr double kLegendRow = 18.0, kSwatch = 24.0, kBetween = 16.0;

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }

std::string hinted(const std::string& hint) { return hint.empty() ? "" : element("title", escaped(hint)); }

std::string swatch(const LegendEntry& entry, double x, double y) {
    using Kind = LegendEntry::Kind;
    switch (entry.kind) {
        case Kind::part:
            return rectangle("part " + colour_class(entry.series), x + 6.0, y - 6.0, 12.0, 12.0, "");
        case Kind::curve:
            return element("g", {{"class", colour_class(entry.series)}},
                           line("curve", x, y, x + 20.0, y) + marker(entry.series, x + 10.0, y, ""));
        case Kind::point:
            return element("g", {{"class", colour_class(entry.series)}}, marker(entry.series, x + 12.0, y, ""));
        case Kind::floor:
            return line("floor", x, y, x + 20.0, y);
        case Kind::dots:
            return line("floor dots", x, y, x + 20.0, y);
        case Kind::zone:
            return rectangle("zone", x + 2.0, y - 6.0, 16.0, 12.0, "");
    }
    return "";
}

}  // namespace

std::string at(double value) { return fmt::format("{:.1f}", value); }
std::string tick_text(double value) {
    const double rounded = std::round(value * 1e9) / 1e9;
    return fmt::format("{:g}", rounded);
}
std::string colour_class(size_t series) { return fmt::format("c{}", series % 8); }

std::string line(const std::string& type, double x0, double y0, double x1, double y1) {
    return element("line", {{"class", type}, {"x1", at(x0)}, {"y1", at(y0)}, {"x2", at(x1)}, {"y2", at(y1)}}, "");
}

std::string label(const std::string& type, double x, double y, const std::string& text) {
    return element("text", {{"class", type}, {"x", at(x)}, {"y", at(y)}}, escaped(text));
}

std::string label_upward(const std::string& type, double x, double y, const std::string& text) {
    return element("text", {{"class", type}, {"transform", fmt::format("translate({:.1f} {:.1f}) rotate(-90)", x, y)}},
                   escaped(text));
}

std::string rectangle(const std::string& type, double x, double y, double width, double height, const std::string& hint) {
    return element("rect", {{"class", type}, {"x", at(x)}, {"y", at(y)}, {"width", at(width)}, {"height", at(height)}},
                   hinted(hint));
}

std::string marker(size_t series, double x, double y, const std::string& hint) {
    const auto shape = [&](const char* d) {
        return element("path", {{"class", "fill"}, {"transform", fmt::format("translate({:.1f} {:.1f})", x, y)}, {"d", d}},
                       hinted(hint));
    };
    // So that neighbours differ in both, and one colour comes with every shape.
    switch ((series + series / 8) % 5) {
        case 0:
            return element("circle", {{"class", "fill"}, {"cx", at(x)}, {"cy", at(y)}, {"r", "3.5"}}, hinted(hint));
        case 1:
            return shape("M-3.2-3.2h6.4v6.4h-6.4z");
        case 2:
            return shape("M0-4.4L4.2 3.2h-8.4z");
        case 3:
            return shape("M0-4.6L4.6 0L0 4.6L-4.6 0z");
        default:
            return shape("M0 4.4L4.2-3.2h-8.4z");
    }
}

double text_width(const std::string& text) {
    return kCharacter * static_cast<double>(std::count_if(text.begin(), text.end(), begins_character));
}

std::string shortened(const std::string& text, double width) {
    if (text_width(text) <= width) return text;
    const auto most = static_cast<size_t>(std::max(1.0, std::floor(width / kCharacter) - 1.0));
    size_t characters = 0, end = 0;
    for (; end < text.size(); ++end)
        if (begins_character(text[end]) && ++characters > most) break;
    return text.substr(0, end) + "…";
}

Legend legend(const std::vector<LegendEntry>& entries, double x, double y, double width) {
    Legend result;
    double to_right = x, row = y;
    for (const LegendEntry& entry : entries) {
        const std::string name = shortened(entry.name, width - kSwatch);
        const double wide = kSwatch + text_width(name);
        if (to_right > x && to_right + wide > x + width) {
            to_right = x;
            row += kLegendRow;
        }
        const double middle = row + 0.5 * kLegendRow;
        result.content += swatch(entry, to_right, middle) + label("name", to_right + kSwatch, middle + 4.0, name);
        to_right += wide + kBetween;
    }
    result.height = entries.empty() ? 0.0 : row + kLegendRow - y;
    return result;
}

}  // namespace gnomon::html
