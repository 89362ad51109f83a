// SPDX-License-Identifier: Apache-2.0
// A table that can be read in a page, by a program, and in a paper.
#include "report/data_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "html/html.hpp"
#include "text/csv_field.hpp"

namespace gnomon::report {
namespace {

constexpr size_t kRowsOfAPage = 40;

std::string in_full(double value) { return fmt::format("{}", value); }

std::string heading(const Column& column) { return column.unit.empty() ? column.name : column.name + ", " + column.unit; }

// Characters that mean something there. GitHub's Markdown reads HTML, too.
std::string markdown_text(const std::string& text) {
    std::string result;
    for (const char c : html::escaped(text)) {
        if (std::string_view("\\`*_[]|~#").find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
    return result;
}

std::string latex_text(std::string_view text) {
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (text.substr(i).starts_with("–")) {
            result += "--";
            i += std::string_view("–").size() - 1;
        } else if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) {
            result += {'\\', c};
        } else if (c == '\\') {
            result += "\\textbackslash{}";
        } else if (c == '~') {
            result += "\\textasciitilde{}";
        } else if (c == '^') {
            result += "\\textasciicircum{}";
        } else if (c == '<') {
            result += "\\textless{}";
        } else if (c == '>') {
            result += "\\textgreater{}";
        } else {
            result += c;
        }
    }
    return result;
}

// The cells of a line, with what is between them.
template <class Item, class Text>
std::string joined(const std::vector<Item>& items, std::string_view between, Text text) {
    std::string result;
    for (size_t i = 0; i < items.size(); ++i) {
        if (i > 0) result += between;
        result += text(items[i]);
    }
    return result;
}

}  // namespace

Cell::Cell(std::string words) : text(std::move(words)) {}
Cell::Cell(const char* words) : text(words) {}

std::string shown(double value) {
    const double size = std::abs(value);
    if (size < 1e-9) return "0";
    if (value == std::floor(value) || size >= 100.0) {
        std::string digits = fmt::format("{:.0f}", value);
        const std::ptrdiff_t sign = digits.front() == '-' ? 1 : 0;
        for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > sign; i -= 3)
            digits.insert(static_cast<size_t>(i), ",");
        return digits;
    }
    return fmt::format("{:.{}f}", value, static_cast<int>(2.0 - std::floor(std::log10(size))));
}

Cell shown_cell(const std::optional<double>& value) {
    Cell cell;
    if (value) cell.text = shown(*value);
    cell.number = value;
    return cell;
}

Cell ratio_cell(const std::optional<double>& value) {
    Cell cell;
    if (value) cell.text = fmt::format("{:.3f}", *value);
    cell.number = value;
    return cell;
}

void DataTable::drop_empty_columns() {
    for (size_t i = columns.size(); i-- > 0;) {
        if (std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return !row[i].text.empty(); })) continue;
        const auto at = static_cast<std::ptrdiff_t>(i);
        columns.erase(columns.begin() + at);
        for (auto& row : rows) row.erase(row.begin() + at);
    }
}

std::string DataTable::html() const {
    std::vector<std::string> head;
    for (const Column& column : columns)
        head.push_back(html::escaped(column.name) +
                       (column.unit.empty() ? "" : html::element("small", html::escaped(column.unit))));
    std::vector<bool> are_text;
    for (const Column& column : columns) are_text.push_back(column.is_text);
    html::Table table(head, are_text);
    for (const auto& row : rows) {
        std::vector<std::string> cells, orders;
        for (const Cell& cell : row) {
            const std::string text = cell.text.empty() ? "–" : html::escaped(cell.text);
            cells.push_back(cell.kind.empty() ? text : html::element("span", {{"class", cell.kind}}, text));
            orders.push_back(cell.number ? in_full(*cell.number) : "");
        }
        table.add(cells, orders);
    }
    return table.html("sortable");
}

std::string DataTable::csv() const {
    std::string text = joined(columns, ",", [](const Column& column) { return csv_field(heading(column)); }) + "\r\n";
    for (const auto& row : rows)
        text += joined(row, ",", [](const Cell& cell) { return cell.number ? in_full(*cell.number) : csv_field(cell.text); }) +
                "\r\n";
    return text;
}

std::string DataTable::markdown() const {
    std::string text = "### " + markdown_text(title) + "\n\n" + markdown_text(caption) + "\n\n| ";
    text += joined(columns, " | ", [](const Column& column) { return markdown_text(heading(column)); }) + " |\n| ";
    text += joined(columns, " | ", [](const Column& column) { return std::string(column.is_text ? "---" : "---:"); }) + " |\n";
    for (const auto& row : rows)
        text += "| " + joined(row, " | ", [](const Cell& cell) { return markdown_text(cell.text); }) + " |\n";
    return text + "\n";
}

std::string DataTable::latex() const {
    const bool is_long = rows.size() > kRowsOfAPage;
    const std::string kind = is_long ? "longtable" : "tabular";
    std::string text =
        fmt::format("% {}. {}\n% Needs \\usepackage{{booktabs{}}}.\n", title, caption, is_long ? ",longtable" : "");
    text += "\\begin{" + kind + "}{" +
            joined(columns, "", [](const Column& column) { return std::string(column.is_text ? "l" : "r"); }) +
            "}\n\\toprule\n" + joined(columns, " & ", [](const Column& column) { return latex_text(heading(column)); }) +
            " \\\\\n\\midrule\n" + (is_long ? "\\endhead\n" : "");
    for (const auto& row : rows) text += joined(row, " & ", [](const Cell& cell) { return latex_text(cell.text); }) + " \\\\\n";
    return text + "\\bottomrule\n\\end{" + kind + "}\n\n";
}

}  // namespace gnomon::report
