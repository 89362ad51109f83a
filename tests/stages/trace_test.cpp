// SPDX-License-Identifier: Apache-2.0
// The nearest triangle of every sample: against the exact test in float over all triangles, bit for bit, and against the oracle
// in double.
#include <algorithm>
#include <array>
#include <map>

#include "math/sample.h"
#include "stage_test.hpp"
#include "traced.hpp"

namespace gnomon::test {
namespace {

class TraceTest : public StageTest {
protected:
    std::vector<uint32_t> run(const Soup& soup, const Sampling& sampling) {
        return trace(device(), programs(), soup, sampling);
    }

    // A device that contracts multiplications and additions may see silhouettes differently.
    void expect_same(const std::vector<uint32_t>& found, const std::vector<uint32_t>& expected) {
        ASSERT_EQ(found.size(), expected.size());
        uint64_t differing = 0;
        for (size_t i = 0; i < found.size(); ++i) differing += found[i] != expected[i] ? 1 : 0;
        EXPECT_LE(differing, device().limits().is_cpu ? 0 : found.size() / 1000);
    }
};

TEST_F(TraceTest, FindsTheNearestTriangle) {
    std::mt19937 random(21);
    const struct {
        uint32_t width, height, segments, cells, spp;
    } cases[] = {{1, 1, 1, 1, 1},   {1, 1, 1, 4, 4},    {8, 8, 1, 8, 8},     {33, 17, 1, 16, 16}, {40, 24, 1, 4, 7},
                 {17, 9, 2, 8, 17}, {31, 23, 3, 9, 19}, {64, 40, 3, 12, 12}, {20, 20, 1, 8, 3},   {20, 20, 2, 2, 1}};
    for (const auto& c : cases) {
        for (bool orthographic : {false, true}) {
            SCOPED_TRACE(testing::Message() << c.width << "x" << c.height << ", " << c.segments << " segments, " << c.cells
                                            << " cells, " << c.spp << " samples, orthographic " << orthographic);
            Soup soup(c.segments, c.width, c.height, orthographic);
            soup.add_prisms(150, random);
            const Sampling sampling{c.spp, random() % 100 < 50 ? 0u : 9u, c.cells, 1u << 20};
            const std::vector<uint32_t> found = run(soup, sampling);
            expect_same(found, trace_in_float(soup, sampling));
            EXPECT_LE(count_differences_from_oracle(soup, sampling, found), found.size() / 500);
        }
    }
}

// Triangles much smaller than a pixel, some of which cross the image or pass the eye: they are listed only where a sample meets
// them.
TEST_F(TraceTest, SmallAndFast) {
    std::mt19937 random(27);
    std::uniform_real_distribution<float> place(-1.2f, 1.2f), corner(-0.6f, 0.6f), depth(0.2f, 9.0f);
    const struct {
        uint32_t width, height, segments, cells, spp;
        bool apart = false;
    } cases[] = {{40, 24, 1, 1, 1},  {64, 40, 1, 8, 8}, {33, 17, 1, 2, 16},      {40, 24, 1, 4, 7},
                 {31, 23, 3, 9, 19}, {20, 20, 2, 8, 3}, {40, 24, 1, 4, 4, true}, {31, 23, 3, 9, 19, true}};
    for (const auto& c : cases) {
        for (bool orthographic : {false, true}) {
            SCOPED_TRACE(testing::Message()
                         << c.width << "x" << c.height << ", " << c.segments << " segments, " << c.cells << " cells, " << c.spp
                         << " samples, orthographic " << orthographic << ", apart " << c.apart);
            Soup soup(c.segments, c.width, c.height, orthographic);
            const glm::vec2 half(0.5f * float(c.width), 0.5f * float(c.height));
            for (uint32_t i = 0; i < 600; ++i) {
                const float speed = std::array{0.0f, 0.05f, 1.0f}[i % 3];
                const glm::vec3 from(place(random) * half.x, place(random) * half.y, depth(random));
                glm::vec3 to = glm::mix(from, glm::vec3(place(random) * half.x, place(random) * half.y, depth(random)), speed);
                if (i % 30 == 2) to.z = -to.z;
                std::vector<std::vector<glm::vec4>> corners(3);
                for (auto& keys : corners) {
                    const glm::vec2 at(corner(random), corner(random));
                    for (uint32_t k = 0; k <= c.segments; ++k) {
                        const glm::vec3 p = glm::mix(from, to, float(k) / float(c.segments));
                        keys.push_back(orthographic ? glm::vec4(glm::vec2(p) + at, p.z, 1.0f)
                                                    : glm::vec4((glm::vec2(p) + at) * p.z, -1.0f, p.z));
                    }
                }
                const uint32_t first = soup.add_vertex(corners[0]);
                soup.add_vertex(corners[1]);
                soup.add_vertex(corners[2]);
                soup.triangles.emplace_back(first, first + 1, first + 2);
            }
            const Sampling sampling{c.spp, 9u, c.cells, 1u << 20, c.apart ? Part::apart : Part::whole};
            const std::vector<uint32_t> found = run(soup, sampling);
            expect_same(found, trace_in_float(soup, sampling));
            EXPECT_LE(count_differences_from_oracle(soup, sampling, found), found.size() / 500);
            EXPECT_GT(found.size() - static_cast<size_t>(std::count(found.begin(), found.end(), shared::kNone)),
                      found.size() / 100);
        }
    }
}

TEST_F(TraceTest, EquallyNearTheLowerTriangleWins) {
    std::mt19937 random(22);
    for (bool orthographic : {false, true}) {
        Soup once(1, 32, 32, orthographic);
        once.add_prisms(60, random);
        Soup twice = once;
        twice.triangles.insert(twice.triangles.end(), once.triangles.rbegin(), once.triangles.rend());
        const Sampling sampling{8, 1, 4, 1u << 20};
        expect_same(run(twice, sampling), run(once, sampling));
    }
}

// What stands still in a list of its own: whether a stratum lies in one cell or in several, and where both lists are long.
TEST_F(TraceTest, WhatStandsStillApart) {
    std::mt19937 random(26);
    for (bool orthographic : {false, true}) {
        for (const auto& [segments, cells, spp] : {std::array{1u, 8u, 8u}, {1u, 4u, 7u}, {3u, 6u, 6u}, {2u, 4u, 3u}}) {
            SCOPED_TRACE(testing::Message() << segments << " segments, " << cells << " cells, " << spp << " samples");
            Soup soup(segments, 40, 24, orthographic);
            soup.add_prisms(200, random);
            soup.hold_every(2);
            Sampling sampling{spp, 3, cells, 1u << 20, Part::apart};
            expect_same(run(soup, sampling), trace_in_float(soup, sampling));
        }
        Soup crowd(1, 8, 8, orthographic);
        crowd.add_prisms(30'000, random);
        crowd.hold_every(3);
        Sampling sampling{2, 1, 2, 1u << 20, Part::apart};
        expect_same(run(crowd, sampling), trace_in_float(crowd, sampling));
    }
}

TEST_F(TraceTest, BatchesDoNotMatter) {
    std::mt19937 random(23);
    Soup soup(3, 50, 30, false);
    soup.add_prisms(200, random);
    for (uint32_t spp : {6u, 7u}) {
        const std::vector<uint32_t> whole = run(soup, {spp, 3, 6, 1u << 20});
        for (uint64_t slots : {64u, 128u, 640u, 4096u}) EXPECT_EQ(run(soup, {spp, 3, 6, slots}), whole) << slots << " slots";
    }
}

TEST_F(TraceTest, AllOrNothing) {
    Soup nothing(1, 20, 20, true);
    nothing.add_prism({{glm::vec4(90, 90, 1, 1), glm::vec4(99, 90, 1, 1), glm::vec4(90, 99, 1, 1)},
                       {glm::vec4(90, 90, 1, 1), glm::vec4(99, 90, 1, 1), glm::vec4(90, 99, 1, 1)}});
    EXPECT_THAT(run(nothing, {}), testing::Each(shared::kNone));
    Soup everything(1, 20, 20, true);
    everything.add_prism({{glm::vec4(-90, -90, 1, 1), glm::vec4(270, -90, 1, 1), glm::vec4(-90, 270, 1, 1)},
                          {glm::vec4(-80, -80, 1, 1), glm::vec4(270, -90, 1, 1), glm::vec4(-90, 270, 1, 1)}});
    EXPECT_THAT(run(everything, {}), testing::Each(0u));
}

// More entries in a tile than one dispatch may walk; also where a stratum lies in many cells, each with its own list.
TEST_F(TraceTest, LongLists) {
    std::mt19937 random(24);
    for (bool orthographic : {false, true}) {
        Soup soup(1, 8, 8, orthographic);
        soup.add_prisms(30'000, random);
        for (const Sampling& sampling :
             {Sampling{2, 1, 1, 1u << 20}, Sampling{3, 1, 2, 1u << 20}, Sampling{1, 1, 8, 1u << 20}}) {
            expect_same(run(soup, sampling), trace_in_float(soup, sampling));
        }
    }
}

// Behind a wall that faces the eye, what looks away is passed over, but for one of each crew's fetches; in front of it nothing
// is, nor what is as near.
TEST_F(TraceTest, PassesOverWhatIsHidden) {
    constexpr uint32_t kSize = 16, kSpp = 4, kSheets = 160;  // So few tiles that all prisms are small.
    for (bool orthographic : {false, true}) {
        for (const float depth : {1.5f, 1.0f, 0.5f}) {
            SCOPED_TRACE(testing::Message() << "orthographic " << orthographic << ", at " << depth << " of the wall's depth");
            Soup soup(1, kSize, kSize, orthographic);
            const auto add_sheet = [&](float at, bool facing) {
                const auto vertex = [&](float x, float y) {
                    return orthographic ? glm::vec4(x, y, at, 1.0f) : glm::vec4(x * at, y * at, -1.0f, at);
                };
                std::array<glm::vec4, 3> key = {vertex(-90, -90), vertex(200, -90), vertex(-90, 200)};
                if (facing) std::swap(key[1], key[2]);
                soup.add_prism({key, key});
            };
            for (uint32_t i = 0; i < kSheets; ++i) add_sheet(depth, false);
            add_sheet(1.0f, true);
            uint64_t tests = 0;
            const std::vector<uint32_t> found = trace(device(), programs(), soup, {kSpp, 1, 1, 1u << 20}, &tests);
            EXPECT_THAT(found, testing::Each(depth > 1.0f ? kSheets | shared::kReversed : 0u));
            const double per_sample = double(tests) / double(found.size());
            if (depth > 1.0f) {
                EXPECT_LE(per_sample, kSheets / 2 + 8);
            } else {
                EXPECT_GE(per_sample, kSheets + 1);
            }
        }
    }
}

/// A grid of (columns + 1) * (rows + 1) vertices, two triangles for each of its cells, alternately split.
void add_grid(Soup& soup, uint32_t columns, uint32_t rows, const std::vector<std::vector<glm::vec4>>& places) {
    std::vector<uint32_t> vertex;
    for (const auto& p : places) vertex.push_back(soup.add_vertex(p));
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = vertex[y * (columns + 1) + x], b = vertex[y * (columns + 1) + x + 1];
            const uint32_t c = vertex[(y + 1) * (columns + 1) + x], d = vertex[(y + 1) * (columns + 1) + x + 1];
            if ((x + y) % 2 == 0) {
                soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {d, c, b}});
            } else {
                soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {d, c, a}});
            }
        }
    }
}

class WatertightTest : public TraceTest {
protected:
    void expect_no_miss(const Soup& soup, const Sampling& sampling) {
        const std::vector<uint32_t> found = run(soup, sampling);
        EXPECT_EQ(std::count(found.begin(), found.end(), shared::kNone), 0) << "of " << found.size() << " samples";
    }
};

// The walls of a room around the eye, cut into triangles, every vertex shaken at both keys.
TEST_F(WatertightTest, RoomInMotionSeenFromInside) {
    constexpr uint32_t kCuts = 6;
    std::mt19937 random(25);
    std::uniform_real_distribution<float> shake(-0.05f, 0.05f);
    Soup soup(2, 256, 256, false);
    std::map<std::array<int, 3>, std::vector<glm::vec4>> corners;
    const auto corner = [&](std::array<int, 3> at) {
        auto& places = corners[at];
        while (places.size() < 3) {
            const glm::vec3 p = glm::vec3(at[0], at[1], at[2]) / float(kCuts) * 2.0f - 1.0f +
                                glm::vec3(shake(random), shake(random), shake(random));
            places.emplace_back(128.0f * p.x, 128.0f * p.y, -1.0f, p.z);
        }
        return places;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            std::vector<std::vector<glm::vec4>> places;
            for (int v = 0; v <= int(kCuts); ++v) {
                for (int u = 0; u <= int(kCuts); ++u) {
                    std::array<int, 3> at{};
                    at[size_t(axis)] = side * int(kCuts);
                    at[size_t((axis + 1) % 3)] = u;
                    at[size_t((axis + 2) % 3)] = v;
                    places.push_back(corner(at));
                }
            }
            add_grid(soup, kCuts, kCuts, places);
        }
    }
    expect_no_miss(soup, {16, 3, 4, 1u << 21});
}

// Vertices of a still sheet lie exactly at each pixel's first sample, so that every vertex and the ends of every edge are
// sampled.
TEST_F(WatertightTest, SamplesOnVertices) {
    constexpr uint32_t kSize = 96;
    const Sampling sampling{4, 5, 1, 1u << 20};
    for (bool orthographic : {false, true}) {
        for (uint32_t on : {0u, 1u, 3u}) {
            Soup soup(1, kSize, kSize, orthographic);
            std::vector<std::vector<glm::vec4>> places;
            for (int y = -1; y <= int(kSize); ++y) {
                for (int x = -1; x <= int(kSize); ++x) {
                    // Beyond the image: far out, so that the sheet ends nowhere in it.
                    const bool beside = x < 0 || x == int(kSize), above = y < 0 || y == int(kSize);
                    glm::vec2 p = glm::vec2(x, y) - 0.5f * float(kSize);
                    if (beside) p.x *= 9.0f;
                    if (above) p.y *= 9.0f;
                    if (!beside && !above) {
                        const auto px = static_cast<uint32_t>(x), py = static_cast<uint32_t>(y);
                        const glm::vec3 sample = shared::sample_point(shared::pixel_hash(px, py, sampling.seed), px, py, on,
                                                                      shared::stratum_length(sampling.spp));
                        p = glm::vec2(sample.x, sample.y) - 0.5f * float(kSize);
                    }
                    const glm::vec4 place(p, orthographic ? 5.0f : -1.0f, 1.0f);
                    places.push_back({place, place});
                }
            }
            add_grid(soup, kSize + 1, kSize + 1, places);
            expect_no_miss(soup, sampling);
        }
    }
}

// A sheet over the whole image whose vertices are at corners of pixels at both keys.
TEST_F(WatertightTest, SheetInMotionOnPixelCorners) {
    constexpr uint32_t kSize = 128, kCuts = 32;
    std::mt19937 random(26);
    for (bool orthographic : {false, true}) {
        Soup soup(1, kSize, kSize, orthographic);
        std::vector<std::vector<glm::vec4>> places;
        std::uniform_int_distribution<int> power(0, 3);
        for (int y = 0; y <= int(kCuts); ++y) {
            for (int x = 0; x <= int(kCuts); ++x) {
                const glm::vec2 p = 5.0f * glm::vec2(x, y) - 80.0f;
                const float w = orthographic ? 1.0f : std::exp2(float(power(random)));
                const auto at = [&](glm::vec2 q) { return glm::vec4(w * q, orthographic ? 5.0f : -1.0f, w); };
                places.push_back({at(p), at(p + glm::vec2(12, -9))});
            }
        }
        add_grid(soup, kCuts, kCuts, places);
        expect_no_miss(soup, {32, 3, 8, 1u << 21});
    }
}

}  // namespace
}  // namespace gnomon::test
