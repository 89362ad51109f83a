// SPDX-License-Identifier: Apache-2.0
// Plots as SVG, in a page or each in a file of its own.
#include "html/plot.hpp"

#include <spdlog/fmt/fmt.h>

#include <gnomon/error.hpp>

#include "html/embedded.hpp"
#include "html/html.hpp"
#include "html/svg.hpp"
#include "html_files.h"

namespace gnomon::html {

std::string figure(const Plot& plot, const std::string& caption) {
    const std::string svg = element(
        "svg",
        {{"viewBox", fmt::format("0 0 {:.0f} {:.0f}", plot.width, plot.height)}, {"role", "img"}, {"aria-label", plot.title}},
        plot.content);
    const std::string below = caption.empty() ? "" : element("p", {{"class", "caption"}}, escaped(caption));
    return element("figure", {{"class", "plot " + plot.type}}, element("figcaption", escaped(plot.title)) + svg + below) + "\n";
}

std::string svg_file(const Plot& plot) {
    constexpr double kTitle = 28.0;
    const std::string style = without_variables(embedded(kHtmlFiles, "plot.css"), embedded(kHtmlFiles, "palette.css"));
    return fmt::format(
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}">
<title>{2}</title>
<style>
svg text {{ font-family: "DejaVu Sans", Verdana, sans-serif }}
{3}</style>
<rect width="{0:.0f}" height="{1:.0f}" fill="#ffffff"/>
{4}
<g transform="translate(0 {5:.0f})">{6}</g>
</svg>
)svg",
        plot.width, plot.height + kTitle, escaped(plot.title), style,
        label("title value", 8.0, 18.0, shortened(plot.title, plot.width - 16.0)), kTitle, plot.content);
}

std::string without_variables(const std::string& style, const std::string& palette) {
    const auto value_of = [&](const std::string& name) {
        const size_t found = palette.find(name + ":");
        if (found == std::string::npos)
            throw Error(ErrorKind::internal, "the palette has no " + name, "a plot", "please report it");
        const size_t begin = palette.find_first_not_of(' ', found + name.size() + 1);
        return palette.substr(begin, palette.find(';', begin) - begin);
    };
    std::string result;
    for (size_t from = 0;;) {
        const size_t open = style.find("var(", from), close = style.find(')', open);
        if (open == std::string::npos || close == std::string::npos) return result + style.substr(from);
        result += style.substr(from, open - from) + value_of(style.substr(open + 4, close - open - 4));
        from = close + 1;
    }
}

}  // namespace gnomon::html
