// SPDX-License-Identifier: Apache-2.0
// Triangulated prisms: their fragments against the oracle and by hand, and the ranges that the device pairs from them.
#include "math/prism.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "lists.hpp"
#include "oracle/prism_surface.hpp"
#include "soup.hpp"
#include "stage_test.hpp"
#include "stages/prism.hpp"

namespace gnomon::test {
namespace {

using shared::PrismFragments;

std::vector<oracle::Fragment> sorted(std::vector<oracle::Fragment> fragments) {
    std::sort(fragments.begin(), fragments.end(), [](const oracle::Fragment& a, const oracle::Fragment& b) {
        return a.metres != b.metres ? a.metres < b.metres : a.time < b.time;
    });
    return fragments;
}

std::vector<oracle::Fragment> list_of(const PrismFragments& f) {
    std::vector<oracle::Fragment> result;
    for (uint32_t i = 0; i < shared::kPrismTriangles; ++i) {
        if ((f.covered >> i & 1u) != 0) result.push_back({double(f.metres[i]), double(f.time[i])});
    }
    return sorted(result);
}

/// Of the prism, at a point given relative to (cx, cy).
std::vector<oracle::Fragment> fragments_of(const oracle::Prism& p, bool orthographic, glm::vec2 centre, glm::vec2 at) {
    const shared::CellTriangle c{p.start[0], p.start[1], p.start[2], p.end[0], p.end[1], p.end[2]};
    return list_of(
        fragments_at(prism_surface(c, centre.x, centre.y, orthographic), at.x, at.y, orthographic ? -shared::kFarthest : 0.0f));
}

oracle::Prism flat(std::array<glm::vec3, 3> start, std::array<glm::vec3, 3> end) {
    oracle::Prism p;
    for (size_t i = 0; i < 3; ++i) {
        p.start[i] = glm::vec4(start[i], 1.0f);
        p.end[i] = glm::vec4(end[i], 1.0f);
    }
    return p;
}

void expect_fragments(const std::vector<oracle::Fragment>& found, const std::vector<oracle::Fragment>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].metres, expected[i].metres, 1e-5) << i;
        EXPECT_NEAR(found[i].time, expected[i].time, 1e-5) << i;
    }
}

// 0 <= x - 4 t <= 2 - y at the point, and depth 1 + 2 t.
TEST(PrismTest, TranslationHasTheTrueTimesAndDepths) {
    const oracle::Prism p = flat({glm::vec3(0, 0, 1), {2, 0, 1}, {0, 2, 1}}, {glm::vec3(4, 0, 3), {6, 0, 3}, {4, 2, 3}});
    expect_fragments(fragments_of(p, true, {0, 0}, {3.0f, 0.25f}), {{1.625, 0.3125}, {2.5, 0.75}});
    // Near the ends the caps are met: entered before the start, left after the end.
    expect_fragments(fragments_of(p, true, {0, 0}, {0.5f, 0.25f}), {{1.0, 0.0}, {1.25, 0.125}});
    expect_fragments(fragments_of(p, true, {2, 0}, {3.5f, 0.25f}), {{2.875, 0.9375}, {3.0, 1.0}});
    expect_fragments(fragments_of(p, true, {0, 0}, {3.0f, 3.0f}), {});
}

// At rest: both caps, the whole time.
TEST(PrismTest, RestIsTheWholeTime) {
    const std::array<glm::vec3, 3> corners = {glm::vec3(-3, -3, 2), {5, -3, 2}, {-3, 5, 2}};
    const oracle::Prism p = flat(corners, corners);
    expect_fragments(fragments_of(p, true, {0, 0}, {0.1f, 0.2f}), {{2.0, 0.0}, {2.0, 1.0}});
    expect_fragments(fragments_of(p, true, {0, 0}, {4.0f, 4.0f}), {});
}

// The edge (-1, 0) (1, 0) turns by 90 degrees and crosses itself in the origin: two triangles with time 1/2 there. The point
// (-0.5, -0.125) lies in the one between (-1, 0), the origin and (0, -1); its weights are 0.5, 0.375 and 0.125.
TEST(PrismTest, CrossingEdgeMeetsItselfAtHalfTime) {
    const oracle::Prism p = flat({glm::vec3(-1, 0, 1), {1, 0, 1}, {0, 5, 1}}, {glm::vec3(0, -1, 3), {0, 1, 3}, {-5, 0, 3}});
    const shared::CellTriangle c{p.start[0], p.start[1], p.start[2], p.end[0], p.end[1], p.end[2]};
    const shared::PrismSurface s = prism_surface(c, 0.0f, 0.0f, true);
    EXPECT_FALSE(s.side[0].crossed);
    EXPECT_FALSE(s.side[1].crossed);
    EXPECT_TRUE(s.side[2].crossed);
    EXPECT_EQ(oracle::triangulate(oracle::exact(p), true).triangles.size(), 12u);
    const PrismFragments f = fragments_at(s, -0.5f, -0.125f, -shared::kFarthest);
    ASSERT_TRUE(f.covered >> 10 & 1u);  // The first triangle of side 2.
    EXPECT_NEAR(f.time[10], 0.375 * 0.5 + 0.125 * 1.0, 1e-6);
    EXPECT_NEAR(f.metres[10], 0.5 * 1.0 + 0.375 * 2.0 + 0.125 * 3.0, 1e-6);
}

TEST(PrismTest, FragmentsAreTheOraclesAndEven) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-4.0f, 4.0f);
    uint64_t points = 0, met = 0, differ = 0, odd = 0, in_front = 0;
    for (const bool orthographic : {false, true}) {
        for (int i = 0; i < 40 * oracle::kPrismKinds; ++i) {
            const auto kind = static_cast<oracle::PrismKind>(i % oracle::kPrismKinds);
            const oracle::Prism p = oracle::make_prism(kind, orthographic, glm::dvec2(16.0, 24.0), random);
            const oracle::PrismSurface surface = oracle::triangulate(oracle::exact(p), orthographic);
            const bool front = std::all_of(p.start.begin(), p.start.end(), [](const auto& v) { return v.w > 0.0f; }) &&
                               std::all_of(p.end.begin(), p.end.end(), [](const auto& v) { return v.w > 0.0f; });
            for (int k = 0; k < 40; ++k) {
                const glm::vec2 at(place(random), place(random));
                const std::vector<oracle::Fragment> found = fragments_of(p, orthographic, {16.0f, 24.0f}, at);
                if (front) {
                    ++in_front;
                    odd += found.size() % 2;
                }
                const oracle::FragmentsAt truth = fragments_at(surface, 16.0 + double(at.x), 24.0 + double(at.y), orthographic);
                if (!surface.certain || !truth.certain) continue;
                ++points;
                met += truth.fragments.empty() ? 0 : 1;
                const std::vector<oracle::Fragment> expected = sorted(truth.fragments);
                bool same = found.size() == expected.size();
                for (size_t j = 0; same && j < found.size(); ++j) {
                    same = std::fabs(found[j].metres - expected[j].metres) <= 2e-3 * (1.0 + std::fabs(expected[j].metres)) &&
                           std::fabs(found[j].time - expected[j].time) <= 2e-3;
                }
                differ += same ? 0 : 1;
            }
        }
    }
    EXPECT_GT(met, 1000u);
    EXPECT_GT(points, 10000u);
    EXPECT_LE(differ, points / 2000) << "of " << points;
    EXPECT_LE(odd, in_front / 10000) << "of " << in_front;
}

struct Paired {
    uint32_t triangle;
    double enter, leave, enter_depth, exit_depth;
};

class PrismRangesTest : public StageTest {};

// Those without area leave fragments by rounding only.
void add_prisms_with_area(Soup& soup, std::mt19937& random) {
    for (int i = 0; i < 10 * oracle::kPrismKinds; ++i) {
        const auto kind = static_cast<oracle::PrismKind>(i % oracle::kPrismKinds);
        if (kind == oracle::PrismKind::degenerate) continue;
        const glm::dvec2 texel(random() % soup.width, random() % soup.height);
        soup.add_prism(make_prism(kind, soup.orthographic, texel - 0.5 * glm::dvec2(soup.width, soup.height), random));
    }
}

/// But for rounding, which the weights of fast prisms magnify.
bool is_near(const ExitRange& r, const Paired& e) {
    const auto close = [](float found, double expected, double tolerance) {
        return std::fabs(double(found) - expected) <= tolerance * (1.0 + std::fabs(expected));
    };
    return r.entry == e.triangle && close(r.enter, e.enter, 1e-4) && close(r.leave, e.leave, 1e-4) &&
           close(r.enter_depth, e.enter_depth, 1e-2) && close(r.exit_depth, e.exit_depth, 1e-2);
}

// Each texel's ranges, paired on the host from the host's fragments.
TEST_F(PrismRangesTest, AreTheFragmentsOfATexelTwoAndTwo) {
    std::mt19937 random(23);
    const struct { uint32_t width, height, segments; } cases[] = {{24, 19, 1}, {16, 16, 3}, {1, 1, 1}};
    for (const auto& c : cases) {
        for (const bool orthographic : {false, true}) {
            SCOPED_TRACE(testing::Message()
                         << c.width << "x" << c.height << ", " << c.segments << " segments, orthographic " << orthographic);
            Soup soup(c.segments, c.width, c.height, orthographic);
            add_prisms_with_area(soup, random);
            const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
            const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), soup.segments(), Listing::bounds);
            const Layout layout = with_ranges(find_layout("array"), true);
            SBuffer s_buffer(device(), programs(),
                             pair_fragments(device(), programs(), {geometry, bins}, layout.stage("raster/prism"),
                                            {.orthographic = orthographic}, 1ull << 40),
                             layout);
            const Band band = s_buffer.bands(1ull << 40).at(0);
            s_buffer.fill(band);
            const auto lists = read_exit_ranges(device(), programs(), s_buffer, band);
            const uint32_t tiles_x = (c.width + 7) / 8;
            uint64_t fragments = 0, left_over = 0, ranges = 0, differ = 0;
            for (size_t i = 0; i < lists.size(); ++i) {
                const auto item = static_cast<uint32_t>(i / shared::kTileTexels), tile = item / c.segments,
                           segment = item % c.segments;
                const glm::uvec2 texel(tile % tiles_x * 8 + i % 8, tile / tiles_x * 8 + i / 8 % 8);
                if (texel.x >= c.width || texel.y >= c.height) {
                    EXPECT_TRUE(lists[i].empty());
                    continue;
                }
                const glm::vec2 centre = glm::vec2(texel / 8u * 8u + 4u) - 0.5f * glm::vec2(c.width, c.height);
                std::vector<Paired> expected;
                for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
                    oracle::Prism p;
                    for (size_t v = 0; v < 3; ++v) {
                        const uint32_t vertex = soup.triangles[t][static_cast<int>(v)];
                        p.start[v] = soup.keys[segment][vertex];
                        p.end[v] = soup.keys[segment + 1][vertex];
                    }
                    const auto f = fragments_of(p, orthographic, centre, glm::vec2(texel % 8u) - 3.5f);
                    fragments += f.size();
                    left_over += f.size() % 2;
                    for (size_t k = 0; k + 1 < f.size(); k += 2) {
                        const bool in_order = f[k].time <= f[k + 1].time;
                        const oracle::Fragment &a = in_order ? f[k] : f[k + 1], &b = in_order ? f[k + 1] : f[k];
                        expected.push_back(
                            {t, (segment + a.time) / c.segments, (segment + b.time) / c.segments, a.metres, b.metres});
                    }
                }
                ranges += expected.size();
                bool same = lists[i].size() == expected.size();
                for (const Paired& e : expected) {
                    same = same &&
                           std::any_of(lists[i].begin(), lists[i].end(), [&](const ExitRange& r) { return is_near(r, e); });
                }
                differ += same ? 0 : 1;
            }
            EXPECT_LE(differ, lists.size() / 20) << "texels of " << lists.size();
            EXPECT_GT(ranges, 10u);
            const auto counts = s_buffer.counts();
            // Seen edge-on, prisms leave fragments by rounding; the device's are in their bounds.
            const auto about = [](uint64_t found, uint64_t expected) {
                return std::fabs(double(found) - double(expected)) <= 1.0 + 0.005 * double(expected);
            };
            EXPECT_TRUE(about(counts.at("fragments"), fragments)) << counts.at("fragments") << ", " << fragments;
            EXPECT_TRUE(about(counts.at("ranges"), ranges)) << counts.at("ranges") << ", " << ranges;
            if (orthographic) {
                EXPECT_LE(counts.at("fragments_left_over"), fragments / 500);
            }
            EXPECT_LE(counts.at("fragments_left_over"), left_over);

            // A block of items at a time: the same ranges.
            SBuffer cut(device(), programs(),
                        pair_fragments(device(), programs(), {geometry, bins}, layout.stage("raster/prism"),
                                       {.orthographic = orthographic}, 16 * fragments + 4096),
                        layout);
            EXPECT_EQ(cut.counts(), counts);
        }
    }
}

// More prisms over every texel of a tile than one dispatch may walk, and fragments than it may pair: at rest, each is a range.
TEST_F(PrismRangesTest, LongLists) {
    constexpr uint32_t kPrisms = 7000;
    static_assert(kPrisms > shared::kListChunk);
    Soup soup(1, 8, 8, true);
    for (uint32_t i = 0; i < kPrisms; ++i) {
        const float depth = 1.0f + static_cast<float>(i) / kPrisms;
        glm::uvec3 corners;
        const glm::vec2 places[] = {{-20.0f, -20.0f}, {60.0f, -20.0f}, {-20.0f, 60.0f}};
        for (int v = 0; v < 3; ++v) {
            const glm::vec4 place(places[v], depth, 1.0f);
            corners[v] = soup.add_vertex({place, place});
        }
        soup.triangles.push_back(corners);
    }
    const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
    const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), soup.segments(), Listing::bounds);
    const Layout layout = with_ranges(find_layout("array"), true);
    SBuffer s_buffer(device(), programs(),
                     pair_fragments(device(), programs(), {geometry, bins}, layout.stage("raster/prism"),
                                    {.orthographic = soup.orthographic}, 1ull << 40),
                     layout);
    const Band band = s_buffer.bands(1ull << 40).at(0);
    s_buffer.fill(band);
    const auto counts = s_buffer.counts();
    EXPECT_EQ(counts.at("fragments"), 2u * kPrisms * 64u);
    EXPECT_EQ(counts.at("fragments_left_over"), 0u);
    uint64_t missing = 0, wrong = 0;
    for (const auto& list : read_exit_ranges(device(), programs(), s_buffer, band)) {
        std::vector<bool> seen(kPrisms);
        for (const ExitRange& r : list) {
            const float depth = 1.0f + static_cast<float>(r.entry) / kPrisms;
            wrong += std::fabs(r.enter_depth - depth) > 1e-5f || r.enter != 0.0f || r.leave != 1.0f ? 1 : 0;
            seen.at(r.entry) = true;
        }
        missing += static_cast<uint64_t>(std::count(seen.begin(), seen.end(), false));
    }
    EXPECT_EQ(missing, 0u);
    EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace gnomon::test
