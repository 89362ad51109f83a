// SPDX-License-Identifier: Apache-2.0
// The S-buffer in every layout: it contains what the oracle sees, its counts are sums, its bands together are the whole, and
// all layouts hold the same ranges.
#include <gnomon/error.hpp>
#include <unordered_map>

#include "lists.hpp"
#include "pipeline/range_collector.hpp"
#include "soup.hpp"
#include "stage_test.hpp"
#include "support/tested_layouts.hpp"

namespace gnomon::test {
namespace {

using Lists = std::vector<std::vector<RangeRecord>>;

constexpr uint64_t kEverything = 1ull << 40;

class RangesTest : public StageTest {
protected:
    struct LightSoup {
        Soup soup;
        Geometry geometry;
        Bins bins;
    };

    LightSoup prepare(Soup soup, uint32_t cells) {
        LightSoup light{std::move(soup), {}, {}};
        light.geometry = pose_geometry(device(), programs(), light.soup.scene(), light.soup.poses());
        light.bins = bin_prisms(device(), programs(), light.geometry, light.soup.view(), cells);
        return light;
    }

    SBuffer s_buffer_of(const LightSoup& light, const std::string& layout) {
        const Layout found = with_ranges(find_layout(layout), false);
        add_layout_stages(device(), programs(), found, {"raster/conservative", "sbuffer/read"});
        return SBuffer(
            device(), programs(),
            walk_bins(programs(), {light.geometry, light.bins}, found.stage("raster/conservative"), light.soup.orthographic),
            found);
    }

    Lists whole(SBuffer& s_buffer) {
        const std::vector<Band> bands = s_buffer.bands(kEverything);
        EXPECT_EQ(bands.size(), 1u);
        s_buffer.fill(bands[0]);
        return read_ranges(device(), programs(), s_buffer, bands[0]);
    }
};

/// The texel of a list, and its cell.
struct Place {
    glm::uvec2 texel;
    uint32_t cell;
};

Place place_of(const shared::ViewGrid& grid, size_t list) {
    const auto item = static_cast<uint32_t>(list / shared::kTileTexels), tile = item / grid.cell_count;
    return {{tile % grid.tiles_x * 8 + list % 8, tile / grid.tiles_x * 8 + list / 8 % 8}, item % grid.cell_count};
}

uint64_t total(const Lists& lists) {
    uint64_t sum = 0;
    for (const auto& list : lists) sum += list.size();
    return sum;
}

void expect_sound(const Soup& soup, const shared::ViewGrid& grid, const Lists& lists) {
    uint64_t outside = 0, unsound = 0;
    for (size_t i = 0; i < lists.size(); ++i) {
        const Place place = place_of(grid, i);
        if (place.texel.x >= soup.width || place.texel.y >= soup.height) outside += lists[i].size();
        const double start = double(place.cell) / grid.cell_count, end = double(place.cell + 1) / grid.cell_count;
        for (const RangeRecord& r : lists[i]) {
            const bool in_cell = r.enter >= start - 1e-4 && r.leave <= end + 1e-4 && r.enter <= r.leave;
            if (!in_cell || (r.entry & ~shared::kReversed) >= soup.triangles.size()) ++unsound;
        }
    }
    EXPECT_EQ(outside, 0u) << "ranges of texels outside the image";
    EXPECT_EQ(unsound, 0u) << "ranges out of their cell or of no triangle";
}

/// Every instant at which the oracle sees a triangle over a texel lies in a range of it; returns how many there were.
uint64_t expect_contained(const Soup& soup, const shared::ViewGrid& grid, const Lists& lists) {
    uint64_t instants = 0, missed = 0, too_deep = 0;
    const uint32_t per_segment = grid.cell_count / grid.segment_count;
    for (size_t i = 0; i < lists.size(); ++i) {
        const Place place = place_of(grid, i);
        if (place.texel.x >= soup.width || place.texel.y >= soup.height) continue;
        const uint32_t segment = place.cell / per_segment;
        std::unordered_multimap<uint32_t, RangeRecord> by_entry;
        for (const RangeRecord& r : lists[i]) by_entry.emplace(r.entry, r);
        const glm::dvec2 lower = glm::dvec2(place.texel) - 0.5 * glm::dvec2(soup.width, soup.height), middle = lower + 0.5;
        for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
            const oracle::MovingTriangle triangle = soup.triangle(t, segment);
            for (double step : {0.0, 0.37, 0.71, 1.0}) {
                const double s = (place.cell % per_segment + step) / per_segment, time = (segment + s) / grid.segment_count;
                const std::optional<bool> positive = orientation_in(triangle, {lower, lower + 1.0}, s);
                if (!positive) continue;
                ++instants;
                const uint32_t entry = *positive ? t : t | shared::kReversed;
                const auto [begin, end] = by_entry.equal_range(entry);
                const auto range =
                    std::find_if(begin, end, [&](const auto& r) { return r.second.enter <= time && time <= r.second.leave; });
                if (range == end) {
                    ++missed;
                    continue;
                }
                const std::optional<oracle::Surface> surface = surface_at(triangle, middle.x, middle.y, s);
                too_deep += surface && double(range->second.nearest) > surface->depth ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(missed, 0u) << "of " << instants;
    EXPECT_EQ(too_deep, 0u) << "of " << instants;
    return instants;
}

TEST_F(RangesTest, ContainTheOraclesAndAreTheSameInEveryLayout) {
    std::mt19937 random(31);
    const struct {
        uint32_t width, height, segments, cells;
    } cases[] = {{40, 27, 1, 1}, {24, 20, 1, 4}, {10, 11, 1, 16}, {24, 14, 3, 3}, {19, 10, 3, 6}, {1, 1, 1, 2}};
    for (const auto& c : cases) {
        for (bool orthographic : {false, true}) {
            Soup soup(c.segments, c.width, c.height, orthographic);
            soup.add_prisms(88, random);
            const LightSoup light = prepare(std::move(soup), c.cells);
            Lists first;
            for (const std::string& layout : tested_layouts()) {
                if (!find_layout(layout).lossless) continue;
                SCOPED_TRACE(testing::Message() << layout << ", " << c.width << "x" << c.height << ", " << c.segments
                                                << " segments, " << c.cells << " cells, orthographic " << orthographic);
                SBuffer s_buffer = s_buffer_of(light, layout);
                const Lists lists = whole(s_buffer);
                EXPECT_EQ(lists.size(), s_buffer.list_count());
                EXPECT_EQ(total(lists), s_buffer.range_count());
                if (first.empty()) {
                    first = lists;
                    expect_sound(light.soup, light.bins.grid, lists);
                    EXPECT_GT(expect_contained(light.soup, light.bins.grid, lists), 20u);
                } else {
                    EXPECT_TRUE(lists == first) << "not the ranges of the first layout";
                }
            }
        }
    }
}

/// Of each texel, the lengths of its lists.
std::vector<uint32_t> texel_ranges(const shared::ViewGrid& grid, const Lists& lists) {
    std::vector<uint32_t> sums(size_t(grid.width) * grid.height);
    for (size_t i = 0; i < lists.size(); ++i) {
        const glm::uvec2 texel = place_of(grid, i).texel;
        if (texel.x < grid.width && texel.y < grid.height)
            sums[size_t(texel.y) * grid.width + texel.x] += static_cast<uint32_t>(lists[i].size());
    }
    return sums;
}

TEST_F(RangesTest, CollectedByTexel) {
    std::mt19937 random(35);
    Soup soup(3, 163, 90, false);
    soup.add_prisms(150, random);
    const LightSoup light = prepare(std::move(soup), 6);
    RenderSettings settings;
    settings.keep_texel_ranges = settings.keep_ranges = true;
    std::vector<TexelRange> first;
    for (const std::string& layout : tested_layouts()) {
        if (!find_layout(layout).lossless) continue;
        SCOPED_TRACE(layout);
        SBuffer s_buffer = s_buffer_of(light, layout);
        const std::vector<uint32_t> expected = texel_ranges(light.bins.grid, whole(s_buffer));
        EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 2u);
        for (const uint64_t bytes : {kEverything, s_buffer.map_bytes() / 3}) {
            const std::vector<Band> bands = s_buffer.bands(bytes);
            EXPECT_EQ(bands.size() > 1, bytes != kEverything);
            RangeCollector collector(settings, false);
            collector.begin_face(light.soup.view());
            for (const Band& band : bands) {
                s_buffer.fill(band);
                collector.read(device(), programs(), s_buffer, band);
            }
            Frame frame;
            collector.finish(frame);
            EXPECT_EQ(frame.texel_ranges.at(0), expected) << bands.size() << " bands";
            const std::vector<TexelRange>& ranges = frame.light_ranges.at(0).ranges;
            std::vector<uint32_t> counts(expected.size());
            for (const TexelRange& range : ranges) ++counts[range.texel];
            EXPECT_EQ(counts, expected);
            if (first.empty()) first = ranges;
            EXPECT_TRUE(ranges == first) << "in one order, whatever the layout and its bands";
        }
    }
}

TEST_F(RangesTest, BandsTogetherAreTheWhole) {
    std::mt19937 random(32);
    Soup soup(1, 160, 100, true);
    soup.add_prisms(300, random);
    const LightSoup light = prepare(std::move(soup), 4);
    for (const std::string& layout : tested_layouts()) {
        if (!find_layout(layout).lossless) continue;
        SCOPED_TRACE(layout);
        SBuffer s_buffer = s_buffer_of(light, layout);
        const Lists expected = whole(s_buffer);
        for (uint64_t parts : {2u, 5u}) {
            const std::vector<Band> bands = s_buffer.bands(s_buffer.map_bytes() / parts);
            EXPECT_GT(bands.size(), 1u);
            Lists together;
            uint64_t ranges = 0;
            for (const Band& band : bands) {
                EXPECT_EQ(band.range_first, ranges);
                s_buffer.fill(band);
                const Lists lists = read_ranges(device(), programs(), s_buffer, band);
                EXPECT_EQ(total(lists), band.range_count);
                ranges += band.range_count;
                together.insert(together.end(), lists.begin(), lists.end());
            }
            EXPECT_TRUE(together == expected) << bands.size() << " bands";
        }
        EXPECT_THROW(s_buffer.bands(16), Error) << "one block of tiles needs more";
    }
}

// What is not there in the layout's list as the exact ones are; a list's triangles may be over a texel several times.
uint64_t not_contained(const Lists& exact, const Lists& lists) {
    uint64_t missing = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        for (const RangeRecord& r : exact[i]) {
            const auto contains = [&](const RangeRecord& other) {
                // Of the shutter: nobody asks for other times.
                const float enter = std::max(r.enter, 0.0f), leave = std::min(r.leave, 1.0f);
                return other.entry == r.entry && other.enter <= enter && other.leave >= leave && other.nearest <= r.nearest;
            };
            missing += std::any_of(lists[i].begin(), lists[i].end(), contains) ? 0 : 1;
        }
    }
    return missing;
}

TEST_F(RangesTest, OfLossyLayouts) {
    std::mt19937 random(36);
    Soup soup(1, 24, 20, false);
    soup.add_prisms(400, random);
    const LightSoup light = prepare(std::move(soup), 2);
    SBuffer array = s_buffer_of(light, "array");
    const Lists exact = whole(array);
    int contain = 0, count = 0;
    for (const std::string& name : tested_layouts()) {
        const Layout layout = find_layout(name);
        if (layout.lossless) continue;
        SCOPED_TRACE(name);
        SBuffer s_buffer = s_buffer_of(light, name);
        const Lists lists = whole(s_buffer);
        if (layout.only_contains()) {
            EXPECT_EQ(not_contained(exact, lists), 0u);
            EXPECT_EQ(total(lists), total(exact));
            ++contain;
        } else {
            ASSERT_TRUE(s_buffer.lost().has_value());
            const uint32_t lost = gpu::values_of<uint32_t>(device(), *s_buffer.lost())[0];
            EXPECT_GT(lost, 0u);
            EXPECT_EQ(total(lists) + lost, total(exact));
            EXPECT_EQ(not_contained(lists, exact), 0u) << "others than there are";
            EXPECT_EQ(not_contained(exact, lists), lost);
            ++count;
        }
    }
    EXPECT_GT(contain, 0);
    EXPECT_GT(count, 0);
}

TEST_F(RangesTest, EmptyView) {
    Soup soup(1, 20, 20, false);
    std::mt19937 random(33);
    for (int i = 0; i < 10; ++i) soup.add_prism(oracle::make_prism(oracle::PrismKind::behind, false, glm::dvec2(0.0), random));
    const LightSoup light = prepare(std::move(soup), 2);
    for (const std::string& layout : tested_layouts()) {
        SBuffer s_buffer = s_buffer_of(light, layout);
        EXPECT_EQ(s_buffer.range_count(), 0u);
        EXPECT_EQ(total(whole(s_buffer)), 0u);
    }
}

// More prisms in a tile than one dispatch may walk.
TEST_F(RangesTest, LongLists) {
    std::mt19937 random(34);
    Soup soup(1, 8, 4, false);
    soup.add_prisms(30'000, random);
    const LightSoup light = prepare(std::move(soup), 1);
    ASSERT_GT(light.bins.longest, 2 * shared::kListChunk);
    Lists first;
    for (const std::string& layout : tested_layouts()) {
        if (!find_layout(layout).lossless) continue;
        SCOPED_TRACE(layout);
        SBuffer s_buffer = s_buffer_of(light, layout);
        const Lists lists = whole(s_buffer);
        EXPECT_EQ(total(lists), s_buffer.range_count());
        if (first.empty()) {
            first = lists;
            expect_contained(light.soup, light.bins.grid, lists);
            expect_sound(light.soup, light.bins.grid, lists);
        } else {
            EXPECT_TRUE(lists == first);
        }
    }
}

}  // namespace
}  // namespace gnomon::test
