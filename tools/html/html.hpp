// SPDX-License-Identifier: Apache-2.0
// HTML and SVG as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::html {

struct Attribute {
    std::string_view name;
    std::string value;
};

/// Text for content and attributes.
std::string escaped(std::string_view text);

/// content: HTML. Attribute values are escaped.
std::string element(std::string_view tag, const std::vector<Attribute>& attributes, std::string_view content);
inline std::string element(std::string_view tag, std::string_view content) { return element(tag, {}, content); }

/// One that has no content and no end: img.
std::string empty_element(std::string_view tag, const std::vector<Attribute>& attributes);

/// The first cell of a row is its heading.
class Table {
public:
    /// head: HTML of each column's heading. are_text: which columns are read as text, of class "text"; those after them are
    /// not.
    explicit Table(const std::vector<std::string>& head, std::vector<bool> are_text = {});

    /// cells: HTML, as many as headings. orders: as many, or none: what a column is sorted by where that is not its text.
    void add(const std::vector<std::string>& cells, const std::vector<std::string>& orders = {});

    /// class_name: one more of its box, for the style.
    std::string html(const std::string& class_name = {}) const;

private:
    std::vector<bool> are_text_;
    std::string head_, body_;
};

/// `text` with each {{name}} replaced. Errors: ErrorKind::internal for a name that is not given.
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace gnomon::html
