// SPDX-License-Identifier: Apache-2.0
// What a frame tells of how much of it is done, and how it is stopped.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

#include "scenes/scene_makers.hpp"
#include "test_scenes.hpp"

namespace gnomon::test {
namespace {

// A device on which a dispatch takes several pieces, and each several submissions.
class ProgressTest : public testing::Test {
protected:
    ProgressTest() {
        setenv("GNOMON_LIMITS", "dispatch_ms=1", 1);
        renderer = std::make_unique<Renderer>();
        unsetenv("GNOMON_LIMITS");
    }

    std::unique_ptr<Renderer> renderer;
    const PosedScene posed = load_posed(made_file("figure_2000", [](const auto& path) {
        makers::make_figure(path, {2000, true});
    }));
    const RenderSettings settings{.width = 256, .height = 192, .spp = 16, .shadow_res = 1024};
};

TEST_F(ProgressTest, MovesBeforeTheFirstSampleAndNeverBack) {
    std::vector<double> shares;
    renderer->render(posed.scene, posed.poses, settings, [&](double share) {
        shares.push_back(share);
        return true;
    });
    EXPECT_EQ(shares.front(), 0.0);
    EXPECT_EQ(shares.back(), 1.0);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    const auto before = std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0.0 && share < 0.1; });
    EXPECT_GT(before, 5) << "while lists are made";
    EXPECT_GT(std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0.2 && share < 1.0; }), 5);
}

TEST_F(ProgressTest, StopsWhileListsAreMadeAndLeavesTheRendererAsItWas) {
    const uint64_t expected = hash_of(renderer->render(posed.scene, posed.poses, settings));
    for (const double enough : {0.0, 0.01, 0.05, 0.11, 0.3}) {
        int calls_after = -1;
        const Frame stopped = renderer->render(posed.scene, posed.poses, settings, [&](double share) {
            calls_after += share >= enough;
            return share < enough;
        });
        EXPECT_EQ(calls_after, 0) << "stopped at once, at " << enough;
        for (const Channel& channel : stopped.channels)
            EXPECT_TRUE(std::all_of(channel.values.begin(), channel.values.end(), [](float value) { return value == 0.0f; }));
    }
    EXPECT_EQ(hash_of(renderer->render(posed.scene, posed.poses, settings)), expected);
}

}  // namespace
}  // namespace gnomon::test
