// SPDX-License-Identifier: Apache-2.0
// Pages: those items that somebody asked for and where more is listed than his own triangle.
#include "stages/pages.hpp"

#include <algorithm>

#include "lists.hpp"
#include "math/order.h"
#include "soup.hpp"
#include "stage_test.hpp"

namespace gnomon::test {
namespace {

using PagesTest = StageTest;

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
        std::vector<glm::uvec4> expected;
        for (uint32_t item = 0; item < receivers.size(); ++item) {
            if (random() % 3 == 0) continue;
            const float limit = static_cast<float>(random() % 1000) - 500.0f;
            const uint32_t listed = lists[item].empty() ? 0u : lists[item][0] & ~shared::kReversed;
            const uint32_t receiver = random() % 3 == 0 ? shared::kNone : random() % 2 == 0 ? listed : 1000000u;
            receivers[item] = {shared::ordered_bits(limit), receiver == shared::kNone ? receiver : receiver + 1};
            const bool others = std::any_of(lists[item].begin(), lists[item].end(),
                                            [&](uint32_t entry) { return (entry & ~shared::kReversed) != receiver; });
            if (others) expected.emplace_back(item, receiver, std::bit_cast<uint32_t>(limit), 0u);
        }
        Pages pages(device(), programs(), bins);
        gpu::upload(device(), pages.receivers(), std::as_bytes(std::span(receivers)));
        pages.list();
        ASSERT_EQ(pages.count(), expected.size());
        if (expected.empty()) continue;
        EXPECT_EQ(gpu::download_vector<glm::uvec4>(device(), pages.pages(), pages.count()), expected);
        const auto page_of = gpu::download_vector<uint32_t>(device(), pages.page_of(), bins.item_count() + 1ull);
        for (size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(page_of[expected[i].x], i);
            EXPECT_EQ(page_of[expected[i].x + 1], i + 1);
        }
    }
}

}  // namespace
}  // namespace gnomon::test
