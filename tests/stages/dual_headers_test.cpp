// SPDX-License-Identifier: Apache-2.0
// The headers that host and shaders share: the same bits on the device, and shared edges that are exact negatives there too.
#include <random>

#include "math/cover.h"
#include "math/sample.h"
#include "stage_test.hpp"
#include "stages/grid.hpp"
#include "test_edges.spv.h"
#include "test_sample_point.spv.h"

namespace gnomon::test {
namespace {

class DualHeadersTest : public StageTest {};

template <size_t kWords>
gpu::Shader shader_of(const char* name, const uint32_t (&words)[kWords]) {
    return {name, {words, kWords}};
}

TEST_F(DualHeadersTest, SamplesHaveTheSameBits) {
    constexpr uint32_t kCount = 1u << 20, kSeed = 77;
    std::mt19937 random(1);
    const auto below = [&](uint32_t end) { return std::uniform_int_distribution<uint32_t>(0, end - 1)(random); };
    std::vector<glm::uvec4> queries;
    for (uint32_t i = 0; i < kCount; ++i) {
        const uint32_t spp = 1 + below(i % 2 == 0 ? 64 : 65536), x = below(16384), y = below(16384);
        queries.emplace_back(x, y, below(spp), glm::floatBitsToUint(shared::stratum_length(spp)));
    }
    const gpu::Buffer input = gpu::upload_new(device(), "queries", queries);
    const gpu::Buffer output = device().allocate("points", kCount * sizeof(glm::vec3));
    const gpu::Program program = device().program(shader_of("sample_point", test_sample_point));
    gpu::Recorder recorder(device());
    recorder.dispatch("sample_point", program, bindings({{"Queries", &input}, {"Points", &output}}), kSeed, kCount / 64);
    recorder.submit();
    const std::vector<glm::vec3> points = gpu::download_vector<glm::vec3>(device(), output, kCount);
    uint64_t differing = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const glm::uvec4& q = queries[i];
        const float length = glm::uintBitsToFloat(q.w);
        const glm::vec3 expected = shared::sample_point(shared::pixel_hash(q.x, q.y, kSeed), q.x, q.y, q.z, length);
        differing += glm::floatBitsToUint(expected) != glm::floatBitsToUint(points[i]) ? 1 : 0;
        ASSERT_GE(points[i].z, shared::stratum_start(q.z, length));
        ASSERT_LT(points[i].z, shared::stratum_start(q.z + 1, length));
    }
    EXPECT_EQ(differing, 0u);
}

TEST_F(DualHeadersTest, EdgesHaveTheSameBitsAndNeighboursAreNegatives) {
    constexpr uint32_t kCount = 1u << 18;
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    const auto vertex = [&](float scale) {
        const float x = scale * normal(random), y = scale * normal(random);
        return glm::vec4(x, y, -1.0f, std::abs(normal(random)) + 0.1f);
    };
    // Queries in pairs: a triangle, and the one on the other side of its edge 0, whose first two vertices are the edge's,
    // swapped.
    std::vector<glm::vec4> corners;
    for (uint32_t i = 0; i < kCount / 2; ++i) {
        const float scale = std::ldexp(1.0f, static_cast<int>(i % 24) - 8);
        const glm::vec4 p = vertex(scale), q = vertex(scale), left = vertex(scale), right = vertex(scale);
        const glm::vec4 point = i % 7 == 0 ? glm::vec4(p.x / p.w, p.y / p.w, 0, 0) : vertex(scale);
        corners.insert(corners.end(), {left, p, q, point, right, q, p, point});
    }
    const gpu::Buffer input = gpu::upload_new(device(), "corners", corners);
    const gpu::Buffer output = device().allocate("edges", kCount * sizeof(glm::vec3));
    const gpu::Program program = device().program(shader_of("edges", test_edges));
    gpu::Recorder recorder(device());
    recorder.dispatch("edges", program, bindings({{"Corners", &input}, {"Edges", &output}}), kCount, kCount / 64);
    recorder.submit();
    const std::vector<glm::vec3> edges = gpu::download_vector<glm::vec3>(device(), output, kCount);
    uint64_t differing = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const glm::vec4* c = &corners[4 * i];
        const glm::vec3 expected = shared::edges_at(c[0], c[1], c[2], c[3].x, c[3].y);
        differing += glm::floatBitsToUint(expected) != glm::floatBitsToUint(edges[i]) ? 1 : 0;
    }
    for (uint32_t i = 0; i < kCount; i += 2) ASSERT_EQ(edges[i].x, -edges[i + 1].x);
    EXPECT_EQ(differing, 0u);
}

}  // namespace
}  // namespace gnomon::test
