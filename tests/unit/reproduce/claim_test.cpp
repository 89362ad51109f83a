// SPDX-License-Identifier: Apache-2.0
// Verdicts follow from what was measured, on numbers worked out by hand.
#include "reproduce/claim.hpp"

#include <gmock/gmock.h>

#include <gnomon/error.hpp>

namespace gnomon::reproduce {
namespace {

using enum Comparison::Sign;
using enum Comparison::Where;
using testing::ElementsAre;

// Two scenes at 4 and 8 samples; runs "old" and "new", the latter proposed. seconds[setting][run].
class Claims : public testing::Test {
protected:
    std::vector<ClaimResult> check(std::vector<Comparison> comparisons) {
        auto experiment = std::make_shared<Experiment>();
        experiment->runs = {{.method = "old"}, {.method = "new", .proposed = true}};
        experiment->axis = "samples";
        ExperimentResult result;
        for (const auto& at : seconds) {
            const size_t i = experiment->settings.size();
            experiment->settings.push_back({.scene = i < 2 ? "a" : "b", .make = {}, .x = i % 2 == 0 ? 4.0 : 8.0});
            SettingResult& setting = result.settings.emplace_back();
            for (size_t run = 0; run < at.size(); ++run) {
                RunResult& result_of_run = setting.runs.emplace_back();
                result_of_run.metrics[Metric::seconds] = at[run];
                if (!by_seed.empty()) result_of_run.by_seed[Metric::seconds] = by_seed[run];
            }
        }
        const Figure figure{.name = "0000-1",
                            .title = "",
                            .shows = "",
                            .experiment = experiment,
                            .claims = {{.quote = "It is so.", .source = "", .comparisons = std::move(comparisons)}}};
        return check_claims(figure, result);
    }

    std::vector<Verdict> verdicts(const std::vector<ClaimResult>& results) {
        std::vector<Verdict> list;
        for (const Check& check : results.at(0).checks) list.push_back(check.verdict);
        return list;
    }

    std::vector<std::vector<Estimate>> seconds = {
        {{1.0, 0.01}, {0.5, 0.01}}, {{2.0, 0.01}, {0.6, 0.01}}, {{1.0, 0.01}, {0.97, 0.01}}, {{1.0, 0.01}, {1.5, 0.01}}};
    std::vector<std::vector<double>> by_seed;  // Of each run, at all settings.
    const Term old_seconds{Metric::seconds, "old"}, new_seconds{Metric::seconds};
};

TEST_F(Claims, EachSettingIsChecked) {
    const auto results = check({{.left = new_seconds, .sign = less, .right = old_seconds}});
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].run, "new");
    // 1.00 and 0.97 are 0.03 apart, 1.96 standard errors are 1.96 sqrt(2) 0.01 = 0.0277; 1.5 is more than 1.
    EXPECT_THAT(verdicts(results), ElementsAre(Verdict::holds, Verdict::holds, Verdict::holds, Verdict::does_not_hold));
    EXPECT_EQ(results[0].verdict, Verdict::does_not_hold);
    EXPECT_EQ(results[0].checks[0].scene, "a, 4 samples");
    EXPECT_EQ(results[0].checks[0].statement, "frame of new < frame of old");
    EXPECT_EQ(results[0].checks[0].measured, "500 ± 10 ms < 1000 ± 10 ms");
}

TEST_F(Claims, CloseFiguresAreUndecided) {
    seconds[2][1].value = 0.98;
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .right = old_seconds}}))[2], Verdict::undecided);
    // On either side.
    seconds[2][1].value = 1.02;
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .right = old_seconds}}))[2], Verdict::undecided);
    seconds[2][1].value = 1.04;
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .right = old_seconds}}))[2], Verdict::does_not_hold);
}

// Both err by 0.5 give or take 0.1, and for each seed the new one by a little more.
TEST(SystematicClaims, AreDecidedPixelByPixel) {
    auto experiment = std::make_shared<Experiment>();
    experiment->runs = {{.method = "old"}, {.method = "new", .proposed = true}};
    experiment->settings = {{.scene = "a", .make = {}}};
    ExperimentResult result;
    SettingResult& setting = result.settings.emplace_back();
    setting.settings.width = 2;
    setting.runs.resize(2);
    const PixelSquares old_squares{{0.25, 0.0}, {{0.29, 0.0}, {0.25, 0.01}, {0.21, 0.0}}};
    const PixelSquares more{{0.002, 0.001}, {{0.002, 0.001}, {0.002, 0.0012}, {0.002, 0.0008}}};
    setting.runs[0].squares[Metric::systematic] = old_squares;
    setting.runs[1].squares[Metric::systematic] = difference(old_squares, -1.0, more);
    for (RunResult& run : setting.runs) run.metrics[Metric::systematic] = {0.5, 0.1};
    const auto check = [&](double factor) {
        const Comparison worse{.left = {Metric::systematic}, .sign = greater, .right = Term{Metric::systematic, "old", factor}};
        const Figure figure{.name = "0000-1",
                            .title = "",
                            .shows = "",
                            .experiment = experiment,
                            .claims = {{.quote = "It is worse.", .source = "", .comparisons = {worse}}}};
        return check_claims(figure, result).at(0).checks.at(0);
    };
    EXPECT_EQ(check(1.0).verdict, Verdict::holds);
    EXPECT_THAT(check(1.0).measured, testing::HasSubstr("pixel by pixel the squares differ by 0.0015 ± "));
    EXPECT_EQ(check(1.5).verdict, Verdict::does_not_hold);
    setting.runs[1].squares = setting.runs[0].squares;
    EXPECT_EQ(check(1.0).verdict, Verdict::does_not_hold);
}

// Frames that take turns on a machine that gets slower: each pair says the same.
TEST_F(Claims, AreDecidedSeedBySeed) {
    seconds = {{{2.0, 0.58, 2}, {2.1, 0.58, 2}}};
    const std::vector<Comparison> slower = {{.left = new_seconds, .sign = greater, .right = old_seconds}};
    EXPECT_EQ(verdicts(check(slower))[0], Verdict::undecided);
    by_seed = {{1.0, 2.0, 3.0}, {1.09, 2.1, 3.11}};
    EXPECT_EQ(verdicts(check(slower))[0], Verdict::holds);
    // Mean 0.1, standard error 0.0289: 3.46 of them, and of three seeds chance makes 4.3.
    by_seed[1] = {1.05, 2.1, 3.15};
    EXPECT_EQ(verdicts(check(slower))[0], Verdict::undecided);
    by_seed = {{0.5, 0.5, 0.5}, {0.2, 0.3, 0.25}};
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .number = 0.4}}))[0], Verdict::holds);
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .number = 0.3}}))[0], Verdict::undecided);
    // 0.4, 0.6, 0.5 of the old one's.
    Term ratio = new_seconds;
    ratio.over_run = "old";
    EXPECT_EQ(verdicts(check({{.left = ratio, .sign = greater, .number = 0.2}}))[0], Verdict::holds);
    EXPECT_EQ(verdicts(check({{.left = ratio, .sign = greater, .number = 0.3}}))[0], Verdict::undecided);
}

TEST_F(Claims, OneUndecidedCheckLeavesTheClaimUndecided) {
    seconds[3] = {{1.0, 0.01}, {1.001, 0.01}};
    EXPECT_EQ(check({{.left = new_seconds, .right = old_seconds}})[0].verdict, Verdict::undecided);
}

TEST_F(Claims, EqualExactFiguresAreNotLess) {
    seconds = {{{1.0, 0.0}, {1.0, 0.0}}};
    EXPECT_EQ(check({{.left = new_seconds, .right = old_seconds}})[0].verdict, Verdict::does_not_hold);
    EXPECT_EQ(check({{.left = new_seconds, .sign = greater, .right = old_seconds}})[0].verdict, Verdict::does_not_hold);
}

TEST_F(Claims, NumbersAndFactors) {
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .number = 0.55}}))[0], Verdict::holds);
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .sign = greater, .number = 0.55}}))[0], Verdict::does_not_hold);
    Term half = old_seconds;
    half.factor = 0.4;
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .right = half}}))[0], Verdict::does_not_hold);
    EXPECT_EQ(verdicts(check({{.left = new_seconds, .right = half}}))[1], Verdict::holds);
}

TEST_F(Claims, TrendsAreOfEachScene) {
    const auto results = check({{.left = old_seconds, .sign = greater, .right = old_seconds, .where = last_to_first}});
    EXPECT_EQ(results[0].run, "");  // It names its run.
    EXPECT_THAT(verdicts(results), ElementsAre(Verdict::holds, Verdict::undecided));
    EXPECT_EQ(results[0].checks[0].statement, "frame of old at 8 samples > frame of old at 4 samples");
}

TEST_F(Claims, RatiosOfRuns) {
    Term ratio = old_seconds;
    ratio.over_run = kProposed;
    // 2.0 / 0.6 = 3.33 against 1.0 / 0.5 = 2; 1 / 1.5 against 1 / 0.97.
    EXPECT_THAT(verdicts(check({{.left = ratio, .sign = greater, .right = ratio, .where = last_to_first}})),
                ElementsAre(Verdict::holds, Verdict::does_not_hold));
}

TEST_F(Claims, OfOneScene) {
    const auto results = check({{.left = new_seconds, .right = old_seconds, .scene = "a"}});
    EXPECT_THAT(verdicts(results), ElementsAre(Verdict::holds, Verdict::holds));
}

TEST_F(Claims, AboutWhatIsNotMeasuredIsABug) {
    EXPECT_THROW(check({{.left = {Metric::flip}, .number = 1.0}}), Error);
    EXPECT_THROW(check({{.left = {Metric::seconds, "other"}, .number = 1.0}}), Error);
}

// A curve through 1 s and 4 s with errors 0.4 and 0.1 falls with the inverse of the seconds: 0.2 after 2 s.
TEST(ClaimsOfCurves, AreReadAfterTheTimeOfARun) {
    const auto verdict = [](double seconds, double error) {
        auto experiment = std::make_shared<Experiment>();
        experiment->runs = {{.method = "tsm", .label = "fast", .curve = "tsm"},
                            {.method = "tsm", .label = "slow", .curve = "tsm"},
                            {.method = "new"}};
        experiment->settings.push_back({.scene = "a", .make = {}});
        ExperimentResult result;
        SettingResult& setting = result.settings.emplace_back();
        for (const auto& [s, e] : {std::pair(1.0, 0.4), std::pair(4.0, 0.1), std::pair(seconds, error)})
            setting.runs.emplace_back().metrics = {{Metric::seconds, {s, 0.0}}, {Metric::error, {e, 0.001}}};
        const Comparison better{.left = {Metric::error, "new"},
                                .right = Term{.metric = Metric::error, .run = "tsm", .at_time_of = "new"}};
        const Figure figure{.name = "0000-1",
                            .title = "",
                            .shows = "",
                            .experiment = experiment,
                            .claims = {{.quote = "", .source = "", .comparisons = {better}}}};
        return check_claims(figure, result)[0].verdict;
    };
    EXPECT_EQ(verdict(2.0, 0.19), Verdict::holds);
    EXPECT_EQ(verdict(2.0, 0.21), Verdict::does_not_hold);
    EXPECT_EQ(verdict(2.0, 0.2), Verdict::undecided);
    EXPECT_EQ(verdict(0.5, 0.01), Verdict::undecided) << "before the curve";
    EXPECT_EQ(verdict(5.0, 0.01), Verdict::undecided) << "after it";
}

}  // namespace
}  // namespace gnomon::reproduce
