// SPDX-License-Identifier: Apache-2.0
// FLIP on small pictures whose answers follow from the definition by hand.
// Based on: Andersson et al. 2020, "FLIP: A difference evaluator for alternating images".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pictures.hpp"

namespace gnomon::test {

using io::ShownPicture;

namespace {

double largest_of(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double least_of(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

/// Two greys, of lightness 50 and 60 in CIELAB: (66 / 116)^3 and (76 / 116)^3.
constexpr double kDark = 0.1841865185124442, kLight = 0.2812333429004879, kStep = kLight - kDark;

Color grey(double y) { return {y, y, y}; }

/// FLIP in the middle of a dark picture that has light pixels in the test.
double flip_of_light(double pixels_per_degree, const std::function<bool(int, int)>& is_light) {
    constexpr int kSize = 25, kMiddle = 12;
    const ShownPicture test = picture(kSize, kSize, [&](uint32_t x, uint32_t y) {
        return grey(is_light(static_cast<int>(x) - kMiddle, static_cast<int>(y) - kMiddle) ? kLight : kDark);
    });
    const ShownPicture dark = picture(kSize, kSize, [](uint32_t, uint32_t) { return grey(kDark); });
    return io::flip(test, dark, pixels_per_degree)[kMiddle * kSize + kMiddle];
}

/// The error of a difference of colours below the knee, 203.312 being that of green and blue.
double color_error(double hyab) { return 0.95 / 0.4 * std::pow(hyab / 203.3118964, 0.7); }

/// The lightness of a relative luminance that is not very dark.
double lightness(double y) { return 116.0 * std::cbrt(y) - 16.0; }

/// Colours and features together.
double combined(double color, double feature) { return std::pow(color, 1.0 - std::sqrt(feature / std::numbers::sqrt2)); }

struct Gaussian {
    double a, b;
};

// Table 1 of the paper: achromatic, red and green, blue and yellow.
const std::vector<Gaussian> kAchromatic = {{1.0, 0.0047}}, kRedGreen = {{1.0, 0.0053}},
                            kBlueYellow = {{34.1, 0.04}, {13.5, 0.025}};

/// Contrast sensitivity at a pixel, over the sum in a window of 13 x 13: what 40 pixels per degree need.
double weight(const std::vector<Gaussian>& gaussians, int x, int y) {
    const auto at = [&](int i, int j) {
        double sum = 0.0;
        for (const auto& [a, b] : gaussians)
            sum +=
                a * std::sqrt(std::numbers::pi / b) * std::exp(-std::pow(std::numbers::pi / 40.0, 2.0) * (i * i + j * j) / b);
        return sum;
    };
    double total = 0.0;
    for (int j = -6; j <= 6; ++j)
        for (int i = -6; i <= 6; ++i) total += at(i, j);
    return at(x, y) / total;
}

// Rows of the matrix from linear R, G, B to X, Y, Z.
constexpr Color kX = {0.4124, 0.3576, 0.1805}, kY = {0.2126, 0.7152, 0.0722}, kZ = {0.0193, 0.1192, 0.9505};

double dot(const Color& a, const Color& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A change of colour that two of X, Y, Z do not see, with a change of R or B of 0.4.
Color unseen_by(const Color& a, const Color& b) {
    Color c = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double scale = 0.4 / std::max(std::abs(c[0]), std::abs(c[2]));
    for (double& v : c) v *= scale;
    return c;
}

/// FLIP at (x, y) from a pixel that differs from grey 0.5 by a change, at 40 pixels per degree. The pixel is in the middle of
/// the picture or in its upper left corner.
double flip_from_pixel(const Color& change, int x, int y, bool in_corner = false) {
    const uint32_t place = in_corner ? 0 : 10;
    const ShownPicture test = picture(21, 21, [&](uint32_t i, uint32_t j) {
        Color color = grey(0.5);
        if (i == place && j == place)
            for (size_t c = 0; c < 3; ++c) color[c] += change[c];
        return color;
    });
    const ShownPicture plain_grey = picture(21, 21, [](uint32_t, uint32_t) { return grey(0.5); });
    return io::flip(test, plain_grey, 40.0)[(place + static_cast<uint32_t>(y)) * 21 + place + static_cast<uint32_t>(x)];
}

}  // namespace

TEST(Flip, EqualPicturesDoNotDiffer) {
    const ShownPicture p = picture(30, 30, [](uint32_t x, uint32_t y) { return Color{x / 29.0, y / 29.0, (x ^ y) / 31.0}; });
    EXPECT_EQ(largest_of(io::flip(p, p)), 0.0);
}

// Plain pictures have no features, so that the error is that of the colours alone. Green and blue differ most.
TEST(Flip, PlainColors) {
    const std::vector<double> most = io::flip(plain(kGreen), plain(kBlue));
    EXPECT_NEAR(least_of(most), 1.0, 1e-6);
    EXPECT_NEAR(largest_of(most), 1.0, 1e-6);
    // Black and white: 100 of lightness. Green is (87.74, -86.18, 83.18) in CIELAB, blue (32.30, 79.19, -107.86); with a and b
    // times L / 100 they are (87.74, -75.61, 72.98) and (32.30, 25.58, -34.84), 55.44 + 147.98 = 203.4 apart. 0.95 + 0.05
    // (100^0.7 - 0.4 203.4^0.7) / (0.6 203.4^0.7) = 0.9674.
    const std::vector<double> contrast = io::flip(plain(kBlack), plain(kWhite));
    EXPECT_NEAR(least_of(contrast), 0.9674, 5e-4);
    EXPECT_NEAR(largest_of(contrast), 0.9674, 5e-4);
    // Below the knee: 10 of lightness, from 50 to 60. 0.95 / 0.4 (10 / 203.4)^0.7 = 0.2883.
    EXPECT_NEAR(largest_of(io::flip(plain(grey(kDark)), plain(grey(kLight)))), 0.2883, 5e-4);
}

// A step that moves by two pixels differs there, and not far from there.
TEST(Flip, EdgesAreSeenWhereTheyAre) {
    const ShownPicture step = picture(64, 8, [](uint32_t x, uint32_t) { return x < 32 ? kBlack : kWhite; });
    const ShownPicture moved = picture(64, 8, [](uint32_t x, uint32_t) { return x < 34 ? kBlack : kWhite; });
    const std::vector<double> error = io::flip(moved, step);
    const size_t row = 4 * 64;
    EXPECT_GT(error[row + 32], 0.5);
    EXPECT_GT(error[row + 33], 0.5);
    EXPECT_LT(error[row + 4], 1e-3);
    EXPECT_LT(error[row + 60], 1e-3);
}

// Other colours, with a and b times L / 100. Red is (53.233, 42.642, 35.785), the dark blue (12.248, 5.672, -7.725): 40.985
// + 57.095 apart. (0.8, 0.05, 0) is (52.491, 32.757, 33.656): 0.742 + 10.112. The two greens are (64.629, -19.360, 23.600) and
// (62.869, -10.898, 15.338): 1.760 + 11.827. Black and 0.004 are so dark that CIELAB is linear: 903.3 times 0.004 is 3.613.
TEST(Flip, PlainColorsOfAllKinds) {
    const auto error = [](const Color& a, const Color& b) { return io::flip(plain(a), plain(b))[10 * 24 + 12]; };
    EXPECT_NEAR(error({1.0, 0.0, 0.0}, {0.0, 0.0, 0.2}), 0.966695, 2e-5);  // Above the knee.
    EXPECT_NEAR(error({1.0, 0.0, 0.0}, {0.8, 0.05, 0.0}), 0.305382, 2e-5);
    EXPECT_NEAR(error({0.2, 0.4, 0.1}, {0.25, 0.35, 0.15}), 0.357388, 2e-5);
    EXPECT_NEAR(error(kBlack, grey(0.004)), 0.141408, 2e-5);
}

// At 8 pixels per degree the detectors have 3 x 3 weights: of edges 1, 0, -1, of points 1/2, -1, 1/2, smoothed across by q, 1 -
// 2 q, q with q = e / (1 + 2 e), e = exp(-1 / (2 0.328^2)). Brightness is not filtered there: its next weight is exp(-32.8).
constexpr double kCoarse = 8.0;
constexpr double kSmooth = 0.00940494;

// On a line one pixel wide the edge detector sees 0 and the point detector the whole step.
TEST(Flip, LinesAreFoundByThePointDetector) {
    const double error = flip_of_light(kCoarse, [](int x, int) { return x == 0; });
    EXPECT_NEAR(error, combined(color_error(10.0), kStep), 1e-6);
    EXPECT_NEAR(error, 0.399412, 1e-5);
    EXPECT_NEAR(flip_of_light(kCoarse, [](int, int y) { return y == 0; }), error, 1e-12);
}

// Beside a step the edge detector sees the whole step and the point detector half of it.
TEST(Flip, StepsAreFoundByTheEdgeDetector) {
    const double error = flip_of_light(kCoarse, [](int x, int) { return x >= 0; });
    EXPECT_NEAR(error, combined(color_error(10.0), kStep), 1e-6);
    EXPECT_NEAR(flip_of_light(kCoarse, [](int, int y) { return y >= 0; }), error, 1e-12);
}

// A pixel is a point along both axes, seen through 1 - 2 q; in a corner there are edges along both, seen through 1 - q.
TEST(Flip, FeaturesAlongBothAxesAddUp) {
    EXPECT_NEAR(flip_of_light(kCoarse, [](int x, int y) { return x == 0 && y == 0; }),
                combined(color_error(10.0), std::numbers::sqrt2 * (1.0 - 2.0 * kSmooth) * kStep), 1e-6);
    EXPECT_NEAR(flip_of_light(kCoarse, [](int x, int y) { return x >= 0 && y >= 0; }),
                combined(color_error(10.0), std::numbers::sqrt2 * (1.0 - kSmooth) * kStep), 1e-6);
}

// What both pictures have is not a difference.
TEST(Flip, FeaturesOfBothPicturesCancel) {
    const auto line = [](double on) { return picture(9, 9, [=](uint32_t x, uint32_t) { return grey(x == 4 ? kLight : on); }); };
    const double error = io::flip(line(kDark), line(kDark + 0.01), kCoarse)[4 * 9 + 3];
    const double color = color_error(lightness(kDark + 0.01) - lightness(kDark));
    EXPECT_NEAR(error, combined(color, 0.01), 1e-5);  // The edges beside the line are 0.01 apart, whatever the line.
}

// At 40 pixels per degree the weights of one axis are exp(-1.31244 x^2) over their sum, 1.54882: a line keeps 0.64565 of its
// step. The point detector of 11 x 11 has -1 / (1 + 2 0.52164) in its middle.
TEST(Flip, BrightnessIsFiltered) {
    const double line = 1.0 / (1.0 + 2.0 * (0.269163 + 0.00524878 + 0.0000074));
    const double expected = combined(color_error(lightness(kDark + line * kStep) - 50.0), kStep / (1.0 + 2.0 * 0.521643));
    EXPECT_NEAR(flip_of_light(40.0, [](int x, int) { return x == 0; }), expected, 1e-5);
    EXPECT_NEAR(expected, 0.289696, 1e-5);
}

TEST(Flip, WeightsOfContrastSensitivity) {
    EXPECT_NEAR(weight(kAchromatic, 1, 0), 0.112202, 1e-6);  // 0.64565^2 exp(-1.31244)
    // One axis: exp(-1.16387 x^2) over 1.64363.
    EXPECT_NEAR(weight(kRedGreen, 0, 0), 1.0 / (1.64363 * 1.64363), 1e-5);
    EXPECT_NEAR(weight(kRedGreen, 2, 1), std::exp(-5.0 * 1.16387) / (1.64363 * 1.64363), 1e-7);
    // 34.1 sqrt(pi / 0.04) = 302.203 and 13.5 sqrt(pi / 0.025) = 151.335; exponents 0.154213 and 0.246740, and axes of 4.51352
    // and 3.56824.
    const double total = 302.203 * 4.51236 * 4.51236 + 151.335 * 3.56824 * 3.56824;
    EXPECT_NEAR(weight(kBlueYellow, 3, 2),
                (302.203 * std::exp(-13.0 * 0.154213) + 151.335 * std::exp(-13.0 * 0.246740)) / total, 1e-7);
    EXPECT_NEAR(weight(kBlueYellow, 3, 2), 0.00579525, 1e-7);
}

// A pixel that differs in X alone has the luminance of the others, hence no features, and their b: a is 500 (f(X) - f(Y)), and
// L is 76.0693. So its error around it shows the weights of red and green.
TEST(Flip, RedAndGreenAreFiltered) {
    const Color change = unseen_by(kY, kZ);
    const double x_change = dot(kX, change) / (kX[0] + kX[1] + kX[2]);
    const auto expected = [&](double w) {
        return color_error(0.01 * 76.0693 * 500.0 * std::abs(std::cbrt(0.5 + w * x_change) - std::cbrt(0.5)));
    };
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(2, 1), std::pair(-1, 2)})
        EXPECT_NEAR(flip_from_pixel(change, x, y) / expected(weight(kRedGreen, x, y)), 1.0, 1e-5) << x << " " << y;
}

// In Z alone: b is 200 (f(Y) - f(Z)).
TEST(Flip, BlueAndYellowAreFiltered) {
    const Color change = unseen_by(kX, kY);
    const double z_change = dot(kZ, change) / (kZ[0] + kZ[1] + kZ[2]);
    const auto expected = [&](double w) {
        return color_error(0.01 * 76.0693 * 200.0 * std::abs(std::cbrt(0.5 + w * z_change) - std::cbrt(0.5)));
    };
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(3, 2), std::pair(-6, 6), std::pair(0, -4)})
        EXPECT_NEAR(flip_from_pixel(change, x, y) / expected(weight(kBlueYellow, x, y)), 1.0, 1e-5) << x << " " << y;
    EXPECT_NEAR(flip_from_pixel(change, 7, 0), 0.0, 1e-6);  // Beyond the window.
    // Beyond the picture its edge goes on: the corner has all weights of one quarter.
    double corner = 0.0;
    for (int j = 0; j <= 6; ++j)
        for (int i = 0; i <= 6; ++i) corner += weight(kBlueYellow, i, j);
    EXPECT_NEAR(flip_from_pixel(change, 0, 0, true) / expected(corner), 1.0, 1e-5);
}

}  // namespace gnomon::test
