// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/face.h: every direction has one face.
#include "math/face.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::test {
namespace {

using shared::face_of;

TEST(FaceOf, IsTheLongestComponentsSide) {
    EXPECT_EQ(face_of({3, 1, 2}), 0u);
    EXPECT_EQ(face_of({-3, 1, 2}), 1u);
    EXPECT_EQ(face_of({1, 3, -2}), 2u);
    EXPECT_EQ(face_of({1, -3, -2}), 3u);
    EXPECT_EQ(face_of({-1, 2, 3}), 4u);
    EXPECT_EQ(face_of({-1, 2, -3}), 5u);
}

// Where two components are as long as each other, the first of them decides, and its sign.
TEST(FaceOf, OnAnEdge) {
    EXPECT_EQ(face_of({2, 2, 1}), 0u);
    EXPECT_EQ(face_of({2, -2, 1}), 0u);
    EXPECT_EQ(face_of({-2, 2, -1}), 1u);
    EXPECT_EQ(face_of({2, 1, 2}), 0u);
    EXPECT_EQ(face_of({2, 1, -2}), 0u);
    EXPECT_EQ(face_of({-2, 0, 2}), 1u);
    EXPECT_EQ(face_of({1, 2, 2}), 2u);
    EXPECT_EQ(face_of({1, 2, -2}), 2u);
    EXPECT_EQ(face_of({-1, -2, 2}), 3u);
}

TEST(FaceOf, BesideAnEdge) {
    const float one = 1.0f, more = std::nextafter(one, 2.0f), less = std::nextafter(one, 0.0f);
    EXPECT_EQ(face_of({one, more, 0}), 2u);
    EXPECT_EQ(face_of({one, less, 0}), 0u);
    EXPECT_EQ(face_of({less, -one, less}), 3u);
    EXPECT_EQ(face_of({one, one, more}), 4u);
    EXPECT_EQ(face_of({less, less, -one}), 5u);
}

TEST(FaceOf, AtACorner) {
    for (const float y : {-1.0f, 1.0f}) {
        for (const float z : {-1.0f, 1.0f}) {
            EXPECT_EQ(face_of({1, y, z}), 0u);
            EXPECT_EQ(face_of({-1, y, z}), 1u);
        }
    }
}

TEST(FaceOf, AlongAnAxisAndNowhere) {
    EXPECT_EQ(face_of({0, 1, 0}), 2u);
    EXPECT_EQ(face_of({-0.0f, -1, 0}), 3u);
    EXPECT_EQ(face_of({0, -0.0f, 1}), 4u);
    EXPECT_EQ(face_of({0, 0, -1}), 5u);
    EXPECT_EQ(face_of({0, 0, 0}), 0u);
    EXPECT_EQ(face_of({-0.0f, -0.0f, -0.0f}), 0u);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_LT(face_of({nan, nan, nan}), shared::kFaceCount);
}

}  // namespace
}  // namespace gnomon::test
