// SPDX-License-Identifier: Apache-2.0
// Whole pages.
#include "html/page.hpp"

#include <spdlog/fmt/fmt.h>

#include <gnomon/version.hpp>

#include "html/embedded.hpp"
#include "html/html.hpp"
#include "html_files.h"

namespace gnomon::html {

std::string page(const std::string& title, const std::string& content, const std::string& style, const std::string& script) {
    const auto file = [](std::string_view name) { return embedded(kHtmlFiles, name); };
    return filled(file("page.html"), {{"generator", "gnomon " GNOMON_VERSION},
                                      {"title", escaped(title)},
                                      {"style", file("palette.css") + file("style.css") + file("plot.css") + style},
                                      {"content", content},
                                      {"script", script}});
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& list) {
    std::string items;
    for (const auto& [name, value] : list) items += element("li", escaped(name) + " " + element("b", escaped(value)));
    return element("ul", {{"class", "facts"}}, items) + "\n";
}

std::string heading(int level, const std::string& text, const std::string& id) {
    const std::string tag = fmt::format("h{}", level);
    return (id.empty() ? element(tag, escaped(text)) : element(tag, {{"id", id}}, escaped(text))) + "\n";
}

}  // namespace gnomon::html
