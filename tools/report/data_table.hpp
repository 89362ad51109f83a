// SPDX-License-Identifier: Apache-2.0
// A table that can be read in a page, by a program, and in a paper.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gnomon::report {

/// Text, or a number that people are shown in fewer digits.
struct Cell {
    Cell() = default;         ///< Empty: there is no value.
    Cell(std::string words);  // NOLINT: rows are lists of either.
    Cell(const char* words);  // NOLINT

    std::string text;              ///< What people read.
    std::optional<double> number;  ///< In full, for sorting and CSV.
    std::string kind;              ///< A class of the page's style, as the verdict's.
};

/// Three digits that count, at least: 0.0123, 4.56, 789, 12,345.
std::string shown(double value);
Cell shown_cell(const std::optional<double>& value);

/// A ratio, with three decimals.
Cell ratio_cell(const std::optional<double>& value);

struct Column {
    std::string name;
    std::string unit = {};  ///< Empty: none, or not one.
    bool is_text = false;
};

struct DataTable {
    std::string name;  ///< Of its file: "verdicts".
    std::string title;
    std::string caption;  ///< A sentence.
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;

    /// Columns in which no row has a value are left out.
    void drop_empty_columns();

    std::string html() const;      ///< In a box that scrolls on its own.
    std::string csv() const;       ///< RFC 4180, with a line of names; numbers in full.
    std::string markdown() const;  ///< With title and caption.
    std::string latex() const;     ///< A tabular with rules of booktabs; a longtable where it is longer than a page.
};

}  // namespace gnomon::report
