// SPDX-License-Identifier: Apache-2.0
// What the pages of a report have in common.
#pragma once

#include <string>

#include "reproduce/claim.hpp"

namespace gnomon::reproduce {

/// A whole page with viewers of pictures. content: HTML.
std::string figure_page(const std::string& title, const std::string& content);

/// "Intel ..., full size" and so on.
std::string measured_on(const MeasureOptions& options, const std::string& device);

/// "holds" in its colour.
std::string verdict_html(Verdict verdict);

/// Claims, each with what was measured.
std::string claims_table(const std::vector<ClaimResult>& claims);

}  // namespace gnomon::reproduce
