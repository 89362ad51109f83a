// SPDX-License-Identifier: Apache-2.0
// Whole pages. They need no other file and no network.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gnomon::html {

/// A page with the style that all have. title: text. content: HTML. style, script: what it has besides.
std::string page(const std::string& title, const std::string& content, const std::string& style, const std::string& script);

/// A list of facts in one line: name and value, both text.
std::string facts(const std::vector<std::pair<std::string, std::string>>& list);

/// h1, h2, ... of a text, with an id where one is given.
std::string heading(int level, const std::string& text, const std::string& id = {});

}  // namespace gnomon::html
