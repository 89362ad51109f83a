// SPDX-License-Identifier: Apache-2.0
// The page of `gnomon report` in a browser, at three widths: nothing is cut off, nothing overlaps, text can be read, tables are
// sorted. Needs Chromium; without it the test says that it is skipped.
#include <gmock/gmock.h>

#include "command_runner.hpp"
#include "support/chromium.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

constexpr const char* kReader = R"js(
  document.querySelectorAll('details').forEach(d => { d.open = true; });
  const place = text => text.closest('figure').querySelector('figcaption').textContent + ': ' + text.textContent;
  seen.width = innerWidth;
  seen.pageScrolls = document.documentElement.scrollWidth > innerWidth;
  seen.dark = matchMedia('(prefers-color-scheme: dark)').matches;
  seen.paper = getComputedStyle(document.body).backgroundColor;
  seen.figures = document.querySelectorAll('figure.plot').length;
  seen.captions = [...document.querySelectorAll('figure.plot .caption')].filter(c => c.textContent.trim().endsWith('.')).length;
  seen.loaded = performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).map(r => r.name);
  seen.scripts = document.scripts.length;
  seen.cutOff = []; seen.overlaps = []; seen.small = []; seen.wide = [];
  for (const svg of document.querySelectorAll('figure.plot svg')) {
    const box = svg.getBoundingClientRect(), figure = svg.closest('figure').getBoundingClientRect();
    if (box.right > figure.right + 1) seen.wide.push(svg.getAttribute('aria-label'));
    const texts = [...svg.querySelectorAll('text')], boxes = texts.map(t => t.getBoundingClientRect());
    texts.forEach((t, i) => {
      const b = boxes[i];
      if (b.left < box.left - 1 || b.right > box.right + 1 || b.top < box.top - 1 || b.bottom > box.bottom + 1) seen.cutOff.push(place(t));
      if (parseFloat(getComputedStyle(t).fontSize) * box.width / svg.viewBox.baseVal.width < 10) seen.small.push(place(t));
      for (let k = 0; k < i; ++k) {
        const wide = Math.min(b.right, boxes[k].right) - Math.max(b.left, boxes[k].left);
        const high = Math.min(b.bottom, boxes[k].bottom) - Math.max(b.top, boxes[k].top);
        if (wide > 2 && high > 4) seen.overlaps.push(place(t) + ' / ' + texts[k].textContent);
      }
    });
  }
  const table = [...document.querySelectorAll('.sortable')].find(t => t.querySelector('thead').textContent.includes('verdict'));
  const column = [...table.querySelectorAll('thead th')].findIndex(h => h.textContent === 'ratio');
  const column_text = () => [...table.querySelectorAll('tbody tr')].map(r => r.cells[column].textContent);
  const button = table.querySelectorAll('thead th')[column].querySelector('button');
  button.click(); seen.ascending = column_text();
  button.click(); seen.descending = column_text();
)js";

class ReportPageTest : public TestFolder {};

TEST_F(ReportPageTest, CanBeReadAtThreeWidths) {
    if (!has_chromium()) GTEST_SKIP() << "skipped: Chromium is not installed";
    const std::string bench = GN_PATH(GNOMON_BENCH_JSON);
    const CommandResult made = run_gnomon(folder, {"report", bench, "-o", "report.html"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const std::string page = content_of(folder / "report.html");
    for (const int width : {480, 900, 1600}) {
        SCOPED_TRACE(width);
        const json seen = seen_in_chromium(folder, page, kReader, width, width == 900);
        ASSERT_FALSE(seen.empty());
        EXPECT_EQ(seen["width"], width);
        EXPECT_EQ(seen["pageScrolls"], false);
        EXPECT_EQ(seen["dark"], width == 900);
        EXPECT_EQ(seen["paper"], width == 900 ? "rgb(22, 24, 27)" : "rgb(251, 251, 249)");
        EXPECT_GE(seen["figures"], 15);
        EXPECT_EQ(seen["captions"], seen["figures"]);
        EXPECT_EQ(seen["loaded"], json::array());
        EXPECT_EQ(seen["scripts"], 2);  // The page's and the reader's: none of the scene's name.
        EXPECT_EQ(seen["wide"], json::array());
        EXPECT_EQ(seen["cutOff"], json::array());
        EXPECT_EQ(seen["overlaps"], json::array());
        EXPECT_EQ(seen["small"], json::array());
        EXPECT_EQ(seen["ascending"], json({"0.125", "0.125", "1.010", "1.010", "1.500", "1.500", "2.000", "2.000", "8.000"}));
        EXPECT_EQ(seen["descending"], json({"8.000", "2.000", "2.000", "1.500", "1.500", "1.010", "1.010", "0.125", "0.125"}));
    }
}

}  // namespace
}  // namespace gnomon::test
