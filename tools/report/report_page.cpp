// SPDX-License-Identifier: Apache-2.0
// What was measured of layouts, as a page to read.
#include "report/report_page.hpp"

#include <spdlog/fmt/fmt.h>

#include "html/embedded.hpp"
#include "html/html.hpp"
#include "html/page.hpp"
#include "html/plot.hpp"
#include "report_files.h"

namespace gnomon::report {
namespace {

using namespace html;

// Of more figures those are shown that stand for the others, of longer tables none: the rest is folded away.
constexpr size_t kShownFigures = 6;
constexpr size_t kShownRows = 60;

std::string file_html(const BenchFile& file, bool several) {
    std::string content = several ? heading(3, file.label) : "";
    auto list = file.context;
    list.emplace_back("baseline", file.baseline);
    list.emplace_back("cases", std::to_string(file.cases.size()));
    content += facts(list);
    if (!file.command.empty()) content += element("p", element("code", escaped(file.command)));
    return several ? element("div", {{"class", "file"}}, content) : content;
}

std::string plots(const std::string& content) { return element("div", {{"class", "plots"}}, content); }

std::string folded(const std::string& summary, const std::string& content) {
    return element("details", element("summary", escaped(summary)) + content) + "\n";
}

std::string group_html(const FigureGroup& group) {
    std::string open, more;
    size_t more_count = 0;
    for (const Figure& f : group.figures) {
        const bool is_open = !group.is_folded && (f.is_first || group.figures.size() <= kShownFigures);
        (is_open ? open : more) += figure(f.plot, f.caption);
        more_count += is_open ? 0 : 1;
    }
    const std::string title = group.title.empty() || group.is_folded ? "" : heading(3, group.title);
    const std::string summary =
        group.is_folded ? fmt::format("{}: {} figures", group.title, more_count) : fmt::format("{} more figures", more_count);
    return title + (open.empty() ? "" : plots(open)) + (more.empty() ? "" : folded(summary, plots(more)));
}

std::string table_html(const DataTable& table) {
    const std::string content = element("p", {{"class", "note"}}, escaped(table.caption)) + table.html();
    if (table.rows.size() <= kShownRows) return heading(3, table.title) + content;
    return folded(fmt::format("{}: {} rows", table.title, table.rows.size()), content);
}

std::string section_html(const Section& section) {
    std::string content = heading(2, section.title, section.id);
    if (!section.note.empty()) content += element("p", escaped(section.note));
    if (section.groups.empty() && section.tables.empty())
        content += element("p", {{"class", "note"}}, escaped(section.nothing));
    // What is summed up first, then what it looks like, then all of it.
    size_t next = 0;
    if (!section.tables.empty() && section.tables[0].name == "summary") content += table_html(section.tables[next++]);
    for (const FigureGroup& group : section.groups) content += group_html(group);
    for (; next < section.tables.size(); ++next) content += table_html(section.tables[next]);
    return content;
}

constexpr std::pair<const char*, const char*> kMeanings[] = {
    {"Times",
     "Milliseconds on the device, of runs that took turns (A B A B), so that what slows the machine for a while slows all "
     "alike. A "
     "time is the median of its repetitions; quartiles are of the same repetitions. Building is clear, count, scan, prepare, "
     "fill "
     "and finish together; the query is the shadow test, which walks the lists."},
    {"Ratios and verdicts",
     "The ratio of a repetition is the layout's time over the baseline's in the same turn, on the same scene and axes. Shown "
     "is their median, with an interval that holds it in at least 95 of 100 such runs (order statistics, by the sign "
     "test). Same: the interval lies within 0.98 to 1.02. Else faster or slower: it lies below or above 1. Else "
     "undecided: more repetitions may tell."},
    {"Many comparisons",
     "Each interval stands for itself. Of a hundred comparisons of equals some five leave 1 out by chance; the A/A row "
     "shows how many did here."},
    {"Floors",
     "The null layout counts ranges and keeps none: what its frames take no layout can save. The copy rate is what the device "
     "copies in the same run; a layout whose bytes take longer to copy than its query runs does not read all of them."},
    {"Counts",
     "Deterministic: the same every time on every device of the same subgroup size. They come from runs of their own, since "
     "counting takes time."}};

std::string meanings() {
    std::string list;
    for (const auto& [name, text] : kMeanings) list += element("dt", escaped(name)) + element("dd", escaped(text));
    return heading(2, "What the numbers are", "meanings") + element("dl", list);
}

}  // namespace

std::string to_html(const std::vector<BenchFile>& files, const std::vector<Section>& sections) {
    const std::string title = "Layouts of the S-buffer, measured";
    std::string content = element("h1", title), links;
    for (const BenchFile& file : files) content += file_html(file, files.size() > 1);
    for (const Section& section : sections) links += element("a", {{"href", "#" + section.id}}, escaped(section.title)) + "\n";
    content += element("nav", links + element("a", {{"href", "#meanings"}}, "What the numbers are"));
    for (const Section& section : sections) content += section_html(section);
    return page(title, content + meanings(), embedded(kReportFiles, "report.css"), embedded(kReportFiles, "tables.js"));
}

}  // namespace gnomon::report
