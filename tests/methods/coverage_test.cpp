// SPDX-License-Identifier: Apache-2.0
// The coverage map: by hand, and against what the paper's three passes say of each texel's fragments.
#include "stages/coverage.hpp"

#include <algorithm>
#include <bit>

#include "oracle/prism_surface.hpp"
#include "soup.hpp"
#include "stage_test.hpp"

namespace gnomon::test {
namespace {

class CoverageTest : public StageTest {
protected:
    std::vector<uint32_t> coverage_of(const Soup& soup) {
        const Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        const Bins bins = bin_prisms(device(), programs(), geometry, soup.view(), soup.segments(), Listing::bounds);
        const CoverageMap map = make_coverage(device(), programs(), {geometry, bins}, soup.orthographic, false);
        const auto found = gpu::download_vector<uint32_t>(device(), map.coverage, map.coverage.bytes() / 4);
        EXPECT_EQ(map.covered, found.size() - static_cast<uint64_t>(std::count(found.begin(), found.end(), shared::kNone)));
        return found;
    }
};

/// A triangle that holds the whole image, or its left half.
oracle::Prism wide(float depth_start, float depth_end, float right = 1000.0f) {
    oracle::Prism p;
    const glm::vec2 corners[3] = {{-1000, -1000}, {right, -1000}, {right, 5000}};
    for (size_t i = 0; i < 3; ++i) {
        p.start[i] = glm::vec4(corners[i], depth_start, 1);
        p.end[i] = glm::vec4(corners[i], depth_end, 1);
    }
    return p;
}

// What covers a texel and is nearest there is found; what is behind it does not matter, nor what is behind its far end.
TEST_F(CoverageTest, NearestThatStays) {
    Soup soup(1, 8, 8, true);
    soup.add_prism(wide(9, 9));
    soup.add_prism(wide(5, 3));
    soup.add_prism(wide(6, 7, 0));
    EXPECT_EQ(coverage_of(soup), std::vector<uint32_t>(64, 1u));
}

// A triangle between the covering one's depths takes it away, where it is: in the left half.
TEST_F(CoverageTest, WhatIsNearerThanItsFarEndTakesItAway) {
    Soup soup(1, 8, 8, true);
    soup.add_prism(wide(5, 3));
    soup.add_prism(wide(4, 4, 0));
    std::vector<uint32_t> expected(64);
    for (uint32_t i = 0; i < 64; ++i) expected[i] = i % 8 < 4 ? shared::kNone : 0u;
    EXPECT_EQ(coverage_of(soup), expected);
}

// What leaves a texel does not cover it, and nothing that it hid for a while does.
TEST_F(CoverageTest, WhatLeavesDoesNotCover) {
    Soup soup(1, 8, 8, true);
    oracle::Prism leaving = wide(2, 2, 0);
    for (auto& v : leaving.end) v.x -= 2.0f;
    soup.add_prism(leaving);
    soup.add_prism(wide(5, 5));
    std::vector<uint32_t> expected(64);
    for (uint32_t i = 0; i < 64; ++i) expected[i] = i % 8 < 2 ? 0u : i % 8 < 4 ? shared::kNone : 1u;
    EXPECT_EQ(coverage_of(soup), expected);
}

// The paper's passes over the oracle's fragments.
uint32_t paper_coverage(const std::vector<oracle::FragmentsAt>& prisms) {
    double depth = 1e300, time = 0.0;
    uint32_t nearest = shared::kNone, covering = shared::kNone;
    for (uint32_t id = 0; id < prisms.size(); ++id) {
        for (const oracle::Fragment& f : prisms[id].fragments) {
            if (f.metres >= depth) continue;
            depth = f.metres;
            time = f.time;
            nearest = id;
        }
    }
    if (nearest == shared::kNone) return covering;
    for (const oracle::Fragment& f : prisms[nearest].fragments) {
        if (std::fabs(f.time - time) < 1.0 - 1e-9) continue;
        covering = nearest;
        depth = f.metres;
    }
    for (uint32_t id = 0; id < prisms.size() && covering != shared::kNone; ++id) {
        const auto& list = prisms[id].fragments;
        if (id != covering && std::any_of(list.begin(), list.end(), [&](const auto& f) { return f.metres < depth; }))
            covering = shared::kNone;
    }
    return covering;
}

TEST_F(CoverageTest, IsThePapersOfRandomPrisms) {
    std::mt19937 random(31);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (const bool orthographic : {false, true}) {
        for (const uint32_t segments : {1u, 2u}) {
            Soup soup(segments, 24, 16, orthographic);
            for (int i = 0; i < 10; ++i) {
                glm::uvec3 triangle;
                for (glm::length_t v = 0; v < 3; ++v) {
                    std::vector<glm::vec4> places;
                    glm::vec3 at(20.0f * unit(random), 16.0f * unit(random), 8.0f + 4.0f * unit(random));
                    for (uint32_t k = 0; k <= segments; ++k) {
                        places.push_back(orthographic ? glm::vec4(at, 1.0f) : glm::vec4(at.x * at.z, at.y * at.z, -1.0f, at.z));
                        at += glm::vec3(3.0f * unit(random), 3.0f * unit(random), 0.5f * unit(random));
                    }
                    triangle[v] = soup.add_vertex(places);
                }
                soup.triangles.push_back(triangle);
            }
            const std::vector<uint32_t> found = coverage_of(soup);
            uint64_t compared = 0, covered = 0, differ = 0;
            for (uint32_t i = 0; i < found.size(); ++i) {
                const uint32_t item = i / 64, segment = item % segments, tile = item / segments;
                const glm::dvec2 at = glm::dvec2(tile % 3 * 8 + i % 8, tile / 3 * 8 + i / 8 % 8) + 0.5 - glm::dvec2(12.0, 8.0);
                std::vector<oracle::FragmentsAt> prisms;
                bool certain = true;
                for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
                    const oracle::PrismSurface surface = triangulate(soup.triangle(t, segment), orthographic);
                    prisms.push_back(fragments_at(surface, at.x, at.y, orthographic));
                    certain = certain && surface.certain && prisms.back().certain;
                }
                if (!certain) continue;
                ++compared;
                covered += found[i] != shared::kNone ? 1 : 0;
                differ += found[i] != paper_coverage(prisms) ? 1 : 0;
            }
            EXPECT_GT(compared, found.size() / 2);
            EXPECT_GT(covered, 20u);
            EXPECT_EQ(differ, 0u) << "of " << compared;
        }
    }
}

}  // namespace
}  // namespace gnomon::test
