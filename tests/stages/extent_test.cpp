// SPDX-License-Identifier: Apache-2.0
// The box of what may shadow something, and the view that is fitted to it.
#include "stages/extent.hpp"

#include "soup.hpp"
#include "stage_test.hpp"

namespace gnomon::test {
namespace {

class ExtentTest : public StageTest {
protected:
    // No triangle lies on the hull of so large a scene.
    Geometry geometry_of(const Soup& soup, const std::vector<uint32_t>& closed) {
        Geometry geometry = pose_geometry(device(), programs(), soup.scene(), soup.poses());
        auto data = std::make_shared<SceneData>(upload_scene(device(), soup.scene()));
        std::vector<uint32_t> shells(soup.triangles.size());
        for (uint32_t i = 0; i < shells.size(); ++i) shells[i] = i % 3;
        data->shells = gpu::upload_new(device(), "shells", shells);
        geometry.scene = data;
        geometry.closed = gpu::upload_new(device(), "closed", closed);
        geometry.box = {glm::vec3(-1e6f), glm::vec3(1e6f)};
        return geometry;
    }
};

// At each key the corners of all triangles, as they are.
TEST_F(ExtentTest, IsTheBoxOfTheVerticesAtEachKey) {
    std::mt19937 random(21);
    for (const uint32_t segments : {1u, 3u}) {
        Soup soup(segments, 150, 77, true);
        soup.add_prisms(1300, random);
        const Geometry geometry = geometry_of(soup, {0, 0, 0});
        const Bins bins = project_prisms(device(), programs(), geometry, soup.view(), segments);
        const Extents extents = casting_extents(device(), programs(), geometry, bins);
        ASSERT_EQ(extents.boxes.size(), segments + 1);
        EXPECT_LE(extents.triangles, soup.triangles.size());
        EXPECT_GT(extents.triangles * 2, soup.triangles.size()) << "but for those without an area";
        for (uint32_t k = 0; k <= segments; ++k) {
            glm::dvec2 lower(1e30), upper(-1e30);
            for (uint32_t i = 0; i < soup.triangles.size(); ++i) {
                const oracle::MovingTriangle t = soup.triangle(i, std::min(k, segments - 1));
                for (const glm::dvec4& p : k < segments ? t.start : t.end) {
                    lower = glm::min(lower, glm::dvec2(p));
                    upper = glm::max(upper, glm::dvec2(p));
                }
            }
            const glm::dvec2 low(extents.boxes[k].lower), high(extents.boxes[k].upper);
            EXPECT_TRUE(low.x >= lower.x && low.y >= lower.y && high.x <= upper.x && high.y <= upper.y);
            EXPECT_LT(glm::length(low - lower) + glm::length(high - upper), 0.05 * glm::length(upper - lower));
        }
    }
}

// What looks toward the eye is of no account in a closed shell; where nothing is left, there is no box.
TEST_F(ExtentTest, LeavesOutWhatShadowsNothing) {
    Soup soup(1, 64, 64, true);
    const auto add = [&](glm::vec2 at, bool away) {
        std::array<uint32_t, 3> v;
        const glm::vec2 corners[3] = {{0.0f, 0.0f}, {4.0f, 0.0f}, {0.0f, 4.0f}};
        for (int i = 0; i < 3; ++i) {
            const glm::vec4 p(at + corners[i], 5.0f, 1.0f);
            v[static_cast<size_t>(i)] = soup.add_vertex({p, p + glm::vec4(1.0f, 2.0f, 0.0f, 0.0f)});
        }
        soup.triangles.push_back(away ? glm::uvec3(v[0], v[1], v[2]) : glm::uvec3(v[0], v[2], v[1]));
    };
    // By turns in shells 0, 1, 2; x right, y down: the first corners are clockwise, seen as positive, which looks away.
    add({-20.0f, -20.0f}, false);
    add({-3.0f, 2.0f}, true);
    add({10.0f, 12.0f}, false);
    const auto boxes = [&](const std::vector<uint32_t>& closed) {
        const Geometry geometry = geometry_of(soup, closed);
        const Bins bins = project_prisms(device(), programs(), geometry, soup.view(), 1);
        return casting_extents(device(), programs(), geometry, bins);
    };
    EXPECT_EQ(boxes({0, 0, 0}).triangles, 3u);
    const Extents one = boxes({1, 1, 1});
    EXPECT_EQ(one.triangles, 1u);
    ASSERT_EQ(one.boxes.size(), 2u);
    EXPECT_EQ(one.boxes[0].lower, glm::vec2(-3.0f, 2.0f));
    EXPECT_EQ(one.boxes[0].upper, glm::vec2(1.0f, 6.0f));
    EXPECT_EQ(one.boxes[1].lower, glm::vec2(-2.0f, 4.0f));
    EXPECT_EQ(one.boxes[1].upper, glm::vec2(2.0f, 8.0f));
    soup.triangles[1] = glm::uvec3(soup.triangles[1].x, soup.triangles[1].z, soup.triangles[1].y);
    EXPECT_EQ(boxes({1, 1, 1}).triangles, 0u);
    EXPECT_TRUE(boxes({1, 1, 1}).boxes.empty());
}

// The fitted view shows the boxes at both keys, two texels within its border, and nothing beside the larger one.
TEST(FittedView, FollowsTheBoxes) {
    Soup soup(1, 512, 512, true);
    const View view = soup.view();
    const std::vector<ViewBox> boxes = {{{-20.0f, 3.0f}, {-10.0f, 8.0f}}, {{100.0f, 50.0f}, {120.0f, 51.0f}}};
    const View fit = fitted(view, 256, boxes);
    EXPECT_EQ(fit.width, 256u);
    EXPECT_EQ(fit.height, 256u);
    for (size_t k = 0; k < 2; ++k) {
        const auto place = [&](glm::vec2 p) {
            const glm::dvec4 world(glm::vec3(p, 7.0f) - fit.keys[k].origin, 1.0);
            return glm::dvec2(glm::dot(glm::dvec4(fit.keys[k].row_x), world), glm::dot(glm::dvec4(fit.keys[k].row_y), world));
        };
        const glm::dvec2 lower = place(boxes[k].lower), upper = place(boxes[k].upper);
        const glm::dvec2 half = k == 0 ? glm::dvec2(63.0, 126.0) : glm::dvec2(126.0, 25.2);
        EXPECT_NEAR(lower.x, -half.x, 1e-3);
        EXPECT_NEAR(lower.y, -half.y, 1e-3);
        EXPECT_NEAR(upper.x, half.x, 1e-3);
        EXPECT_NEAR(upper.y, half.y, 1e-3);
    }
    EXPECT_FLOAT_EQ(fit.scale_x, view.scale_x * 252.0f / 20.0f);
    EXPECT_FLOAT_EQ(fit.scale_y, view.scale_y * 252.0f / 5.0f);
    for (const uint32_t resolution : {1u, 3u, 4u, 5u}) {
        const View small = fitted(view, resolution, boxes);
        EXPECT_GT(small.scale_x, 0.0f) << resolution;
        EXPECT_LE(small.scale_x * 20.0f, view.scale_x * static_cast<float>(resolution)) << resolution;
    }
    const View point = fitted(view, 256, {{{1.0f, 1.0f}, {1.0f, 1.0f}}, {{1.0f, 1.0f}, {1.0f, 1.0f}}});
    EXPECT_TRUE(std::isfinite(point.scale_x) && std::isfinite(point.scale_y));
}

}  // namespace
}  // namespace gnomon::test
