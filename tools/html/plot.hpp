// SPDX-License-Identifier: Apache-2.0
// Plots as SVG, in a page or each in a file of its own.
#pragma once

#include <string>

namespace gnomon::html {

struct Plot {
    std::string type;   ///< A class for the style of pages.
    std::string title;  ///< Text.
    double width = 0.0;
    double height = 0.0;
    std::string content;  ///< SVG.
};

/// A figure of a page: title, plot, and a caption (text) where one is given.
std::string figure(const Plot& plot, const std::string& caption = {});

/// A whole SVG file, on white and with its title. It refers to nothing.
std::string svg_file(const Plot& plot);

/// Rules of a style sheet with var(--name) replaced by what the first rule of `palette` says it is, for programs that know no
/// variables. Errors: ErrorKind::internal for a name that the palette does not have.
std::string without_variables(const std::string& style, const std::string& palette);

}  // namespace gnomon::html
