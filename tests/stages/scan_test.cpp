// SPDX-License-Identifier: Apache-2.0
// Prefix sums against the oracle: every size around a run, a level and a group of them; sums that do not fit.
#include "stages/scan.hpp"

#include <random>

#include "oracle/prefix_sum.hpp"
#include "stage_test.hpp"

namespace gnomon::test {
namespace {

class ScanTest : public StageTest {
protected:
    /// The sums with their total, and the longest.
    std::pair<std::vector<uint32_t>, uint32_t> run(const std::vector<uint32_t>& values) {
        std::vector<uint32_t> padded = values;
        padded.resize(scan_bytes(values.size()) / 4);
        gpu::Buffer buffer = gpu::upload_new(device(), "values", padded);
        const gpu::Buffer sums = device().allocate("sums", scan_bytes(values.size()));
        const Scan scan = record_scan(device(), programs(), buffer, static_cast<uint32_t>(values.size()), sums);
        return {gpu::download_vector<uint32_t>(device(), sums, values.size() + 1),
                gpu::download_vector<uint32_t>(device(), scan.longest, 1)[0]};
    }

    void expect_as_oracle(const std::vector<uint32_t>& values) {
        const auto [sums, longest] = run(values);
        const std::vector<uint64_t> expected = oracle::exclusive_sums(values);
        ASSERT_TRUE(std::equal(sums.begin(), sums.end(), expected.begin(), expected.end())) << values.size() << " values";
        ASSERT_EQ(longest, values.empty() ? 0u : *std::max_element(values.begin(), values.end())) << values.size() << " values";
    }
};

TEST_F(ScanTest, EverySize) {
    std::mt19937 random(1);
    std::vector<uint32_t> sizes = {0, 1, 2, 3};
    for (uint32_t around : {64u, 1024u, 4096u, 65536u, 65536u * 4u}) {
        for (uint32_t size = around - 2; size <= around + 2; ++size) sizes.push_back(size);
    }
    for (uint32_t size : sizes) {
        std::vector<uint32_t> values(size);
        for (uint32_t& v : values) v = std::uniform_int_distribution<uint32_t>(0, 4000)(random);
        expect_as_oracle(values);
    }
}

TEST_F(ScanTest, ZerosAndOneLargeValue) {
    for (size_t size : {1u, 1000u, 5000u, 70000u}) {
        expect_as_oracle(std::vector<uint32_t>(size, 0));
        for (size_t place : {size_t(0), size / 2, size - 1}) {
            std::vector<uint32_t> values(size, 0);
            values[place] = 0xfffffffeu;
            expect_as_oracle(values);
        }
    }
}

// Where the sum passes 2^32 in the last run, in an earlier one, or only from run to run.
TEST_F(ScanTest, SumsThatDoNotFitAreReported) {
    for (size_t size : {2u, 1000u, 1025u, 5000u, 70000u}) {
        for (size_t place : {size_t(0), (size - 1) / 2, size - 2}) {
            std::vector<uint32_t> values(size, 1);
            values[place] = 0xffffffffu;
            values[place + 1] = 10;
            EXPECT_EQ(run(values).first.back(), 0xffffffffu) << size << " values, at " << place;
        }
        if (size < 64) continue;
        const std::vector<uint32_t> values(size, static_cast<uint32_t>((1ull << 32) / size + 1));
        EXPECT_EQ(run(values).first.back(), 0xffffffffu) << size << " equal values";
    }
}

}  // namespace
}  // namespace gnomon::test
