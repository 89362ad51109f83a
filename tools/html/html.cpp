// SPDX-License-Identifier: Apache-2.0
// HTML and SVG as text.
#include "html/html.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

namespace gnomon::html {
namespace {

std::string start_tag(std::string_view tag, const std::vector<Attribute>& attributes) {
    std::string text = "<";
    text.append(tag);
    for (const Attribute& attribute : attributes)
        text.append(" ").append(attribute.name).append("=\"").append(escaped(attribute.value)).append("\"");
    return text.append(">");
}

// Attributes without a value are left out.
std::string cell(std::string_view tag, std::vector<Attribute> attributes, std::string_view content) {
    std::erase_if(attributes, [](const Attribute& attribute) { return attribute.value.empty(); });
    return element(tag, attributes, content);
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string element(std::string_view tag, const std::vector<Attribute>& attributes, std::string_view content) {
    return start_tag(tag, attributes).append(content).append("</").append(tag).append(">");
}

std::string empty_element(std::string_view tag, const std::vector<Attribute>& attributes) { return start_tag(tag, attributes); }

Table::Table(const std::vector<std::string>& head, std::vector<bool> are_text) : are_text_(std::move(are_text)) {
    are_text_.resize(head.size());
    for (size_t i = 0; i < head.size(); ++i)
        head_ += cell("th", {{"scope", "col"}, {"class", are_text_[i] ? "text" : ""}}, head[i]);
}

void Table::add(const std::vector<std::string>& cells, const std::vector<std::string>& orders) {
    std::string row;
    for (size_t i = 0; i < cells.size(); ++i) {
        const std::string order = i < orders.size() ? orders[i] : "";
        row += cell(i == 0 ? "th" : "td",
                    {{"scope", i == 0 ? "row" : ""}, {"class", are_text_[i] ? "text" : ""}, {"data-order", order}}, cells[i]);
    }
    body_ += element("tr", row) + "\n";
}

std::string Table::html(const std::string& class_name) const {
    // Wide tables scroll on their own, by keys too.
    return element("div", {{"class", class_name.empty() ? "table" : "table " + class_name}, {"tabindex", "0"}},
                   element("table", element("thead", element("tr", head_)) + element("tbody", body_)));
}

std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& values) {
    std::string result;
    while (true) {
        const size_t open = text.find("{{"), close = text.find("}}", open);
        if (open == std::string_view::npos || close == std::string_view::npos) return result.append(text);
        const std::string_view name = text.substr(open + 2, close - open - 2);
        const auto value = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
        if (value == values.end())
            throw Error(ErrorKind::internal, "no value for {{" + std::string(name) + "}}", "a page of the report",
                        "please report it");
        result.append(text.substr(0, open)).append(value->second);
        text.remove_prefix(close + 2);
    }
}

}  // namespace gnomon::html
