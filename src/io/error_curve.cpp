// SPDX-License-Identifier: Apache-2.0
#include "io/error_curve.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <string>

namespace gnomon::io {

namespace {

using Where = CurveValue::Where;

bool is_above_zero(double value) { return std::isfinite(value) && value > 0.0; }

void check(const CurvePoint& point, const std::string& name) {
    const auto refuse = [&](const std::string& what, const std::string& hint) {
        throw Error(ErrorKind::input, what + " cannot be a point of a curve of errors", name, hint);
    };
    if (!is_above_zero(point.seconds)) refuse(std::to_string(point.seconds) + " seconds", "give a render with its time");
    if (!is_above_zero(point.error))
        refuse(std::string("an error of ") + std::to_string(point.error),
               "compare with a reference that differs from the render");
    if (!std::isfinite(point.standard_error) || point.standard_error < 0.0)
        refuse("an error without its standard error", "render more pixels");
}

// At the share w of the way from a to b.
double between(double a, double b, double w) { return a * std::pow(b / a, w); }

// The standard error of log(error) at the share w of the way from a to b.
double log_standard_error(const CurvePoint& a, const CurvePoint& b, double w) {
    return std::hypot((1.0 - w) * a.standard_error / a.error, w * b.standard_error / b.error);
}

// How far log(seconds) moves with log(error).
double log_slope(const CurvePoint& a, const CurvePoint& b) {
    return std::abs(std::log(b.seconds / a.seconds) / std::log(b.error / a.error));
}

}  // namespace

ErrorCurve::ErrorCurve(std::vector<CurvePoint> points, const std::string& name) : points_(std::move(points)) {
    if (points_.empty()) throw Error(ErrorKind::input, "a curve of errors has no points", name, "give at least one render");
    for (const CurvePoint& point : points_) check(point, name);
    std::sort(points_.begin(), points_.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
    const auto same =
        std::adjacent_find(points_.begin(), points_.end(), [](const auto& a, const auto& b) { return a.seconds == b.seconds; });
    if (same != points_.end())
        throw Error(ErrorKind::input, std::string("two renders took ") + std::to_string(same->seconds) + " seconds", name,
                    "give one of them");
}

CurveValue ErrorCurve::error_after(double seconds) const {
    if (seconds < points_.front().seconds) return {.where = Where::before_first};
    if (seconds > points_.back().seconds) return {.where = Where::after_last};
    const auto b = std::find_if(points_.begin(), points_.end(), [&](const CurvePoint& p) { return p.seconds >= seconds; });
    if (b->seconds == seconds) return {Where::measured, b->error, b->standard_error};
    const auto a = b - 1;
    const double w = std::log(seconds / a->seconds) / std::log(b->seconds / a->seconds);
    const double error = between(a->error, b->error, w);
    return {Where::measured, error, error * log_standard_error(*a, *b, w)};
}

CurveValue ErrorCurve::seconds_to(double error) const {
    const CurvePoint& first = points_.front();
    if (error > first.error) return {.where = Where::before_first};
    const auto b = std::find_if(points_.begin(), points_.end(), [&](const CurvePoint& p) { return p.error <= error; });
    if (b == points_.end()) return {.where = Where::after_last};
    if (b == points_.begin()) {
        CurveValue result{.where = Where::measured, .value = first.seconds};
        if (points_.size() > 1 && points_[1].error != first.error)
            result.standard_error = first.seconds * log_slope(first, points_[1]) * log_standard_error(first, points_[1], 0.0);
        return result;
    }
    const auto a = b - 1;
    const double w = std::log(error / a->error) / std::log(b->error / a->error);
    const double seconds = between(a->seconds, b->seconds, w);
    return {Where::measured, seconds, seconds * log_slope(*a, *b) * log_standard_error(*a, *b, w)};
}

}  // namespace gnomon::io
