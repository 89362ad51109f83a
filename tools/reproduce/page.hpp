// SPDX-License-Identifier: Apache-2.0
// What the pages of a report have in common.
#pragma once

#include <string>

#include "reproduce/claim.hpp"

namespace gnomon::reproduce {

/// A whole page with its style and script. content: HTML.
std::string page(const std::string& title, const std::string& content);

/// A list of facts in one line: name and value.
std::string facts(const std::vector<std::pair<std::string, std::string>>& list);

/// "Intel ..., full size" and so on.
std::string measured_on(const MeasureOptions& options, const std::string& device);

/// "holds" in its colour.
std::string verdict_html(Verdict verdict);

/// Claims, each with what was measured.
std::string claims_table(const std::vector<ClaimResult>& claims);

}  // namespace gnomon::reproduce
