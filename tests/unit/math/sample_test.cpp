// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/sample.h: the documented properties of samples.
#include "math/sample.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "shared/slot.h"

namespace gnomon::test {
namespace {

TEST(SamplePoint, LiesInItsPixelAndStratum) {
    std::mt19937 random(1);
    const auto below = [&](uint32_t end) { return std::uniform_int_distribution<uint32_t>(0, end - 1)(random); };
    for (int i = 0; i < 1'000'000; ++i) {
        const uint32_t spp = 1u + below(i % 3 == 0 ? 65536 : 32), s = below(spp);
        const uint32_t x = below(16384), y = below(16384);
        const float length = shared::stratum_length(spp);
        const glm::vec3 p = shared::sample_point(shared::pixel_hash(x, y, below(100)), x, y, s, length);
        ASSERT_GE(p.x, float(x));
        ASSERT_LE(p.x, float(x + 1));
        ASSERT_GE(p.y, float(y));
        ASSERT_LE(p.y, float(y + 1));
        ASSERT_GE(p.z, shared::stratum_start(s, length));
        ASSERT_LT(p.z, shared::stratum_start(s + 1, length));
        ASSERT_LE(shared::stratum_start(spp, length), 1.0f);
        ASSERT_NEAR(p.z * double(spp), s + 0.5, 0.5 * (1.0 + 1e-6 * spp));
    }
}

TEST(SamplePoint, IsEvenlySpread) {
    constexpr uint32_t kBins = 8, kPixels = 64, kSpp = 64;
    std::vector<uint32_t> counts[3];
    for (auto& c : counts) c.resize(kBins);
    for (uint32_t y = 0; y < kPixels; ++y) {
        for (uint32_t x = 0; x < kPixels; ++x) {
            const uint32_t hash = shared::pixel_hash(x, y, 3);
            for (uint32_t s = 0; s < kSpp; ++s) {
                const glm::vec3 p = shared::sample_point(hash, x, y, s, shared::stratum_length(kSpp));
                ++counts[0][std::min(kBins - 1, uint32_t((p.x - float(x)) * kBins))];
                ++counts[1][std::min(kBins - 1, uint32_t((p.y - float(y)) * kBins))];
                ++counts[2][std::min(kBins - 1, uint32_t((p.z * kSpp - float(s)) * kBins))];
            }
        }
    }
    const double expected = double(kPixels) * kPixels * kSpp / kBins;
    for (const auto& c : counts) {
        for (uint32_t n : c) EXPECT_NEAR(n, expected, 6.0 * std::sqrt(expected));
    }
}

// From one sample to the next x and y grow by the same fractions of a pixel: the inverses of the plastic number and of its
// square, less whole pixels.
TEST(SamplePoint, IsALatticeInThePixel) {
    constexpr double kPlastic = 1.32471795724474602596;
    const float kLength = shared::stratum_length(1001);
    const uint32_t hash = shared::pixel_hash(0, 0, 9);
    for (uint32_t s = 0; s < 1000; ++s) {
        const glm::vec3 p = shared::sample_point(hash, 0, 0, s, kLength), q = shared::sample_point(hash, 0, 0, s + 1, kLength);
        const double dx = double(q.x) - p.x, dy = double(q.y) - p.y;
        EXPECT_NEAR(dx - std::floor(dx), 1.0 / kPlastic, 1e-6);
        EXPECT_NEAR(dy - std::floor(dy), 1.0 / (kPlastic * kPlastic), 1e-6);
    }
}

TEST(SamplePoint, DiffersBetweenPixelsSeedsAndSamples) {
    std::set<uint32_t> hashes;
    for (uint32_t x = 0; x < 64; ++x) {
        for (uint32_t y = 0; y < 64; ++y) {
            for (uint32_t seed = 0; seed < 4; ++seed) hashes.insert(shared::pixel_hash(x, y, seed));
        }
    }
    EXPECT_GT(hashes.size(), 64u * 64u * 4u - 16u);
}

TEST(UnitFloat, NeverReachesOne) {
    EXPECT_EQ(shared::unit_float(0), 0.0f);
    EXPECT_LT(shared::unit_float(0xffffffffu), 1.0f);
    EXPECT_EQ(shared::unit_float(0x80000000u), 0.5f);
}

TEST(CellOf, SplitsTheShutter) {
    for (uint32_t cells : {1u, 3u, 4u, 16u, 63u}) {
        EXPECT_EQ(shared::cell_of(0.0f, cells), 0u);
        EXPECT_EQ(shared::cell_of(std::nextafter(1.0f, 0.0f), cells), cells - 1);
        uint32_t last = 0;
        for (int i = 0; i < 1000; ++i) {
            const float t = float(i) / 1000.0f;
            const uint32_t cell = shared::cell_of(t, cells);
            ASSERT_GE(cell, last);
            ASSERT_NEAR(double(cell), std::floor(double(t) * cells), i * int(cells) % 1000 == 0 ? 1.0 : 0.0);
            last = cell;
        }
    }
}

TEST(TileSlot, GivesEachPixelAPlaceAndEachEightABlockOfFourByTwo) {
    for (uint32_t slot = 0; slot < 64; ++slot) {
        const uint32_t column = shared::slot_column(slot), row = shared::slot_row(slot), first = slot / 8 * 8;
        ASSERT_LT(column, 8u);
        ASSERT_LT(row, 8u);
        EXPECT_EQ(shared::tile_slot(column, row), slot);
        EXPECT_EQ(column / 4, shared::slot_column(first) / 4);
        EXPECT_EQ(row / 2, shared::slot_row(first) / 2);
    }
}

}  // namespace
}  // namespace gnomon::test
