// SPDX-License-Identifier: Apache-2.0
// raster/analytic at texel centres: a triangle has a range at just those times at which the oracle sees it there, and the
// depths at its ends are the oracle's.
#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "lists.hpp"
#include "soup.hpp"
#include "stage_test.hpp"
#include "stages/s_buffer.hpp"

namespace gnomon::test {
namespace {

using Lists = std::vector<std::vector<ExitRange>>;

class AnalyticRangesTest : public StageTest {
protected:
    Lists lists_of(const Soup& soup) {
        const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), soup.segments());
        const Layout layout = with_ranges(find_layout("array"), true);
        SBuffer s_buffer(device(), programs(),
                         walk_bins(programs(), {geometry, bins}, layout.stage("raster/analytic"), soup.orthographic), layout);
        const std::vector<Band> bands = s_buffer.bands(1ull << 40);
        EXPECT_EQ(bands.size(), 1u);
        s_buffer.fill(bands[0]);
        Lists lists = read_exit_ranges(device(), programs(), s_buffer, bands[0]);
        uint64_t ranges = 0;
        for (const auto& list : lists) ranges += list.size();
        EXPECT_EQ(ranges, s_buffer.range_count());
        return lists;
    }
};

/// How near to zero an edge function may be for its sign to be rounding: a few ulps of the products that it consists of.
bool is_rounding(const oracle::MovingTriangle& triangle, double x, double y, double s) {
    glm::dvec2 at[3], size[3];
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec4 &a = triangle.start[i], &b = triangle.end[i], p = a + s * (b - a);
        at[i] = {p.x - x * p.w, p.y - y * p.w};
        const double w = std::max(std::fabs(a.w), std::fabs(b.w));
        size[i] = {std::max(std::fabs(a.x), std::fabs(b.x)) + std::fabs(x) * w,
                   std::max(std::fabs(a.y), std::fabs(b.y)) + std::fabs(y) * w};
    }
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3;
        const double edge = at[i].x * at[j].y - at[j].x * at[i].y;
        if (std::fabs(edge) < 1e-6 * (size[i].x * size[j].y + size[j].x * size[i].y)) return true;
    }
    return false;
}

struct Checked {
    uint64_t seen = 0, unseen = 0, rounding = 0, depths = 0;
    uint64_t missed = 0, invented = 0, wrong_depth = 0;
};

/// Metres along the axis at which the oracle sees the triangle.
double metres(const Soup& soup, const oracle::Surface& surface) {
    return soup.orthographic ? surface.depth : -1.0 / surface.depth;
}

void check_texel(const Soup& soup, uint32_t segment, const glm::dvec2& centre, const std::vector<ExitRange>& list,
                 std::mt19937& random, Checked& checked) {
    std::unordered_multimap<uint32_t, ExitRange> by_entry;
    for (const ExitRange& r : list) by_entry.emplace(r.entry, r);
    std::uniform_real_distribution<double> any_time(0.0, 1.0);
    const float lowest = soup.orthographic ? -3.4e38f : 0.0f;
    for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const oracle::MovingTriangle triangle = soup.triangle(t, segment);
        // A few times, and just inside of every range.
        std::vector<double> times = {any_time(random), any_time(random), any_time(random)};
        for (const ExitRange& r : list) {
            if ((r.entry & ~shared::kReversed) != t) continue;
            const double enter = double(r.enter) * soup.segments() - segment,
                         leave = double(r.leave) * soup.segments() - segment;
            times.push_back(enter + 0.01 * (leave - enter));
            times.push_back(leave - 0.01 * (leave - enter));
        }
        for (double s : times) {
            if (is_rounding(triangle, centre.x, centre.y, s)) {
                ++checked.rounding;
                continue;
            }
            const std::optional<oracle::Surface> surface = surface_at(triangle, centre.x, centre.y, s);
            const double time = (segment + s) / soup.segments();
            for (bool positive : {true, false}) {
                const auto [begin, end] = by_entry.equal_range(positive ? t : t | shared::kReversed);
                const auto range =
                    std::find_if(begin, end, [&](const auto& r) { return r.second.enter <= time && time <= r.second.leave; });
                const bool expected = surface && surface->positive == positive;
                ++(expected ? checked.seen : checked.unseen);
                if (expected && range == end) ++checked.missed;
                // A triangle that passes through the eye itself is behind it from then on; its range's depth, positive at one
                // end and negative at the other, says about when.
                if (!expected && range != end && std::min(range->second.enter_depth, range->second.exit_depth) > lowest)
                    ++checked.invented;
            }
        }
        for (const ExitRange& r : list) {
            if ((r.entry & ~shared::kReversed) != t) continue;
            // The depth at both ends, against the oracle a little inside.
            for (bool leaving : {false, true}) {
                const double at_end = double(leaving ? r.leave : r.enter),
                             inside = at_end + (leaving ? -1e-4 : 1e-4) * double(r.leave - r.enter);
                const double s = inside * soup.segments() - segment;
                if (is_rounding(triangle, centre.x, centre.y, s)) continue;
                const std::optional<oracle::Surface> surface = surface_at(triangle, centre.x, centre.y, s);
                if (!surface) continue;
                // How far the depth can go meanwhile.
                const std::optional<oracle::Surface> middle =
                    surface_at(triangle, centre.x, centre.y, 0.5 * double(r.enter + r.leave) * soup.segments() - segment);
                if (!middle) continue;
                const double depth = metres(soup, *surface), change = std::fabs(depth - metres(soup, *middle));
                ++checked.depths;
                const double found = double(leaving ? r.exit_depth : r.enter_depth);
                if (std::fabs(found - depth) > 0.2 * change + 1e-2 * std::fabs(depth)) ++checked.wrong_depth;
            }
        }
    }
}

TEST_F(AnalyticRangesTest, AreTheOraclesStays) {
    std::mt19937 random(51);
    const struct { uint32_t width, height, segments; } cases[] = {{24, 19, 1}, {16, 16, 3}, {1, 1, 1}};
    for (const auto& c : cases) {
        for (bool orthographic : {false, true}) {
            SCOPED_TRACE(testing::Message()
                         << c.width << "x" << c.height << ", " << c.segments << " segments, orthographic " << orthographic);
            Soup soup(c.segments, c.width, c.height, orthographic);
            soup.add_prisms(10 * oracle::kPrismKinds, random);
            const Lists lists = lists_of(soup);
            const uint32_t tiles_x = (c.width + 7) / 8;
            Checked checked;
            uint64_t outside = 0;
            for (size_t i = 0; i < lists.size(); ++i) {
                const auto item = static_cast<uint32_t>(i / shared::kTileTexels), tile = item / c.segments,
                           segment = item % c.segments;
                const glm::uvec2 texel(tile % tiles_x * 8 + i % 8, tile / tiles_x * 8 + i / 8 % 8);
                if (texel.x >= c.width || texel.y >= c.height) {
                    outside += lists[i].size();
                    continue;
                }
                const glm::dvec2 centre = glm::dvec2(texel) + 0.5 - 0.5 * glm::dvec2(c.width, c.height);
                check_texel(soup, segment, centre, lists[i], random, checked);
            }
            EXPECT_EQ(outside, 0u);
            EXPECT_EQ(checked.missed, 0u) << "of " << checked.seen;
            EXPECT_EQ(checked.invented, 0u) << "of " << checked.unseen;
            // Where a triangle is nearly edge-on its depth is mostly rounding.
            EXPECT_LE(checked.wrong_depth, checked.depths / 1000) << "of " << checked.depths;
            EXPECT_GT(checked.seen, 50u);
            EXPECT_LT(checked.rounding, (checked.seen + checked.unseen) / 4);
        }
    }
}

// One edge rises over the centre and sinks again: at x = 0 it is at y = 16 s (1 - s) - 3, which is zero at 1/4 and 3/4.
TEST_F(AnalyticRangesTest, AllStaysOfATriangleAreKept) {
    Soup soup(1, 1, 1, true);
    oracle::Prism prism;
    prism.start = {glm::vec4(-3, 9, 2, 1), glm::vec4(1, -7, 2, 1), glm::vec4(0, 100, 2, 1)};
    prism.end = {glm::vec4(-1, -7, 4, 1), glm::vec4(3, 9, 4, 1), glm::vec4(0, 100, 4, 1)};
    soup.add_prism(prism);
    const std::vector<ExitRange> ranges = lists_of(soup)[0];
    ASSERT_EQ(ranges.size(), 2u);
    const float expected[2][4] = {{0.0f, 0.25f, 2.0f, 2.5f}, {0.75f, 1.0f, 3.5f, 4.0f}};
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_FLOAT_EQ(ranges[i].enter, expected[i][0]);
        EXPECT_FLOAT_EQ(ranges[i].leave, expected[i][1]);
        EXPECT_FLOAT_EQ(ranges[i].enter_depth, expected[i][2]);
        EXPECT_FLOAT_EQ(ranges[i].exit_depth, expected[i][3]);
    }
}

}  // namespace
}  // namespace gnomon::test
