// SPDX-License-Identifier: Apache-2.0
// Axes and marks of plots.
#include "reproduce/plot.hpp"

#include <gmock/gmock.h>

namespace gnomon::html {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Plots, TicksAreRoundAndReachTheMost) {
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

TEST(Plots, CurvesAreInPlace) {
    const std::string svg = line_plot("t", "x", "y", {{"run <1>", {{0.0, 0.0, 0.0}, {8.0, 8.0, 0.5}}}});
    EXPECT_THAT(svg, HasSubstr("<svg"));
    EXPECT_THAT(svg, HasSubstr("run &lt;1&gt;: 8 at 8"));
    // From the origin of the axes: 64 to the right, 48 above the lower edge.
    EXPECT_THAT(svg, HasSubstr("d=\"M64.0 252.0L"));
    EXPECT_THAT(svg, HasSubstr("class=\"error\""));
}

TEST(Plots, PartsOfABarAreSideBySide) {
    const std::string svg = bar_plot("t", "ms", {{"tsm", {2.0, 2.0}, 0.0, "4 ms"}}, true);
    EXPECT_THAT(svg, HasSubstr("class=\"c0\" x=\"190.0\""));
    EXPECT_THAT(svg, HasSubstr("class=\"c1\" x=\"360.0\""));
    EXPECT_THAT(svg, HasSubstr("4 ms"));
}

}  // namespace
}  // namespace gnomon::html
