// SPDX-License-Identifier: Apache-2.0
// What the pages of a report have in common.
#include "reproduce/page.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <gnomon/version.hpp>

#include "html/embedded.hpp"
#include "html/html.hpp"
#include "html/page.hpp"
#include "page_files.h"

namespace gnomon::reproduce {
namespace {

using namespace html;

std::string class_of(Verdict verdict) {
    std::string name = to_text(verdict);
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string mark(Verdict verdict) {
    const char* marks[] = {"✓", "✗", "?"};
    return element("span", {{"class", "mark " + class_of(verdict)}, {"title", to_text(verdict)}},
                   marks[static_cast<size_t>(verdict)]);
}

// A statement, and what was measured wherever it was checked.
std::string check_list(const std::vector<Check>& checks) {
    std::string items;
    for (size_t i = 0; i < checks.size();) {
        const std::string& statement = checks[i].statement;
        std::string measured;
        for (; i < checks.size() && checks[i].statement == statement; ++i)
            measured += element("span", {{"class", "measured"}},
                                mark(checks[i].verdict) + " " + escaped(checks[i].measured + " (" + checks[i].scene + ")"));
        items += element("li", escaped(statement) + measured);
    }
    return element("ul", {{"class", "checks"}}, items);
}

}  // namespace

std::string figure_page(const std::string& title, const std::string& content) {
    return page(title, content, embedded(kPageFiles, "viewer.css"), embedded(kPageFiles, "viewer.js"));
}

std::string measured_on(const MeasureOptions& options, const std::string& device) {
    return facts(
        {{"device", device},
         {"scale", options.scale == 1.0 ? "1, full size" : fmt::format("{:g} of the sides of full size", options.scale)},
         {"seeds per run", std::to_string(options.repeat)},
         {"reference", fmt::format("Embree, {} samples per pixel", options.reference_spp)},
         {"gnomon", GNOMON_VERSION}});
}

std::string verdict_html(Verdict verdict) {
    return element("span", {{"class", "verdict " + class_of(verdict)}}, to_text(verdict));
}

std::string claims_table(const std::vector<ClaimResult>& claims) {
    Table table({"The paper says", "checked for", "verdict", "measured here"});
    for (const ClaimResult& claim : claims) {
        table.add({element("blockquote", "“" + escaped(claim.quote) + "”") + element("cite", escaped(claim.source)),
                   escaped(claim.run.empty() ? "–" : claim.run), verdict_html(claim.verdict), check_list(claim.checks)});
    }
    return element("div", {{"class", "wide"}}, table.html());
}

}  // namespace gnomon::reproduce
