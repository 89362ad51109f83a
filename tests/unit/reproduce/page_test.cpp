// SPDX-License-Identifier: Apache-2.0
// A page in a browser: its pictures load, and keys, wheel and clicks do what the page says. Needs Chromium and a Vulkan device;
// without one of them the test says that it is skipped.
#include <gmock/gmock.h>

#include "command_runner.hpp"
#include "support/chromium.hpp"
#include "test_folder.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

// Uses the page as a reader would.
constexpr const char* kReader = R"js(
  const viewer = document.querySelector('.viewer'), large = viewer.querySelector('.large');
  const shown = () => large.querySelector('.shown').textContent;
  const key = k => document.body.dispatchEvent(new KeyboardEvent('keydown', { key: k, bubbles: true }));
  const zoom = () => Number(getComputedStyle(viewer).getPropertyValue('--zoom'));
  const click = frame => ['pointerdown', 'pointerup'].forEach(type =>
    frame.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: 5, clientY: 5, bubbles: true })));
  HTMLElement.prototype.setPointerCapture = () => {};  // There is no such pointer.
  seen.broken = [...document.querySelectorAll('.pane img')].filter(i => i.naturalWidth === 0).length;
  seen.images = document.querySelectorAll('.pane img').length;
  seen.first = shown();
  key(' '); seen.flipped = shown();
  key(' '); seen.flippedBack = shown();
  key('d'); seen.difference = shown();
  key('f'); seen.flip = shown();
  key('1'); seen.reference = shown();
  key('p'); key('ArrowRight'); seen.next = shown();
  click(viewer.querySelectorAll('.pane .frame')[3]); seen.clicked = shown();
  click(large); seen.clickedLarge = shown();
  large.dispatchEvent(new WheelEvent('wheel', { deltaY: -300, clientX: 9, clientY: 9, bubbles: true, cancelable: true }));
  seen.zoom = zoom();
  key('0'); seen.fit = zoom();
  seen.loaded = performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).map(r => r.name);
)js";

class PageTest : public TestFolder {};

TEST_F(PageTest, WorksInChromium) {
    if (!has_chromium()) GTEST_SKIP() << "skipped: Chromium is not installed";
    const CommandResult made =
        run_gnomon(folder, {"reproduce", "2015-13", "-o", "out", "--scale=0.04", "--repeat=3", "--reference-spp=4", "--quiet"});
    GN_SKIP_WITHOUT_DEVICE(made);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const json seen = seen_in_chromium(folder, content_of(folder / "out" / "2015-13.html"), kReader);
    ASSERT_FALSE(seen.empty());
    EXPECT_EQ(seen["broken"], 0);
    EXPECT_GT(seen["images"], 10);
    EXPECT_EQ(seen["loaded"], json::array());
    EXPECT_EQ(seen["first"], "tsm");
    EXPECT_EQ(seen["flipped"], "reference");
    EXPECT_EQ(seen["flippedBack"], "tsm");
    EXPECT_EQ(seen["difference"], "tsm: |difference| to the reference");
    EXPECT_EQ(seen["flip"], "tsm: FLIP to the reference");
    EXPECT_EQ(seen["reference"], "reference");
    EXPECT_EQ(seen["next"], "ray-traced");
    EXPECT_EQ(seen["clicked"], "tsm-dynamic-bias");
    EXPECT_EQ(seen["clickedLarge"], "reference");
    EXPECT_NEAR(seen["zoom"].get<double>(), 2.718, 0.01);
    EXPECT_EQ(seen["fit"], 1.0);
}

}  // namespace
}  // namespace gnomon::test
