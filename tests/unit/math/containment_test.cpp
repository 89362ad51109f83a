// SPDX-License-Identifier: Apache-2.0
// The property that makes the shadows exact: a texel's range contains every time at which anything of the texel is covered. And
// how tight it is.
#include "containment.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <mutex>
#include <thread>

namespace gnomon::test {
namespace {

using oracle::PrismKind;

constexpr int kCasesPerKind = 100'000;  // 1.1 million in all.

class Containment : public testing::TestWithParam<int> {};

TEST_P(Containment, RangesContainWhatTheOraclesSee) {
    const auto kind = static_cast<PrismKind>(GetParam());
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::mutex mutex;
    uint64_t stays = 0, overlaps = 0, float_hits = 0, excused = 0, errors = 0;
    std::string first_error;
    std::vector<std::thread> workers;
    for (int thread = 0; thread < threads; ++thread) {
        workers.emplace_back([&, thread] {
            Verdict sum;
            for (int i = thread; i < kCasesPerKind; i += threads) {
                std::mt19937 random(static_cast<uint32_t>(i) * 64u + static_cast<uint32_t>(GetParam()));
                const ContainmentCase c = make_case(kind, random);
                const Verdict v = check_containment(c, random);
                sum.stays += v.stays;
                sum.overlaps += v.overlaps;
                sum.float_hits += v.float_hits;
                sum.excused += v.excused;
                if (v.error.empty()) continue;
                const std::lock_guard lock(mutex);
                if (++errors <= 3) first_error += v.error + "\n" + c.text() + "\n";
            }
            const std::lock_guard lock(mutex);
            stays += sum.stays;
            overlaps += sum.overlaps;
            float_hits += sum.float_hits;
            excused += sum.excused;
        });
    }
    for (std::thread& worker : workers) worker.join();
    std::printf("%s: %d prisms, %llu stays, %llu overlaps, %llu float hits, %llu excused\n", oracle::name_of(kind),
                kCasesPerKind, static_cast<unsigned long long>(stays), static_cast<unsigned long long>(overlaps),
                static_cast<unsigned long long>(float_hits), static_cast<unsigned long long>(excused));
    EXPECT_EQ(errors, 0u) << first_error;
    // The prisms do meet their texels, so that there is something to contain.
    EXPECT_GT(stays, static_cast<uint64_t>(kCasesPerKind) / 20);
    EXPECT_GT(overlaps, static_cast<uint64_t>(kCasesPerKind) / 20);
    EXPECT_GT(float_hits, static_cast<uint64_t>(kCasesPerKind) / 50);
    EXPECT_LT(excused, static_cast<uint64_t>(kCasesPerKind) / 1000);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Containment, testing::Range(0, oracle::kPrismKinds),
                         [](const testing::TestParamInfo<int>& kind) {
                             return std::string(oracle::name_of(static_cast<PrismKind>(kind.param)));
                         });

TEST(Ranges, NothingBehindTheEyeIsSeenByTheOracle) {
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        const oracle::Prism prism = oracle::make_prism(PrismKind::behind, false, glm::dvec2(0.0), random);
        EXPECT_TRUE(stays_at(exact(prism), 0.3, 0.4).empty());
    }
}

// What a range costs beyond the truth: time in which nothing is seen, and ranges over texels that are never touched.
TEST(Ranges, AreTight) {
    for (PrismKind kind : {PrismKind::random, PrismKind::sub_texel, PrismKind::fast, PrismKind::huge, PrismKind::motionless,
                           PrismKind::turning}) {
        std::mt19937 random(7);
        double ranges = 0.0, truth = 0.0;
        uint64_t found = 0, needless = 0;
        for (int i = 0; i < 4000; ++i) {
            const ContainmentCase c = make_case(kind, random);
            for (bool positive : {false, true}) {
                const std::optional<TexelRange> range = range_of(c, positive);
                if (!range) continue;
                ++found;
                const std::optional<glm::dvec2> exactly = true_range(c, positive, 256);
                needless += exactly ? 0 : 1;
                const double cell = 1.0 / c.cells;
                if (exactly) {
                    ranges += double(range->leave - range->enter) / cell;
                    truth += (exactly->y - exactly->x) / cell;
                }
            }
        }
        std::printf("%s: ranges are %.3f times as long as the truth; %.1f %% of %llu are needless\n", oracle::name_of(kind),
                    ranges / truth, 100.0 * static_cast<double>(needless) / static_cast<double>(found),
                    static_cast<unsigned long long>(found));
        if (kind == PrismKind::fast) continue;  // True times are too short for 256 instants.
        EXPECT_LT(ranges, 1.5 * truth) << oracle::name_of(kind);
        EXPECT_LT(needless, found * 2 / 3) << oracle::name_of(kind);
    }
}

}  // namespace
}  // namespace gnomon::test
