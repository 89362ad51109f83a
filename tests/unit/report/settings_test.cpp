// SPDX-License-Identifier: Apache-2.0
// Which measurements belong together, and which are on the front.
#include "report/settings.hpp"

#include <gmock/gmock.h>

namespace gnomon::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

Case measured(const std::string& scene, const std::string& layout, std::vector<std::string> values, double query_ms = 1.0) {
    Case c;
    c.name = scene + "/" + layout;
    c.scene = scene;
    c.layout = layout;
    c.values = std::move(values);
    c.stages["query"] = {query_ms, query_ms, query_ms, query_ms, 1};
    return c;
}

// Time falls as bytes grow but for 2, which 1 beats in both, 4, which is as fast as 3 and larger, and 5, as small as 0 and
// slower.
TEST(ParetoFront, IsWhatNothingBeats) {
    EXPECT_THAT(pareto_front({{1, 9}, {2, 5}, {3, 6}, {4, 2}, {5, 2}, {1, 10}}), ElementsAre(0, 1, 3));
    EXPECT_THAT(pareto_front({{7, 1}, {3, 4}}), ElementsAre(1, 0));
    EXPECT_THAT(pareto_front({{1, 1}, {2, 2}, {3, 3}}), ElementsAre(0));
    EXPECT_THAT(pareto_front({}), IsEmpty());
}

TEST(ParetoFront, HasAllThatAreEqual) { EXPECT_THAT(pareto_front({{2, 2}, {1, 3}, {2, 2}}), ElementsAre(1, 0, 2)); }

TEST(ParetoFront, IsOfLayoutsThatAnswerAll) {
    Setting setting;
    Case slow = measured("s", "slow", {}, 3.0), null = measured("s", "null", {}, 0.1), lost = measured("s", "fixed", {}, 1.0),
         again = measured("s", "slow", {}, 2.0), unknown = measured("s", "unknown", {}, 1.0),
         wrong = measured("s", "wrong", {}, 1.0);
    again.again = true;
    slow.counts = {{"map_bytes", 10.0}, {"lost", 0.0}};
    null.counts = {{"map_bytes", 0.0}};
    lost.counts = {{"map_bytes", 5.0}, {"lost", 1.0}};
    again.counts = wrong.counts = slow.counts;
    slow.same_picture = true;
    wrong.same_picture = false;
    setting.cases = {&slow, &null, &lost, &again, &unknown, &wrong};
    const std::vector<const Case*> cases = cases_with_bytes(setting);
    EXPECT_THAT(cases, ElementsAre(&slow, &null, &lost, &wrong));
    EXPECT_THAT(front_of(cases), ElementsAre(&slow));
}

TEST(Settings, DifferInSceneAndAxes) {
    BenchFile file;
    file.axes = {{"res", {"1", "2"}}, {"cells", {"4"}}};
    file.cases = {measured("a", "x", {"1", "4"}), measured("a", "x", {"2", "4"}), measured("b", "x", {"1", "4"}),
                  measured("a", "y", {"1", "4"})};
    const std::vector<Setting> settings = settings_of(file);
    ASSERT_THAT(settings, SizeIs(3));
    EXPECT_THAT(settings[0].cases, ElementsAre(&file.cases[0], &file.cases[3]));
    EXPECT_THAT(settings[1].cases, ElementsAre(&file.cases[1]));
    EXPECT_THAT(settings[2].cases, ElementsAre(&file.cases[2]));
    EXPECT_EQ(settings[1].title(), "a, res 2");  // cells is the same everywhere.
}

TEST(Sweeps, GoAlongOneAxisEach) {
    BenchFile file;
    file.axes = {{"res", {"1", "2", "3"}}, {"method", {"m", "n"}}, {"cells", {"4"}}};
    file.cases = {measured("a", "x", {"1", "m", "4"}), measured("a", "x", {"3", "m", "4"}),
                  measured("a", "y", {"2", "m", "4"}), measured("a", "x", {"1", "n", "4"}),
                  measured("a", "x", {"1", "m", "4"}), measured("b", "x", {"1", "m", "4"})};
    file.cases[4].again = true;
    const std::vector<Sweep> sweeps = sweeps_of(file);
    // Along res with m; with n and in b there is one value only. Along method at res 1 only.
    ASSERT_THAT(sweeps, SizeIs(2));
    EXPECT_EQ(sweeps[0].axis, 0u);
    EXPECT_EQ(sweeps[0].title(), "a, method m");
    EXPECT_THAT(sweeps[0].layouts.at("x"), ElementsAre(&file.cases[0], nullptr, &file.cases[1]));
    EXPECT_THAT(sweeps[0].layouts.at("y"), ElementsAre(nullptr, &file.cases[2], nullptr));
    EXPECT_EQ(sweeps[1].axis, 1u);
    EXPECT_EQ(sweeps[1].title(), "a, res 1");
    EXPECT_THAT(sweeps[1].layouts.at("x"), ElementsAre(&file.cases[0], &file.cases[3]));
}

TEST(Sweeps, KnowNumbers) {
    EXPECT_THAT(numbers_of({"256", "512.5", "1e4"}), ElementsAre(256.0, 512.5, 1e4));
    for (const std::vector<std::string>& others :
         {std::vector<std::string>{"1", "x"}, {"2", "1"}, {"0", "1"}, {"1", "2k"}, {"1", "nan"}, {"1", ""}})
        EXPECT_THAT(numbers_of(others), IsEmpty()) << testing::PrintToString(others);
}

}  // namespace
}  // namespace gnomon::report
