// SPDX-License-Identifier: Apache-2.0
// Errors at equal seconds and seconds to equal errors, on numbers worked out by hand.
#include "io/error_curve.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "throws.hpp"

namespace gnomon::test {

using io::CurvePoint;
using io::CurveValue;
using io::ErrorCurve;
using Where = CurveValue::Where;

namespace {

// The error of independent samples: one over the root of the seconds. Each within 10 %.
const ErrorCurve kMonteCarlo({{16.0, 0.25, 0.025}, {1.0, 1.0, 0.1}, {4.0, 0.5, 0.05}});

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST(ErrorCurve, PointsAreSortedBySeconds) {
    EXPECT_EQ(kMonteCarlo.points()[0].seconds, 1.0);
    EXPECT_EQ(kMonteCarlo.points()[2].seconds, 16.0);
}

// Half way between two points in log(seconds) the error is their geometric mean, and its relative standard error
// sqrt(0.1^2 + 0.1^2) / 2.
TEST(ErrorCurve, ErrorAfterSeconds) {
    const CurveValue between = kMonteCarlo.error_after(2.0);
    EXPECT_EQ(between.where, Where::measured);
    EXPECT_NEAR(between.value, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(between.standard_error, std::sqrt(0.5) * std::sqrt(0.02) / 2.0, 1e-12);
    for (const CurvePoint& point : kMonteCarlo.points()) {
        EXPECT_EQ(kMonteCarlo.error_after(point.seconds).value, point.error);
        EXPECT_EQ(kMonteCarlo.error_after(point.seconds).standard_error, point.standard_error);
    }
}

// A quarter of the way in log(error): 4^(1/4) seconds. Seconds go with the error to the power -2, so their relative standard
// error is twice that of the error.
TEST(ErrorCurve, SecondsToError) {
    const CurveValue between = kMonteCarlo.seconds_to(std::pow(0.5, 0.25));
    EXPECT_EQ(between.where, Where::measured);
    EXPECT_NEAR(between.value, std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(between.standard_error, std::sqrt(2.0) * 2.0 * std::hypot(0.75 * 0.1, 0.25 * 0.1), 1e-12);
    for (const CurvePoint& point : kMonteCarlo.points()) {
        const CurveValue at = kMonteCarlo.seconds_to(point.error);
        EXPECT_EQ(at.where, Where::measured);
        EXPECT_NEAR(at.value, point.seconds, 1e-12);
        EXPECT_NEAR(at.standard_error, 0.2 * point.seconds, 1e-12);
    }
}

TEST(ErrorCurve, NothingIsSaidBeyondTheEnds) {
    EXPECT_EQ(kMonteCarlo.error_after(0.99).where, Where::before_first);
    EXPECT_EQ(kMonteCarlo.error_after(16.1).where, Where::after_last);
    EXPECT_EQ(kMonteCarlo.seconds_to(1.01).where, Where::before_first);
    EXPECT_EQ(kMonteCarlo.seconds_to(0.249).where, Where::after_last);
    for (const CurveValue& value : {kMonteCarlo.error_after(0.99), kMonteCarlo.seconds_to(0.249)}) {
        EXPECT_TRUE(std::isnan(value.value));
        EXPECT_TRUE(std::isnan(value.standard_error));
    }
}

// An error that rises for a while, by noise, is reached when it is first as small.
TEST(ErrorCurve, FirstTimeThatAnErrorIsReached) {
    const ErrorCurve curve({{1.0, 1.0, 0.0}, {2.0, 0.5, 0.0}, {4.0, 0.8, 0.0}, {8.0, 0.25, 0.0}});
    EXPECT_NEAR(curve.seconds_to(0.6).value, std::pow(2.0, std::log(0.6) / std::log(0.5)), 1e-12);
    EXPECT_NEAR(curve.seconds_to(0.4).value, 4.0 * std::pow(2.0, std::log(0.5) / std::log(0.25 / 0.8)), 1e-12);
}

TEST(ErrorCurve, OnePoint) {
    const ErrorCurve curve({{2.0, 0.5, 0.1}});
    EXPECT_EQ(curve.error_after(2.0).value, 0.5);
    EXPECT_EQ(curve.error_after(1.9).where, Where::before_first);
    EXPECT_EQ(curve.seconds_to(0.5).value, 2.0);
    EXPECT_TRUE(std::isnan(curve.seconds_to(0.5).standard_error));
    EXPECT_EQ(curve.seconds_to(0.4).where, Where::after_last);
}

// The reported standard errors are the spread of what is read off curves whose points are drawn again and again.
TEST(ErrorCurve, StandardErrorsAreTheSpread) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    constexpr int kCurves = 20000;
    double error_sum = 0.0, error_squares = 0.0, seconds_sum = 0.0, seconds_squares = 0.0;
    for (int i = 0; i < kCurves; ++i) {
        const ErrorCurve drawn({{1.0, 1.0 + 0.02 * normal(random), 0.02}, {5.0, 0.4 + 0.02 * normal(random), 0.02}});
        const double error = drawn.error_after(2.0).value, seconds = drawn.seconds_to(0.6).value;
        error_sum += error;
        error_squares += error * error;
        seconds_sum += seconds;
        seconds_squares += seconds * seconds;
    }
    const auto spread = [](double sum, double squares) { return std::sqrt(squares / kCurves - sum * sum / kCurves / kCurves); };
    const ErrorCurve curve({{1.0, 1.0, 0.02}, {5.0, 0.4, 0.02}});
    EXPECT_NEAR(curve.error_after(2.0).standard_error / spread(error_sum, error_squares), 1.0, 0.03);
    EXPECT_NEAR(curve.seconds_to(0.6).standard_error / spread(seconds_sum, seconds_squares), 1.0, 0.03);
}

TEST(ErrorCurve, RefusesWhatIsNoCurve) {
    const auto curve = [](const std::vector<CurvePoint>& points) { ErrorCurve refused(points); };
    EXPECT_GNOMON_ERROR(curve({}), ErrorKind::input, "no points");
    EXPECT_GNOMON_ERROR(curve({{1.0, 0.5, 0.0}, {1.0, 0.4, 0.0}}), ErrorKind::input, "two renders");
    for (const double bad : {0.0, -1.0, kNan, std::numeric_limits<double>::infinity()}) {
        EXPECT_GNOMON_ERROR(curve({{bad, 0.5, 0.0}}), ErrorKind::input, "seconds");
        EXPECT_GNOMON_ERROR(curve({{1.0, bad, 0.0}}), ErrorKind::input, "an error of");
    }
    for (const double bad : {-0.1, kNan})
        EXPECT_GNOMON_ERROR(curve({{1.0, 0.5, bad}}), ErrorKind::input, "without its standard error");
}

}  // namespace gnomon::test
