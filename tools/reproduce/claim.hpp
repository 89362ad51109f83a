// SPDX-License-Identifier: Apache-2.0
// Whether what a paper says holds for what was measured.
#pragma once

#include <string>
#include <vector>

#include "reproduce/measure.hpp"

namespace gnomon::reproduce {

enum class Verdict {
    holds,
    does_not_hold,
    undecided,  ///< The two sides of a comparison are as close as chance makes them in 95 of 100 cases.
};

/// "holds", "does not hold", "undecided"
std::string to_text(Verdict verdict);

/// One comparison at one setting.
struct Check {
    std::string scene;
    std::string statement;  ///< "false shadow of tsm > 0.500 %"
    std::string measured;   ///< "1.43 ± 0.02 % > 0.500 %": the same with the figures.
    Verdict verdict = Verdict::undecided;
};

/// A claim, checked for one run.
struct ClaimResult {
    std::string quote;
    std::string source;
    std::string run;  ///< Label of the proposed run; empty: the claim names its runs.
    std::vector<Check> checks;
    Verdict verdict = Verdict::undecided;  ///< Fails where a check fails, and holds where all do.
};

/// Errors: ErrorKind::internal for a claim about a run or a metric that the experiment does not have.
std::vector<ClaimResult> check_claims(const Figure& figure, const ExperimentResult& result);

}  // namespace gnomon::reproduce
