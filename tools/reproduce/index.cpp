// SPDX-License-Identifier: Apache-2.0
// The page over all figures.
#include <algorithm>

#include "html/html.hpp"
#include "reproduce/page.hpp"
#include "reproduce/report.hpp"

namespace gnomon::reproduce {

using namespace html;

std::string index_html(const std::vector<IndexEntry>& entries, const MeasureOptions& options, const std::string& device) {
    std::string content = element("h1", "Figures of the papers, rendered again") + measured_on(options, device);
    size_t counts[3] = {};
    for (const IndexEntry& entry : entries)
        for (const ClaimResult& claim : entry.claims) ++counts[static_cast<size_t>(claim.verdict)];
    std::string tally;
    for (const Verdict verdict : {Verdict::holds, Verdict::does_not_hold, Verdict::undecided})
        tally += std::to_string(counts[static_cast<size_t>(verdict)]) + " " + verdict_html(verdict) + " ";
    content += element("p", "Claims: " + tally);
    std::string paper;
    for (const IndexEntry& entry : entries) {
        if (entry.paper != paper) content += element("h2", escaped(entry.paper));
        paper = entry.paper;
        content += element("h3", element("a", {{"href", entry.figure + ".html"}},
                                         escaped("Figure " + entry.figure + ": " + entry.title))) +
                   element("p", {{"class", "note"}}, escaped(entry.shows));
        if (!entry.claims.empty()) content += claims_table(entry.claims);
    }
    return figure_page("Figures of the papers, rendered again", content);
}

}  // namespace gnomon::reproduce
