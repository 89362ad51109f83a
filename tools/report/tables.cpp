// SPDX-License-Identifier: Apache-2.0
// The tables of a report.
#include "report/tables.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "report/settings.hpp"

namespace gnomon::report {
namespace {

using Row = std::vector<Cell>;
using Columns = std::vector<Column>;

/// How the rows of a table begin: layout, file where there are several, scene, and the axes that some file varies.
class RowHead {
public:
    explicit RowHead(const std::vector<BenchFile>& files) : several_(files.size() > 1) {
        for (const BenchFile& file : files)
            for (const Axis& axis : file.axes)
                if (axis.values.size() > 1 && std::find(axes_.begin(), axes_.end(), axis.name) == axes_.end())
                    axes_.push_back(axis.name);
    }

    Columns columns() const {
        Columns columns = {{"layout", "", true}};
        if (several_) columns.push_back({"file", "", true});
        columns.push_back({"scene", "", true});
        for (const std::string& axis : axes_) columns.push_back({axis, "", false});
        return columns;
    }

    Row cells(const BenchFile& file, const Case& c) const {
        Row row = {Cell(c.row_name())};
        if (several_) row.emplace_back(file.label);
        row.emplace_back(c.scene);
        for (const std::string& name : axes_) {
            const auto axis = std::find_if(file.axes.begin(), file.axes.end(), [&](const Axis& a) { return a.name == name; });
            Cell& cell = row.emplace_back();
            if (axis == file.axes.end()) continue;
            cell.text = c.values[static_cast<size_t>(axis - file.axes.begin())];
            if (const auto number = numbers_of({cell.text}); !number.empty()) cell.number = number[0];
        }
        return row;
    }

private:
    bool several_;
    std::vector<std::string> axes_;
};

void append(auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); }

std::optional<double> median_of(const Case& c, const std::string& stage) {
    const Times* times = c.stage(stage);
    return times != nullptr ? std::optional(times->median) : std::nullopt;
}

Cell verdict_cell(Verdict verdict) {
    Cell cell(to_string(verdict));
    cell.kind = "verdict " + to_string(verdict);
    return cell;
}

/// All ratios of a layout on a stage.
struct Ratios {
    double logarithms = 0.0, least = 0.0, most = 0.0;
    size_t count = 0;
    size_t verdicts[4] = {};

    void add(const Comparison& c) {
        logarithms += std::log(std::max(c.ratio, 1e-12));
        least = count == 0 ? c.ratio : std::min(least, c.ratio);
        most = count == 0 ? c.ratio : std::max(most, c.ratio);
        ++count;
        ++verdicts[static_cast<size_t>(c.verdict)];
    }
    Cell mean() const {
        return ratio_cell(count > 0 ? std::optional(std::exp(logarithms / static_cast<double>(count))) : std::nullopt);
    }
};

}  // namespace

std::vector<std::string> compared_stages(const std::vector<BenchFile>& files) {
    std::set<std::string> named;
    for (const BenchFile& file : files)
        for (const Comparison& c : file.comparisons) named.insert(c.stage);
    std::vector<std::string> stages;
    for (const char* first : {"query", "build", "frame"})
        if (named.erase(first) > 0) stages.emplace_back(first);
    append(stages, named);
    return stages;
}

DataTable summary_table(const std::vector<BenchFile>& files) {
    const std::vector<std::string> stages = compared_stages(files);
    DataTable table{
        "summary",
        "Over all scenes and axes",
        "The geometric mean of the ratios to the baseline, below 1 faster, and for the query how far they go and the "
        "number of settings with each verdict.",
        {{"layout", "", true}},
        {}};
    if (files.size() > 1) table.columns.push_back({"file", "", true});
    for (const std::string& stage : stages) {
        table.columns.push_back({stage, "mean ratio"});
        if (stage == "query")
            append(table.columns, Columns{{"least", stage},
                                          {"most", stage},
                                          {"faster", stage},
                                          {"slower", stage},
                                          {"same", stage},
                                          {"undecided", stage}});
    }
    for (const BenchFile& file : files) {
        std::vector<std::string> order;
        std::map<std::string, std::map<std::string, Ratios>> ratios;
        for (const Comparison& c : file.comparisons) {
            const Case& of = file.cases[c.of];
            const std::string name = of.row_name();
            if (!ratios.contains(name)) order.push_back(name);
            ratios[name][c.stage].add(c);
        }
        for (const std::string& name : order) {
            Row row = {Cell(name)};
            if (files.size() > 1) row.emplace_back(file.label);
            for (const std::string& stage : stages) {
                const Ratios& r = ratios[name][stage];
                row.push_back(r.mean());
                if (stage != "query") continue;
                row.push_back(r.count > 0 ? ratio_cell(r.least) : Cell());
                row.push_back(r.count > 0 ? ratio_cell(r.most) : Cell());
                for (const size_t count : r.verdicts) row.push_back(shown_cell(static_cast<double>(count)));
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

DataTable verdict_table(const std::vector<BenchFile>& files, const std::string& stage) {
    const RowHead head(files);
    DataTable table{"verdicts-" + stage,
                    "Verdicts: " + stage,
                    "The median of the paired ratios to the baseline at the same scene and axes, with its 95 % interval.",
                    head.columns(),
                    {}};
    append(table.columns, Columns{{"ratio"}, {"low"}, {"high"}, {"pairs"}, {"verdict", "", true}});
    for (const BenchFile& file : files) {
        for (const Comparison& c : file.comparisons) {
            if (c.stage != stage) continue;
            Row row = head.cells(file, file.cases[c.of]);
            append(row, Row{ratio_cell(c.ratio), ratio_cell(c.low), ratio_cell(c.high),
                            shown_cell(static_cast<double>(c.pairs)), verdict_cell(c.verdict)});
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

DataTable times_table(const std::vector<BenchFile>& files) {
    const char* stages[] = {"clear", "count", "scan", "prepare", "fill", "finish", "build", "frame", "cpu"};
    const RowHead head(files);
    DataTable table{"times",
                    "Times",
                    "Medians in milliseconds, and the quartiles of the query; cpu is the process's time on all cores together.",
                    head.columns(),
                    {}};
    append(table.columns, Columns{{"query", "ms"}, {"q1", "ms"}, {"q3", "ms"}});
    for (const char* stage : stages) table.columns.push_back({stage, "ms"});
    table.columns.push_back({"samples"});
    for (const BenchFile& file : files) {
        for (const Case& c : file.cases) {
            Row row = head.cells(file, c);
            const Times& query = *c.stage("query");
            append(row, Row{shown_cell(query.median), shown_cell(query.q1), shown_cell(query.q3)});
            for (const char* stage : stages) row.push_back(shown_cell(median_of(c, stage)));
            row.push_back(shown_cell(static_cast<double>(query.samples)));
            table.rows.push_back(std::move(row));
        }
    }
    table.drop_empty_columns();
    return table;
}

DataTable counts_table(const std::vector<BenchFile>& files) {
    const RowHead head(files);
    DataTable table{"counts", "Counts", "What was counted. An empty cell: not counted.", head.columns(), {}};
    std::vector<std::string> names;
    for (const BenchFile& file : files)
        for (const Case& c : file.cases)
            for (const auto& count : c.counts)
                if (std::find(names.begin(), names.end(), count.first) == names.end()) names.push_back(count.first);
    for (const std::string& name : names) table.columns.push_back({name});
    for (const BenchFile& file : files) {
        for (const Case& c : file.cases) {
            if (c.again || c.counts.empty()) continue;
            Row row = head.cells(file, c);
            for (const std::string& name : names) row.push_back(shown_cell(c.count(name)));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

DataTable front_table(const std::vector<BenchFile>& files) {
    const RowHead head(files);
    DataTable table{
        "bytes",
        "Bytes and query time",
        "Bytes of the map, of each of its ranges, what copying them takes, and whether no other layout of the setting "
        "is as small and as fast.",
        head.columns(),
        {}};
    append(
        table.columns,
        Columns{
            {"map", "bytes"}, {"per range", "bytes"}, {"query", "ms"}, {"build", "ms"}, {"copy", "ms"}, {"front", "", true}});
    for (const BenchFile& file : files) {
        for (const Setting& setting : settings_of(file)) {
            const std::vector<const Case*> cases = cases_with_bytes(setting);
            const std::set<const Case*> front = front_of(cases);
            for (const Case* c : cases) {
                const double bytes = *c->count("map_bytes"), ranges = c->count("ranges").value_or(0.0);
                Row row = head.cells(file, *c);
                append(row, Row{shown_cell(bytes), ranges > 0.0 ? shown_cell(bytes / ranges) : Cell(),
                                shown_cell(median_of(*c, "query")), shown_cell(median_of(*c, "build")), shown_cell(c->copy_ms),
                                Cell(front.contains(c)  ? "yes"
                                     : answers_less(*c) ? "no: answers less"
                                                        : "no")});
                table.rows.push_back(std::move(row));
            }
        }
    }
    return table;
}

DataTable files_table(const std::vector<BenchFile>& files) {
    DataTable table{"files",
                    "The same case in several files",
                    "Medians of the query in milliseconds, side by side.",
                    {{"case", "", true}},
                    {}};
    for (const BenchFile& file : files) table.columns.push_back({file.label, "query, ms"});
    std::vector<std::string> order;
    std::map<std::string, Row> rows;
    for (size_t i = 0; i < files.size(); ++i) {
        for (const Case& c : files[i].cases) {
            if (c.again) continue;
            const auto [row, is_new] = rows.try_emplace(c.name, files.size());
            if (is_new) order.push_back(c.name);
            row->second[i] = shown_cell(median_of(c, "query"));
        }
    }
    for (const std::string& name : order) {
        Row row = {Cell(name)};
        append(row, rows[name]);
        if (std::count_if(row.begin() + 1, row.end(), [](const Cell& c) { return !c.text.empty(); }) > 1)
            table.rows.push_back(std::move(row));
    }
    return table;
}

DataTable skipped_table(const std::vector<BenchFile>& files) {
    DataTable table{"skipped", "Skipped", "Cases without measurements, and why.", {{"case", "", true}}, {}};
    if (files.size() > 1) table.columns.push_back({"file", "", true});
    table.columns.push_back({"reason", "", true});
    for (const BenchFile& file : files) {
        for (const Skipped& skipped : file.skipped) {
            Row row = {Cell(skipped.name)};
            if (files.size() > 1) row.emplace_back(file.label);
            row.emplace_back(skipped.reason);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

std::vector<DataTable> all_tables(const std::vector<BenchFile>& files) {
    std::vector<DataTable> tables = {summary_table(files)};
    for (const std::string& stage : compared_stages(files)) tables.push_back(verdict_table(files, stage));
    append(tables, std::vector<DataTable>{times_table(files), front_table(files), counts_table(files), files_table(files),
                                          skipped_table(files)});
    std::erase_if(tables, [](const DataTable& table) { return table.rows.empty(); });
    return tables;
}

}  // namespace gnomon::report
