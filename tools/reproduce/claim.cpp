// SPDX-License-Identifier: Apache-2.0
// Whether what a paper says holds for what was measured.
#include "reproduce/claim.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <optional>

#include "io/error_curve.hpp"
#include "reproduce/errors.hpp"

namespace gnomon::reproduce {
namespace {

// One side of a comparison: its figure, and how both are written.
struct Side {
    Estimate estimate;
    std::string name;
    std::string value;
    bool known = true;  // A curve says nothing beyond its ends.
};

class Checker {
public:
    Checker(const Figure& figure, const ExperimentResult& result, std::string proposed)
        : figure_(figure), experiment_(*figure.experiment), result_(result), proposed_(std::move(proposed)) {}

    std::vector<Check> checks(const Comparison& comparison) const {
        std::vector<Check> checks;
        const size_t count = experiment_.settings.size();
        for (size_t i = 0; i < count; ++i) {
            const std::string& scene = experiment_.settings[i].scene;
            if (!comparison.scene.empty() && comparison.scene != scene) continue;
            if (comparison.where == Comparison::Where::each) {
                checks.push_back(check(comparison, i, i, false));
            } else if (i + 1 == count || experiment_.settings[i + 1].scene != scene) {
                size_t first = i;
                while (first > 0 && experiment_.settings[first - 1].scene == scene) --first;
                checks.push_back(check(comparison, i, first, true));
            }
        }
        return checks;
    }

private:
    Check check(const Comparison& comparison, size_t left_ix, size_t right_ix, bool name_places) const {
        const Side left = side(comparison.left, left_ix, name_places);
        const Metric metric = comparison.left.metric;
        const Side right = comparison.right ? side(*comparison.right, right_ix, name_places)
                                            : Side{{comparison.number, 0.0},
                                                   shown_with_unit(metric, {comparison.number, 0.0}),
                                                   shown_with_unit(metric, {comparison.number, 0.0}),
                                                   true};
        const bool less = comparison.sign == Comparison::Sign::less;
        const std::string sign = less ? " < " : " > ";
        Check result{experiment_.settings[left_ix].scene, left.name + sign + right.name, left.value + sign + right.value, {}};
        Estimate difference = unpaired_difference(left.estimate, right.estimate);
        if (const auto of_squares = difference_of_squares(comparison, left_ix, right_ix)) {
            difference = *of_squares;
            result.measured += fmt::format("; pixel by pixel the squares differ by {:.2g} ± {:.1g}", difference.value,
                                           difference.standard_error);
        } else if (const auto by_seed = difference_by_seed(comparison, left_ix, right_ix)) {
            difference = *by_seed;
        }
        const double lead = difference.value * (less ? -1.0 : 1.0), error = difference.standard_error;
        if (!name_places && !experiment_.axis.empty()) result.scene += ", " + place(left_ix);
        result.verdict = std::abs(lead) <= deviations_by_chance(difference.freedom) * error ? Verdict::undecided
                         : lead > 0.0                                                       ? Verdict::holds
                                                                                            : Verdict::does_not_hold;
        if (!left.known || !right.known) result.verdict = Verdict::undecided;
        // Equal and exact: neither is less.
        else if (lead == 0.0 && error == 0.0)
            result.verdict = Verdict::does_not_hold;
        return result;
    }

    static Estimate unpaired_difference(const Estimate& left, const Estimate& right) {
        const uint32_t least = std::min(left.freedom, right.freedom), most = std::max(left.freedom, right.freedom);
        return {left.value - right.value, std::hypot(left.standard_error, right.standard_error), least > 0 ? least : most};
    }

    // left - right, of metrics that are roots of mean squares, at one setting. What seeds change in both alike does not count:
    // both are of the same samples.
    std::optional<Estimate> difference_of_squares(const Comparison& comparison, size_t left_ix, size_t right_ix) const {
        if (!comparison.right || left_ix != right_ix) return std::nullopt;
        const Term &left = comparison.left, &right = *comparison.right;
        if (left.metric != right.metric || !right.at_time_of.empty() || !left.over_run.empty() || !right.over_run.empty())
            return std::nullopt;
        const auto &a = run(left.run, left_ix).squares, &b = run(right.run, right_ix).squares;
        if (!a.contains(left.metric) || !b.contains(left.metric)) return std::nullopt;
        const double factor = right.factor / left.factor;
        const PixelSquares squares = difference(a.at(left.metric), factor * factor, b.at(left.metric));
        return over_seeds(squares, result_.settings[left_ix].settings.width);
    }

    // left - right, seed by seed: runs take turns, so that what slows one frame slows its neighbours too.
    std::optional<Estimate> difference_by_seed(const Comparison& comparison, size_t left_ix, size_t right_ix) const {
        const auto left = by_seed(comparison.left, left_ix);
        if (!left) return std::nullopt;
        const auto right =
            comparison.right ? by_seed(*comparison.right, right_ix) : std::vector<double>(left->size(), comparison.number);
        if (!right || right->size() != left->size()) return std::nullopt;
        std::vector<double> differences;
        for (size_t i = 0; i < left->size(); ++i) differences.push_back((*left)[i] - (*right)[i]);
        return estimate(differences);
    }

    std::optional<std::vector<double>> by_seed(const Term& term, size_t setting_ix) const {
        if (!term.at_time_of.empty()) return std::nullopt;
        const auto& values = run(term.run, setting_ix).by_seed;
        if (!values.contains(term.metric)) return std::nullopt;
        std::vector<double> result = values.at(term.metric);
        for (size_t i = 0; i < result.size(); ++i) {
            if (!term.over_run.empty()) result[i] /= run(term.over_run, setting_ix).by_seed.at(term.metric)[i];
            result[i] *= term.factor;
        }
        return result;
    }

    // Where the curve takes as long as a run.
    Side side_of_curve(const Term& term, size_t setting_ix) const {
        std::vector<io::CurvePoint> points;
        for (const Run& run : experiment_.runs) {
            if (run.curve != term.run) continue;
            const Estimate error = measured(term.metric, run.label, setting_ix);
            points.push_back({measured(Metric::seconds, run.label, setting_ix).value, error.value, error.standard_error});
        }
        const double seconds = measured(Metric::seconds, term.at_time_of, setting_ix).value;
        const io::CurveValue at = io::ErrorCurve(std::move(points), term.run).error_after(seconds);
        const std::string name = info(term.metric).title + " of " + term.run + " after the time of " + label(term.at_time_of);
        switch (at.where) {
            case io::CurveValue::Where::before_first:
                return {{}, name, "(all take longer)", false};
            case io::CurveValue::Where::after_last:
                return {{}, name, "(all take less)", false};
            case io::CurveValue::Where::measured:
                break;
        }
        const Estimate value{at.value, at.standard_error};
        return {value, name, shown_with_unit(term.metric, value), true};
    }

    Side side(const Term& term, size_t setting_ix, bool name_place) const {
        if (!term.at_time_of.empty()) return side_of_curve(term, setting_ix);
        Estimate value = measured(term.metric, term.run, setting_ix);
        std::string name = info(term.metric).title + " of " + label(term.run);
        std::string suffix;
        if (!term.over_run.empty()) {
            const Estimate under = measured(term.metric, term.over_run, setting_ix);
            const double ratio = value.value / under.value;
            value = {ratio,
                     std::abs(ratio) * std::hypot(value.standard_error / value.value, under.standard_error / under.value)};
            name += " / that of " + label(term.over_run);
        }
        value = {value.value * term.factor, value.standard_error * term.factor};
        if (term.factor != 1.0) name = fmt::format("{} × {}", term.factor, name);
        if (name_place) name += " at " + place(setting_ix);
        const std::string text = !term.over_run.empty() ? shown(value) : shown_with_unit(term.metric, value);
        return {value, name, text, true};
    }

    std::string place(size_t setting_ix) const {
        return fmt::format("{} {}", experiment_.settings[setting_ix].x, experiment_.axis);
    }

    const std::string& label(const std::string& run) const { return run == kProposed ? proposed_ : run; }

    Estimate measured(Metric metric, const std::string& run, size_t setting_ix) const {
        const auto& metrics = this->run(run, setting_ix).metrics;
        if (const auto found = metrics.find(metric); found != metrics.end()) return found->second;
        throw not_measured(info(metric).title + " of " + label(run));
    }

    const RunResult& run(const std::string& name, size_t setting_ix) const {
        for (size_t i = 0; i < experiment_.runs.size(); ++i)
            if (experiment_.runs[i].label == label(name)) return result_.settings[setting_ix].runs[i];
        throw not_measured(label(name));
    }

    Error not_measured(const std::string& what) const {
        return {ErrorKind::internal, "a claim about what is not measured: " + what, "figure " + figure_.name,
                "please report it"};
    }

    const Figure& figure_;
    const Experiment& experiment_;
    const ExperimentResult& result_;
    std::string proposed_;
};

bool names_proposed(const Claim& claim) {
    return std::any_of(claim.comparisons.begin(), claim.comparisons.end(), [](const Comparison& c) {
        const auto names = [](const Term& t) {
            return t.run == kProposed || t.over_run == kProposed || t.at_time_of == kProposed;
        };
        return names(c.left) || (c.right && names(*c.right));
    });
}

Verdict all_of(const std::vector<Check>& checks) {
    const auto any = [&](Verdict verdict) {
        return std::any_of(checks.begin(), checks.end(), [&](const Check& check) { return check.verdict == verdict; });
    };
    return any(Verdict::does_not_hold) ? Verdict::does_not_hold : any(Verdict::undecided) ? Verdict::undecided : Verdict::holds;
}

}  // namespace

std::string to_text(Verdict verdict) {
    switch (verdict) {
        case Verdict::holds:
            return "holds";
        case Verdict::does_not_hold:
            return "does not hold";
        case Verdict::undecided:
            break;
    }
    return "undecided";
}

std::vector<ClaimResult> check_claims(const Figure& figure, const ExperimentResult& result) {
    std::vector<ClaimResult> results;
    for (const Claim& claim : figure.claims) {
        std::vector<std::string> runs;
        if (names_proposed(claim)) {
            for (const Run& run : figure.experiment->runs)
                if (run.proposed) runs.push_back(run.label);
        } else {
            runs.emplace_back();
        }
        for (const std::string& run : runs) {
            ClaimResult checked{claim.quote, claim.source, run, {}, {}};
            const Checker checker(figure, result, run);
            for (const Comparison& comparison : claim.comparisons) {
                const std::vector<Check> checks = checker.checks(comparison);
                checked.checks.insert(checked.checks.end(), checks.begin(), checks.end());
            }
            checked.verdict = all_of(checked.checks);
            results.push_back(std::move(checked));
        }
    }
    return results;
}

}  // namespace gnomon::reproduce
