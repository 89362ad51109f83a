// SPDX-License-Identifier: Apache-2.0
// Pages: those items that somebody asked for and where more is listed than his own triangle; and what they are split into,
// whose lists hold all that may shadow who asked.
#include "stages/pages.hpp"

#include <algorithm>

#include "lists.hpp"
#include "math/order.h"
#include "soup.hpp"
#include "stage_test.hpp"

namespace gnomon::test {
namespace {

using PagesTest = StageTest;

struct Expected {
    uint32_t item, receiver;
    float limit;
};

/// As comp_shaders/common/page.glsl packs it.
struct ReadPage {
    glm::uvec2 tile;
    glm::uvec2 levels;  ///< Of space and time.
    uint32_t cell, receiver, begin, end, split;
    float limit;
};

struct Read {
    std::vector<ReadPage> pages;
    std::vector<uint32_t> leaves;

    Read(gpu::Device& device, const Pages& from, uint64_t nodes)
        : leaves(gpu::download_vector<uint32_t>(device, from.leaves(), nodes)) {
        if (from.count() == 0) return;
        const auto words = gpu::download_vector<glm::uvec4>(device, from.pages(), 2ull * from.count());
        for (size_t i = 0; i < words.size(); i += 2) {
            const glm::uvec4 place = words[i], list = words[i + 1];
            pages.push_back({glm::uvec2(place) & 0xffffffu, glm::uvec2(place) >> 24u, place.z, place.w, list.x, list.y, list.w,
                             std::bit_cast<float>(list.z)});
        }
    }
};

TEST_F(PagesTest, AreThoseThatAreAskedFor) {
    std::mt19937 random(21);
    constexpr uint32_t kCells = 3;
    for (const uint32_t prisms : {0u, 5u, 40u, 400u}) {
        SCOPED_TRACE(testing::Message() << prisms << " prisms");
        Soup soup(1, 130, 75, true);
        soup.add_prisms(prisms, random);
        if (prisms == 0) soup.add_prism({});
        const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), kCells);
        const std::vector<std::vector<uint32_t>> lists = read_bins(device(), bins);

        // A third ask for nothing; of the others some lie on one triangle, which the list may hold, some on several.
        std::vector<glm::uvec2> receivers(bins.item_count());
        std::vector<Expected> expected;
        for (uint32_t item = 0; item < receivers.size(); ++item) {
            if (random() % 3 == 0) continue;
            const float limit = static_cast<float>(random() % 1000) - 500.0f;
            const uint32_t listed = lists[item].empty() ? 0u : lists[item][0] & ~shared::kReversed;
            const uint32_t receiver = random() % 3 == 0 ? shared::kNone : random() % 2 == 0 ? listed : 1000000u;
            receivers[item] = {shared::ordered_bits(limit), receiver == shared::kNone ? receiver : receiver + 1};
            const bool others = std::any_of(lists[item].begin(), lists[item].end(),
                                            [&](uint32_t entry) { return (entry & ~shared::kReversed) != receiver; });
            if (others) expected.push_back({item, receiver, limit});
        }
        Pages pages(device(), programs(), geometry, bins);
        gpu::upload(device(), pages.receivers(), std::as_bytes(std::span(receivers)));
        pages.list();
        ASSERT_EQ(pages.count(), expected.size());
        const Read read(device(), pages, bins.item_count());
        std::vector<uint32_t> leaves(bins.item_count(), shared::kNone);
        for (uint32_t i = 0; i < expected.size(); ++i) {
            const uint32_t item = expected[i].item;
            const ReadPage& page = read.pages[i];
            leaves[item] = i << 4;
            EXPECT_EQ(page.tile, glm::uvec2(item / kCells % bins.grid.tiles_x, item / kCells / bins.grid.tiles_x));
            EXPECT_EQ(page.cell, item % kCells);
            EXPECT_EQ(page.levels, glm::uvec2(0));
            EXPECT_EQ(page.receiver, expected[i].receiver);
            EXPECT_EQ(page.limit, expected[i].limit);
            EXPECT_EQ(page.end - page.begin, lists[item].size());
        }
        EXPECT_EQ(read.leaves, leaves);
    }
}

/// A hit, as far as pages know it.
struct Hit {
    float x, y, t, limit;
    uint32_t own;
    uint32_t node;
};

/// Small triangles all over each other on a patch of the image, which may move fast; between them large ones.
Soup crowd(bool orthographic, float way, std::mt19937& random) {
    Soup soup(2, 150, 90, orthographic);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    for (uint32_t i = 0; i < 3000; ++i) {
        const glm::dvec2 centre(uniform(-30.0, -20.0), uniform(-12.0, -6.0));
        const glm::dvec2 motion = glm::dvec2(uniform(0.6, 1.0), uniform(0.3, 0.5)) * double(way);
        const double size = i % 100 == 0 ? 40.0 : 0.2;
        oracle::Prism prism;
        for (size_t v = 0; v < 3; ++v) {
            const glm::dvec2 at = centre + size * glm::dvec2(uniform(-1.0, 1.0), uniform(-1.0, 1.0));
            const double w = uniform(2.0, 6.0);
            const auto place = [&](const glm::dvec2& p) {
                return orthographic ? glm::vec4(p, w, 1.0) : glm::vec4(p * w, -1.0, w);
            };
            prism.start[v] = place(at);
            prism.end[v] = place(at + motion);
        }
        soup.add_prism(prism);
    }
    return soup;
}

TEST_F(PagesTest, PartsListWhatMayShadowWhoAsked) {
    std::mt19937 random(22);
    constexpr uint32_t kCells = 4;
    for (const bool orthographic : {false, true}) {
        for (const float way : {0.0f, 1.5f, 60.0f}) {
            SCOPED_TRACE(testing::Message() << "orthographic " << orthographic << ", motion " << way);
            const Soup soup = crowd(orthographic, way, random);
            const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
            const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), kCells);
            const float half_width = 0.5f * float(soup.width), half_height = 0.5f * float(soup.height);

            // Hits under the crowd, and elsewhere.
            std::vector<Hit> hits;
            for (uint32_t i = 0; i < 1500; ++i) {
                const bool under = i % 4 != 0;
                const auto uniform = [&](float low, float high) {
                    return std::uniform_real_distribution<float>(low, high)(random);
                };
                Hit hit{under ? uniform(-30.0f, -20.0f + way) : uniform(-half_width, half_width),
                        under ? uniform(-12.0f, -6.0f + 0.5f * way) : uniform(-half_height, half_height),
                        uniform(0.0f, 0.9999f),
                        orthographic ? uniform(1.0f, 8.0f) : -1.0f / uniform(1.0f, 8.0f),
                        static_cast<uint32_t>(random() % 3000),
                        0};
                hit.x = std::clamp(hit.x, -half_width, half_width - 0.01f);
                hit.y = std::clamp(hit.y, -half_height, half_height - 0.01f);
                const auto column = static_cast<uint32_t>(hit.x + half_width), row = static_cast<uint32_t>(hit.y + half_height);
                hit.node = (row / 8 * bins.grid.tiles_x + column / 8) * kCells + static_cast<uint32_t>(hit.t * kCells);
                hits.push_back(hit);
            }
            const auto ask = [&](std::vector<glm::uvec2>& receivers, uint32_t node, const Hit& hit) {
                glm::uvec2& receiver = receivers[node];
                receiver.x = std::max(receiver.x, shared::ordered_bits(hit.limit));
                receiver.y = receiver.y == 0 || receiver.y == hit.own + 1 ? hit.own + 1 : shared::kNone;
            };
            std::vector<glm::uvec2> receivers(bins.item_count());
            for (const Hit& hit : hits) ask(receivers, hit.node, hit);
            Pages pages(device(), programs(), geometry, bins);
            gpu::upload(device(), pages.receivers(), std::as_bytes(std::span(receivers)));
            pages.list();
            uint32_t node_count = bins.item_count(), rounds = 0;
            pages.refine(orthographic, [&](const Pages::Parts& parts) {
                ASSERT_EQ(parts.node_first, node_count);
                const Read read(device(), pages, node_count);
                std::vector<glm::uvec2> asked(parts.receivers.bytes() / sizeof(glm::uvec2));
                const auto units = gpu::download_vector<uint32_t>(device(), parts.units, pages.count() - parts.page_first);
                for (Hit& hit : hits) {
                    const uint32_t leaf = read.leaves[hit.node];
                    if (leaf == shared::kNone || leaf >> 4 < parts.page_first) continue;
                    const ReadPage& page = read.pages[leaf >> 4];
                    if (page.split == 0) continue;
                    const double scale = std::exp2(page.levels.x + 1.0), cells = kCells * std::exp2(2.0 * page.levels.y + 2.0);
                    const auto column = static_cast<uint32_t>((double(hit.x) + half_width) * scale / 8.0),
                               row = static_cast<uint32_t>((double(hit.y) + half_height) * scale / 8.0);
                    const uint32_t q = page.split == shared::kSplitSpace ? row % 2 * 2 + column % 2
                                                                         : static_cast<uint32_t>(double(hit.t) * cells) % 4;
                    const uint32_t part = 4 * units[(leaf >> 4) - parts.page_first] + q;
                    hit.node = parts.node_first + part;
                    ask(asked, part, hit);
                }
                gpu::upload(device(), parts.receivers, std::as_bytes(std::span(asked)));
                node_count += static_cast<uint32_t>(asked.size());
                ++rounds;
            });
            EXPECT_GE(rounds, 3u);

            const Read read(device(), pages, node_count);
            const auto from_bins = gpu::download_vector<uint32_t>(device(), bins.entries, bins.entry_count);
            const auto handed_down = gpu::download_vector<uint32_t>(device(), pages.entries(), pages.entries().bytes() / 4);
            std::vector<std::vector<oracle::MovingTriangle>> triangles;
            for (uint32_t k = 0; k < soup.segments(); ++k) triangles.push_back(soup.all_triangles(k));
            uint64_t wanted = 0, listed = 0, longest = 0;
            for (const Hit& hit : hits) {
                std::vector<uint32_t> list;
                const uint32_t leaf = read.leaves[hit.node];
                if (leaf != shared::kNone) {
                    const ReadPage& page = read.pages[leaf >> 4];
                    const double side = 8.0 / std::exp2(page.levels.x), cell = 1.0 / (kCells * std::exp2(2.0 * page.levels.y));
                    EXPECT_EQ(page.levels.x, leaf & 15u);
                    EXPECT_EQ(page.split, 0u);
                    EXPECT_GE(page.limit, hit.limit);
                    EXPECT_NEAR(hit.x + half_width, (page.tile.x + 0.5) * side, 0.5 * side + 1e-4);
                    EXPECT_NEAR(hit.y + half_height, (page.tile.y + 0.5) * side, 0.5 * side + 1e-4);
                    EXPECT_NEAR(hit.t, (page.cell + 0.5) * cell, 0.5 * cell + 1e-6);
                    for (uint32_t k = page.begin; k < page.end; ++k) {
                        const uint32_t entry = k < pages.entry_first() ? from_bins[k] : handed_down[k - pages.entry_first()];
                        list.push_back(entry & ~shared::kReversed);
                    }
                    if (page.receiver != shared::kNone) {
                        EXPECT_EQ(page.receiver, hit.own);
                    }
                }
                longest = std::max<uint64_t>(longest, list.size());
                listed += list.size();
                const uint32_t segment = hit.t < 0.5f ? 0 : 1;
                const double local = 2.0 * double(hit.t) - segment;
                for (const oracle::Seen& seen : seen_at(triangles[segment], hit.x, hit.y, local, -1e30, hit.limit)) {
                    if (seen.triangle == hit.own) continue;
                    ++wanted;
                    EXPECT_THAT(list, testing::Contains(seen.triangle)) << hit.x << ", " << hit.y << " at " << hit.t;
                }
            }
            EXPECT_GT(wanted, 500u);
            EXPECT_LE(longest, pages.longest());
            std::cout << rounds << " rounds, " << pages.count() << " pages, " << listed / hits.size()
                      << " prisms listed for a hit, " << double(wanted) / double(hits.size()) << " shadow it; base "
                      << bins.longest << std::endl;
        }
    }
}

}  // namespace
}  // namespace gnomon::test
