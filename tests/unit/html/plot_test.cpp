// SPDX-License-Identifier: Apache-2.0
// Axes and marks of plots.
#include "html/plot.hpp"

#include <gmock/gmock.h>

#include <gnomon/error.hpp>

#include "html/bar_plot.hpp"
#include "html/line_plot.hpp"
#include "html/scale.hpp"
#include "html/svg.hpp"

namespace gnomon::html {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Scales, TicksAreRoundAndReachTheMost) {
    EXPECT_THAT(ticks(8.0), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
    EXPECT_THAT(ticks(32.0), ElementsAre(0, 5, 10, 15, 20, 25, 30, 35));
    EXPECT_THAT(ticks(0.0), testing::SizeIs(testing::Ge(2)));
    for (double most = 1e-7; most < 1e9; most *= 1.7) {
        const std::vector<double> t = ticks(most);
        EXPECT_GE(t.back(), most * (1.0 - 1e-9)) << most;
        EXPECT_LE(t.back(), most * 1.5) << most;
        EXPECT_GE(t.size(), 5u) << most;
        EXPECT_LE(t.size(), 10u) << most;
    }
}

TEST(Scales, LogarithmicTicksAreFewAndWithin) {
    EXPECT_THAT(logarithmic_ticks(0.9, 60.0), ElementsAre(1, 2, 5, 10, 20, 50));
    EXPECT_THAT(logarithmic_ticks(1.0, 10000.0), ElementsAre(1, 10, 100, 1000, 10000));
    for (double least = 1e-6; least < 1e6; least *= 7.3) {
        for (double factor = 1.05; factor < 1e15; factor *= 1.9) {
            const std::vector<double> t = logarithmic_ticks(least, least * factor);
            EXPECT_GE(t.size(), 2u) << least << " " << factor;
            EXPECT_LE(t.size(), 10u) << least << " " << factor;
            EXPECT_THAT(t, Each(testing::AllOf(testing::Ge(least * 0.999), testing::Le(least * factor * 1.001))));
        }
    }
}

TEST(Scales, PlacesAreEvenInTheirOwnSteps) {
    const Scale linear = Scale::linear(8.0, 100.0, 180.0);
    EXPECT_DOUBLE_EQ(linear.at(2.0), 120.0);
    EXPECT_DOUBLE_EQ(linear.at(99.0), 180.0);
    const Scale doubling = Scale::with_ticks({256.0, 512.0, 1024.0}, true, 0.0, 300.0);
    EXPECT_NEAR(doubling.at(1024.0) - doubling.at(512.0), doubling.at(512.0) - doubling.at(256.0), 1e-9);
    EXPECT_GT(doubling.at(256.0), 0.0);
    EXPECT_LT(doubling.at(1024.0), 300.0);
    const Scale same = Scale::logarithmic(3.0, 3.0, 0.0, 100.0);
    EXPECT_NEAR(same.at(3.0), 50.0, 1e-9);
}

TEST(Labels, AreShortenedByCharacters) {
    EXPECT_EQ(shortened("abc", 100.0), "abc");
    EXPECT_EQ(shortened("abcdefgh", 37.0), "abcd…");
    EXPECT_EQ(shortened("äöüäöüäö", 37.0), "äöüä…");
}

TEST(Legends, BreakRows) {
    using Kind = LegendEntry::Kind;
    EXPECT_EQ(legend({}, 0.0, 0.0, 100.0).height, 0.0);
    const Legend one = legend({{Kind::part, 0, "a"}, {Kind::curve, 1, "b"}}, 0.0, 0.0, 100.0);
    const Legend two = legend({{Kind::part, 0, "a"}, {Kind::curve, 1, "<long name>"}}, 0.0, 0.0, 100.0);
    EXPECT_EQ(two.height, 2.0 * one.height);
    EXPECT_THAT(two.content, HasSubstr("&lt;long na"));
}

TEST(Plots, CurvesAreInPlace) {
    const Plot plot =
        line_plot({.title = "t",
                   .x_title = "x",
                   .y_title = "y",
                   .series = {{.name = "run <1>", .points = {{0.0, 0.0, 0.0}, {8.0, 8.0, 0.5}}, .bands = {{0, 1}, {7, 9}}}}});
    EXPECT_THAT(figure(plot), HasSubstr("<svg"));
    EXPECT_THAT(plot.content, HasSubstr("run &lt;1&gt;: 8 at 8"));
    // From the origin of the axes: 64 to the right, 48 above the lower edge.
    EXPECT_THAT(plot.content, HasSubstr("d=\"M64.0 252.0L"));
    EXPECT_THAT(plot.content, HasSubstr("class=\"error\""));
    // There and back: above, and then below.
    EXPECT_THAT(plot.content, HasSubstr("class=\"band\" d=\"M64.0 228.0L"));
}

TEST(Plots, PartsOfABarAreSideBySide) {
    const Plot plot = bar_plot({.title = "t", .x_title = "ms", .bars = {{"tsm", {2.0, 2.0}, 0.0, "4 ms"}}, .by_part = true});
    // Left of it 3 characters of 7.2 and 16, right 4 of them and 16: 557.6 for 4.
    EXPECT_THAT(plot.content, HasSubstr("class=\"part c0\" x=\"37.6\""));
    EXPECT_THAT(plot.content, HasSubstr("class=\"part c1\" x=\"316.4\""));
    EXPECT_THAT(plot.content, HasSubstr("4 ms"));
}

TEST(Plots, StandAlone) {
    const std::string svg = svg_file(line_plot({.title = "a < b", .x_title = "x", .y_title = "y", .series = {}}));
    EXPECT_THAT(svg, HasSubstr("<title>a &lt; b</title>"));
    EXPECT_THAT(svg, Not(HasSubstr("var(")));
    EXPECT_EQ(
        without_variables("a { fill: var(--c1); stroke: var(--c0) }", ":root { --c0: #111; --c1: #222; } x { --c1: #333; }"),
        "a { fill: #222; stroke: #111 }");
    EXPECT_THROW(without_variables("var(--c2)", ":root { --c1: #222; }"), Error);
}

}  // namespace
}  // namespace gnomon::html
