// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/turn.h against spherical interpolation in double.
#include "math/turn.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <random>

namespace gnomon::test {
namespace {

glm::vec4 words(const glm::dquat& q) { return glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w)); }

TEST(TurnBetween, IsSphericalInterpolation) {
    std::mt19937 random(5);
    std::normal_distribution<double> component;
    std::uniform_real_distribution<double> unit;
    const auto any = [&] {
        return glm::normalize(glm::dquat(component(random), component(random), component(random), component(random)));
    };
    for (const double most : {0.0, 1e-7, 1e-3, 0.1, 1.0}) {
        for (int i = 0; i < 2000; ++i) {
            const glm::dquat a = any(), other = any();
            const glm::dquat b = glm::slerp(a, glm::dot(a, other) < 0.0 ? -other : other, most);
            const double angle = 2.0 * std::atan2(glm::length(b - a), glm::length(a + b)), s = i < 2 ? i : unit(random);
            const glm::vec4 found = shared::turn_between(words(a), words(b), static_cast<float>(angle), static_cast<float>(s));
            const glm::vec4 expected = words(glm::slerp(a, b, static_cast<double>(static_cast<float>(s))));
            for (int k = 0; k < 4; ++k) ASSERT_NEAR(found[k], expected[k], 2.5e-7f) << angle << " " << s;
        }
    }
}

TEST(TurnBetween, RightAngles) {
    const glm::vec4 found = shared::turn_between({1, 0, 0, 0}, {0, 1, 0, 0}, 1.5707964f, 0.25f);
    EXPECT_NEAR(found.x, std::cos(1.5707963 * 0.25), 1e-7);
    EXPECT_NEAR(found.y, std::sin(1.5707963 * 0.25), 1e-7);
}

}  // namespace
}  // namespace gnomon::test
