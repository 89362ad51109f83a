// SPDX-License-Identifier: Apache-2.0
// The list of figures is sound: names, methods and their parameters, claims about what is measured.
#include "reproduce/figure.hpp"

#include <gmock/gmock.h>

#include <gnomon/error.hpp>
#include <set>

#include "methods/method.hpp"
#include "reproduce/claim.hpp"

namespace gnomon::reproduce {
namespace {

TEST(Figures, NamesAreDifferentAndFound) {
    std::set<std::string> names;
    for (const Figure& figure : figures()) {
        EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
        EXPECT_EQ(&find_figure(figure.name), &figure);
        EXPECT_FALSE(paper_of(figure.name).empty());
    }
    EXPECT_THROW(find_figure("2016-1"), Error);
}

TEST(Figures, RunsAreOfMethodsThatExist) {
    for (const Figure& figure : figures()) {
        SCOPED_TRACE(figure.name);
        std::set<std::string> labels;
        for (const reproduce::Run& run : figure.experiment->runs) {
            EXPECT_TRUE(labels.insert(run.label).second) << run.label;
            EXPECT_NO_THROW(check_parameters(find_method(run.method), run.parameters)) << run.label;
        }
        EXPECT_GE(labels.size(), 2u);
        ASSERT_FALSE(figure.experiment->settings.empty());
    }
}

// With any measurements at all, every claim can be checked and is checked somewhere.
TEST(Figures, ClaimsAreAboutWhatIsMeasured) {
    for (const Figure& figure : figures()) {
        SCOPED_TRACE(figure.name);
        ExperimentResult result;
        for (size_t i = 0; i < figure.experiment->settings.size(); ++i) {
            SettingResult& setting = result.settings.emplace_back();
            for (const reproduce::Run& run : figure.experiment->runs) {
                auto& measured = setting.runs.emplace_back().metrics;
                for (const MetricInfo& m : metrics()) {
                    const bool of_reference = m.metric <= Metric::flip;
                    const bool of_ranges = m.metric == Metric::ranges;
                    if (of_reference && !figure.experiment->with_reference) continue;
                    if (of_ranges && !find_method(run.method).has_s_buffer()) continue;
                    if (m.metric == Metric::equation_2 && run.method != "dtr" && run.method != "temporal") continue;
                    measured[m.metric] = {1.0 + double(setting.runs.size()), 0.0};  // A curve needs different seconds.
                }
            }
        }
        const std::vector<ClaimResult> claims = check_claims(figure, result);
        EXPECT_GE(claims.size(), figure.claims.size());
        for (const ClaimResult& claim : claims) EXPECT_FALSE(claim.checks.empty()) << claim.quote;
    }
}

}  // namespace
}  // namespace gnomon::reproduce
