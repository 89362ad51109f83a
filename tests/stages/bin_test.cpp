// SPDX-License-Identifier: Apache-2.0
// Setup and binning: each list holds every prism that the oracle sees in its tile and cell, in the orientation in which it is
// seen.
#include "stages/bin.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "lists.hpp"
#include "math/sample.h"
#include "soup.hpp"
#include "stage_test.hpp"

namespace gnomon::test {
namespace {

class BinTest : public StageTest {
protected:
    struct Result {
        Bins bins;
        std::vector<std::vector<uint32_t>> lists;
    };

    Result run(const Soup& soup, uint32_t cells, Part part = Part::whole) {
        const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        Result result{bin_prisms(device(), programs(), geometry, soup.view(), cells, Listing::swept, part), {}};
        result.lists = read_bins(device(), result.bins);
        return result;
    }

    /// Checks the lists; returns listed entries over needed ones.
    double expect_complete(const Soup& soup, uint32_t cells) {
        constexpr int kInstants = 6;
        const Result result = run(soup, cells);
        const shared::ViewGrid& grid = result.bins.grid;
        const uint32_t per_segment = cells / soup.segments();
        uint64_t listed = 0, needed = 0, missed = 0;
        size_t longest = 0;
        for (uint32_t item = 0; item < result.lists.size(); ++item) {
            const std::set<uint32_t> list(result.lists[item].begin(), result.lists[item].end());
            EXPECT_EQ(list.size(), result.lists[item].size()) << "an entry twice in list " << item;
            listed += list.size();
            longest = std::max(longest, list.size());
            const uint32_t cell = item % cells, tile = item / cells;
            const glm::dvec2 lower =
                8.0 * glm::dvec2(tile % grid.tiles_x, tile / grid.tiles_x) - 0.5 * glm::dvec2(soup.width, soup.height);
            for (uint32_t i = 0; i < soup.triangles.size(); ++i) {
                const oracle::MovingTriangle triangle = soup.triangle(i, cell / per_segment);
                std::set<uint32_t> entries;
                for (int step = 0; step <= kInstants; ++step) {
                    const double s = (cell % per_segment + double(step) / kInstants) / per_segment;
                    const std::optional<bool> positive = orientation_in(triangle, {lower, lower + 8.0}, s);
                    if (positive) entries.insert(*positive ? i : i | shared::kReversed);
                }
                needed += entries.size();
                for (uint32_t entry : entries) missed += list.count(entry) == 0 ? 1 : 0;
            }
        }
        EXPECT_EQ(missed, 0u) << "of " << needed;
        EXPECT_GT(needed, 100u);
        EXPECT_EQ(listed, result.bins.entry_count);
        EXPECT_EQ(longest, result.bins.longest);
        return double(listed) / double(needed);
    }
};

TEST_F(BinTest, ListsContainWhatTheOracleSees) {
    std::mt19937 random(11);
    for (bool orthographic : {false, true}) {
        for (const auto& [segments, cells] : std::multimap<uint32_t, uint32_t>{{1, 1}, {1, 4}, {1, 16}, {3, 3}, {3, 6}}) {
            SCOPED_TRACE(testing::Message() << segments << " segments, " << cells << " cells, orthographic " << orthographic);
            Soup soup(segments, 70, 45, orthographic);
            soup.add_prisms(220, random);
            const double ratio = expect_complete(soup, cells);
            std::printf("%s, %u segments, %u cells: %.2f entries listed for one needed\n",
                        orthographic ? "orthographic" : "perspective", segments, cells, ratio);
            EXPECT_LT(ratio, 3.0);
        }
    }
}

TEST_F(BinTest, SmallestImages) {
    std::mt19937 random(12);
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(8, 8), glm::uvec2(9, 1), glm::uvec2(1, 17)}) {
        Soup soup(1, size.x, size.y, true);
        soup.add_prisms(300, random);
        expect_complete(soup, 2);
    }
}

// The same lists in another order, of small prisms.
TEST_F(BinTest, WhatFacesTheEyeComesFirst) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> place(-70.0f, 70.0f), corner(-3.0f, 3.0f);
    Soup soup(1, 150, 77, false);
    for (int i = 0; i < 5000; ++i) {
        const glm::vec2 at(place(random), place(random));
        const auto vertex = [&] { return glm::vec4(at + glm::vec2(corner(random), corner(random)), -1.0f, 1.0f); };
        soup.add_prism({{vertex(), vertex(), vertex()}, {vertex(), vertex(), vertex()}});
    }
    const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
    const auto lists = [&](Listing listing) {
        return read_bins(device(), bin_prisms(device(), programs(), geometry, soup.view(), 4, listing));
    };
    // Pairs of neighbours in a list, the second of which alone faces the eye.
    const auto backward = [](const std::vector<std::vector<uint32_t>>& all) {
        uint64_t pairs = 0;
        for (const auto& list : all) {
            for (size_t i = 0; i + 1 < list.size(); ++i)
                pairs += list[i] < shared::kReversed && list[i + 1] >= shared::kReversed;
        }
        return pairs;
    };
    std::vector<std::vector<uint32_t>> as_swept = lists(Listing::swept), found = lists(Listing::facing_first);
    EXPECT_GT(backward(as_swept), 500u);
    EXPECT_EQ(backward(found), 0u);
    for (auto* all : {&as_swept, &found}) {
        for (auto& list : *all) std::sort(list.begin(), list.end());
    }
    EXPECT_EQ(found, as_swept);
}

// Of small prisms those that a sample meets, in its tile, and hardly any other.
TEST_F(BinTest, WhatNoSampleMeetsIsNotListed) {
    std::mt19937 random(19);
    std::uniform_real_distribution<float> x(-37.0f, 37.0f), y(-20.0f, 20.0f), corner(-0.25f, 0.25f), depth(1.0f, 5.0f);
    Soup soup(1, 75, 41, false);
    for (int i = 0; i < 600; ++i) {
        const glm::vec2 from(x(random), y(random)), to = i % 2 == 0 ? from : glm::vec2(x(random), y(random));
        const glm::vec2 w(depth(random), depth(random));
        oracle::Prism prism;
        for (int k = 0; k < 3; ++k) {
            const glm::vec2 at(corner(random), corner(random));
            prism.start[k] = {(from + at) * w.x, -1.0f, w.x};
            prism.end[k] = {(to + at) * w.y, -1.0f, w.y};
        }
        soup.add_prism(prism);
    }
    const Lattice lattice{3, 4};
    const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
    for (uint32_t cells : {1u, 2u, 3u}) {
        Bins bins = project_prisms(device(), programs(), geometry, soup.view(), cells);
        const Window whole{0, tiles_across(soup.view()) * tiles_down(soup.view())};
        list_prisms(device(), programs(), geometry, soup.view(), whole, Listing::swept, bins);
        const uint32_t swept = bins.entry_count;
        bins.lattice = lattice;
        list_prisms(device(), programs(), geometry, soup.view(), whole, Listing::swept, bins);
        const auto lists = read_bins(device(), bins);
        std::set<std::pair<uint32_t, uint32_t>> met;  // List and entry.
        for (uint32_t px_y = 0; px_y < soup.height; ++px_y) {
            for (uint32_t px_x = 0; px_x < soup.width; ++px_x) {
                const uint32_t tile = px_y / 8 * bins.grid.tiles_x + px_x / 8;
                for (uint32_t s = 0; s < lattice.spp; ++s) {
                    const glm::vec3 p = shared::sample_point(shared::pixel_hash(px_x, px_y, lattice.seed), px_x, px_y, s,
                                                             shared::stratum_length(lattice.spp));
                    const uint32_t cell = shared::cell_of(p.z, cells);
                    for (const oracle::Seen& seen : seen_at(soup.all_triangles(0), p.x - 37.5, p.y - 20.5, p.z, -1e9, 1e9))
                        met.insert({tile * cells + cell, seen.triangle | (seen.surface.positive ? 0u : shared::kReversed)});
                }
            }
        }
        EXPECT_GT(met.size(), 20u);
        uint32_t missed = 0;
        for (const auto& [list, entry] : met)
            missed += std::find(lists[list].begin(), lists[list].end(), entry) == lists[list].end() ? 1 : 0;
        EXPECT_EQ(missed, 0u);
        std::printf("%u cells: %u entries, of which samples meet %zu; swept %u\n", cells, bins.entry_count, met.size(), swept);
        EXPECT_LT(bins.entry_count, 8 * met.size());
        EXPECT_LT(5 * bins.entry_count, swept);
    }
}

// Of a shell that counts as closed what looks away from the eye is listed where it is listed anyway, and nothing else; of all
// others everything. A shell's triangles turn over as they move.
TEST_F(BinTest, OfClosedShellsWhatLooksAwayIsListed) {
    std::mt19937 random(15);
    for (bool orthographic : {false, true}) {
        Soup soup(2, 150, 77, orthographic);
        soup.add_prisms(300, random);
        const auto count = static_cast<uint32_t>(soup.triangles.size());
        Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        auto data = std::make_shared<SceneData>(upload_scene(device(), soup.scene()));
        std::vector<uint32_t> shells(count);
        for (uint32_t i = 0; i < count; ++i) shells[i] = i % 3;
        data->shells = gpu::upload_new(device(), "shells", shells);
        geometry.scene = data;
        geometry.closed = gpu::upload_new(device(), "closed", std::vector<uint32_t>{0, 1, 0});
        geometry.box = {glm::vec3(-1e6f), glm::vec3(1e6f)};
        const auto lists = [&](Listing listing) {
            const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), 4, listing);
            std::vector<std::vector<uint32_t>> found = read_bins(device(), bins);
            for (auto& list : found) std::sort(list.begin(), list.end());
            return found;
        };
        std::vector<std::vector<uint32_t>> expected = lists(Listing::swept);
        size_t left_out = 0, away = 0;
        for (auto& list : expected) {
            left_out += std::erase_if(
                list, [](uint32_t e) { return (e & shared::kReversed) != 0 && (e & ~shared::kReversed) % 3 == 1; });
            away += std::count_if(list.begin(), list.end(), [](uint32_t e) { return e % 3 == 1; });
        }
        EXPECT_EQ(lists(Listing::casting), expected);
        EXPECT_GT(left_out, 100u);
        EXPECT_GT(away, 100u);
    }
}

// Apart from what moves, what stands still is in no cell, but once in the list behind them: where it is listed as a part of its
// own, and wherever it is listed in any cell.
TEST_F(BinTest, WhatStandsStillIsListedOnce) {
    std::mt19937 random(16);
    for (bool orthographic : {false, true}) {
        for (const auto& [segments, cells] : std::map<uint32_t, uint32_t>{{1, 4}, {3, 6}}) {
            Soup soup(segments, 150, 77, orthographic);
            soup.add_prisms(300, random);
            soup.hold_every(3);
            const auto stands = [&](uint32_t entry) {
                const glm::uvec3& t = soup.triangles[entry & ~shared::kReversed];
                return std::all_of(soup.keys.begin(), soup.keys.end(), [&](const std::vector<glm::vec4>& places) {
                    return places[t.x] == soup.keys[0][t.x] && places[t.y] == soup.keys[0][t.y] &&
                           places[t.z] == soup.keys[0][t.z];
                });
            };
            const auto sorted = [&](uint32_t cell_count, Part part) {
                std::vector<std::set<uint32_t>> sets;
                size_t entries = 0;
                for (const auto& list : run(soup, cell_count, part).lists) {
                    sets.emplace_back(list.begin(), list.end());
                    entries += list.size() - sets.back().size();
                }
                EXPECT_EQ(entries, 0u) << "entries listed twice";
                return sets;
            };
            const auto whole = sorted(cells, Part::whole), apart = sorted(cells, Part::apart),
                       moving = sorted(cells, Part::moving), still = sorted(1, Part::still);
            ASSERT_EQ(apart.size(), whole.size() / cells * (cells + 1));
            uint64_t missing = 0, wrong = 0, found = 0, more = 0;
            for (size_t tile = 0; tile < still.size(); ++tile) {
                const std::set<uint32_t>& once = apart[tile * (cells + 1) + cells];
                EXPECT_EQ(once, still[tile]);
                std::set<uint32_t> seen;
                for (uint32_t cell = 0; cell < cells; ++cell) {
                    EXPECT_EQ(apart[tile * (cells + 1) + cell], moving[tile * cells + cell]);
                    std::set<uint32_t> rest;
                    for (const uint32_t entry : whole[tile * cells + cell]) (stands(entry) ? seen : rest).insert(entry);
                    EXPECT_EQ(apart[tile * (cells + 1) + cell], rest);
                }
                for (const uint32_t entry : seen) missing += once.count(entry) == 0;
                for (const uint32_t entry : once) wrong += !stands(entry);
                found += once.size();
                more += once.size() - seen.size();
            }
            EXPECT_EQ(missing, 0u) << "of " << found;
            EXPECT_EQ(wrong, 0u);
            EXPECT_GT(found, 100u);
            EXPECT_LT(more * 20, found) << "are listed for rounding";
        }
    }
}

// Cut into windows the view has the lists that it has whole.
TEST_F(BinTest, ListsOfWindowsAreThoseOfTheView) {
    std::mt19937 random(14);
    for (bool orthographic : {false, true}) {
        Soup soup(2, 150, 77, orthographic);
        soup.add_prisms(300, random);
        const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        const View view = soup.view();
        constexpr uint32_t kCells = 4;
        std::vector<std::vector<uint32_t>> expected = run(soup, kCells).lists;
        for (auto& list : expected) std::sort(list.begin(), list.end());
        for (const uint64_t most_tiles : {1000u, 40u, 19u, 7u, 1u}) {
            Bins bins = project_prisms(device(), programs(), geometry, view, kCells);
            std::vector<std::vector<uint32_t>> found;
            for (const Window& window : windows_of(view, most_tiles)) {
                ASSERT_LE(window.tile_count, most_tiles);
                list_prisms(device(), programs(), geometry, view, window, Listing::swept, bins);
                for (auto& list : read_bins(device(), bins)) {
                    std::sort(list.begin(), list.end());
                    found.push_back(list);
                }
            }
            EXPECT_EQ(found, expected) << "windows of " << most_tiles << " tiles, orthographic " << orthographic;
        }
    }
}

// The largest view has four million tiles; lavapipe ends an invocation's loops after 65,535 turns.
TEST_F(BinTest, APrismIsListedInAllTilesOfTheLargestView) {
    Soup soup(1, 16384, 16384, true);
    for (const float depth : {2.0f, 1.0f}) {
        const glm::vec4 corners[] = {{-40000, -9000, depth, 1}, {40000, -9000, depth, 1}, {0, 60000, depth, 1}};
        glm::uvec3 triangle;
        for (int i = 0; i < 3; ++i) triangle[i] = soup.add_vertex({corners[i], corners[i]});
        soup.triangles.push_back(triangle);
    }
    for (const Listing listing : {Listing::swept, Listing::bounds}) {
        const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), 1, listing);
        EXPECT_EQ(bins.longest, 2u);
        EXPECT_EQ(bins.entry_count, 2u * 2048u * 2048u);
    }
}

TEST_F(BinTest, NothingBehindTheEyeIsListed) {
    std::mt19937 random(13);
    Soup soup(1, 64, 64, false);
    for (int i = 0; i < 200; ++i) soup.add_prism(oracle::make_prism(oracle::PrismKind::behind, false, glm::dvec2(0.0), random));
    EXPECT_EQ(run(soup, 4).bins.entry_count, 0u);
}

}  // namespace
}  // namespace gnomon::test
