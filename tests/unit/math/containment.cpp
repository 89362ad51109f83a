// SPDX-License-Identifier: Apache-2.0
#include "containment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "math/sample.h"

namespace gnomon::test {
namespace {

using oracle::PrismKind;

constexpr uint32_t kTile = 8;

double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

uint32_t pick(std::mt19937& random, std::initializer_list<uint32_t> values) {
    return values.begin()[std::uniform_int_distribution<size_t>(0, values.size() - 1)(random)];
}

// Of the texel, with its sides and corners, rounded as samples are.
glm::vec2 point_of(const oracle::Box& box, std::mt19937& random) {
    const auto along = [&](double low, double high) {
        const uint32_t where = pick(random, {0, 1, 2, 2, 2, 2});
        return static_cast<float>(where == 0 ? low : where == 1 ? high : uniform(random, low, high));
    };
    const float x = along(box.lower.x, box.upper.x);
    return {x, along(box.lower.y, box.upper.y)};
}

// Where the triangle's middle is at some time of the cell, if that is in the texel; else any point of it.
glm::dvec2 covered_point(const ContainmentCase& c, std::mt19937& random) {
    const double s = uniform(random, c.local_start(), c.local_end());
    glm::dvec4 sum(0.0);
    for (size_t i = 0; i < 3; ++i) sum += glm::mix(glm::dvec4(c.prism.start[i]), glm::dvec4(c.prism.end[i]), s);
    const glm::dvec2 middle(sum.x / sum.w, sum.y / sum.w);
    const oracle::Box box = c.box();
    const bool inside = sum.w > 0.0 && glm::all(glm::lessThan(box.lower, middle)) && glm::all(glm::lessThan(middle, box.upper));
    return inside ? middle : glm::dvec2(point_of(box, random));
}

struct FloatVertices {
    glm::vec4 p0, p1, p2;
};

FloatVertices vertices_at(const oracle::Prism& prism, bool positive, float local) {
    const size_t second = positive ? 1 : 2, third = positive ? 2 : 1;
    const auto at = [&](size_t i) { return shared::vertex_at(prism.start[i], prism.end[i] - prism.start[i], local); };
    return {at(0), at(second), at(third)};
}

// As sample/trace and sample/shadow decide it, the depth unbounded.
std::optional<float> float_depth(const ContainmentCase& c, bool positive, glm::vec2 point, float local) {
    const FloatVertices v = vertices_at(c.prism, positive, local);
    const glm::vec3 e = shared::edges_at(v.p0, v.p1, v.p2, point.x, point.y);
    const float depth =
        c.orthographic ? shared::depth_orthographic(e, v.p0, v.p1, v.p2) : shared::depth_perspective(e, v.p0, v.p1, v.p2);
    if (!shared::covers(e) || !(depth > -3.4e38f) || !(depth < (c.orthographic ? 3.4e38f : 0.0f))) return std::nullopt;
    return depth;
}

std::string describe(const char* what, bool positive, glm::dvec2 point, double from, double to,
                     const std::optional<TexelRange>& range) {
    std::ostringstream out;
    out.precision(17);
    out << what << (positive ? " (positive)" : " (negative)") << " at " << point.x << ", " << point.y << " from " << from
        << " to " << to << ", range ";
    if (range) {
        out << range->enter << " to " << range->leave << " nearest " << range->nearest;
    } else {
        out << "none";
    }
    return out.str();
}

// Thinner, in texels, than what the rounding of absolute coordinates does to its vertices: which way its edges run is lost
// (math/range.h).
bool is_lost_in_rounding(const ContainmentCase& c, double s) {
    std::array<glm::dvec2, 3> p;
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec4 v = glm::mix(glm::dvec4(c.prism.start[i]), glm::dvec4(c.prism.end[i]), s);
        if (v.w <= 0.0) return false;
        p[i] = glm::dvec2(v.x, v.y) / v.w;
    }
    const double longest = std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
    return std::abs(u.x * v.y - u.y * v.x) <= longest * double(shared::kShiftRounding) * 0.5 * c.size;
}

}  // namespace

oracle::Box ContainmentCase::box() const {
    const glm::dvec2 lower = glm::dvec2(texel) - 0.5 * size;
    return {lower, lower + 1.0};
}

double ContainmentCase::local_start() const {
    const uint32_t per_segment = cells / segments;
    return double(cell - segment * per_segment) / per_segment;
}

double ContainmentCase::local_end() const { return local_start() + double(segments) / cells; }

double ContainmentCase::shutter(double local) const { return (segment + local) / segments; }

std::string ContainmentCase::text() const {
    std::ostringstream out;
    out.precision(9);
    out << oracle::name_of(kind) << (orthographic ? ", orthographic" : ", perspective") << ", image " << size << ", texel "
        << texel.x << ", " << texel.y << ", segment " << segment << " of " << segments << ", cell " << cell << " of " << cells;
    for (const auto* key : {&prism.start, &prism.end}) {
        for (const glm::vec4& v : *key) out << "\n  " << v.x << ", " << v.y << ", " << v.z << ", " << v.w;
    }
    return out.str();
}

ContainmentCase make_case(PrismKind kind, std::mt19937& random) {
    ContainmentCase c;
    c.kind = kind;
    c.orthographic = pick(random, {0, 1}) == 1;
    c.size = pick(random, {64, 100, 512, 1024, 4095, 16384});
    for (int axis = 0; axis < 2; ++axis) {
        const uint32_t any = std::uniform_int_distribution<uint32_t>(0, c.size - 1)(random);
        c.texel[axis] = pick(random, {0, c.size - 1, c.size / 2, any, any, any});
    }
    c.segments = pick(random, {1, 3});
    c.cells = c.segments == 1 ? pick(random, {1, 3, 4, 16}) : pick(random, {3, 6, 15});
    c.cell = std::uniform_int_distribution<uint32_t>(0, c.cells - 1)(random);
    c.segment = c.cell / (c.cells / c.segments);
    c.prism = oracle::make_prism(kind, c.orthographic, c.box().lower, random);
    return c;
}

std::optional<TexelRange> range_of(const ContainmentCase& c, bool positive) {
    const oracle::Prism& p = c.prism;
    const size_t second = positive ? 1 : 2, third = positive ? 2 : 1;
    const uint32_t per_segment = c.cells / c.segments, first = c.cell - c.segment * per_segment;
    const float start = float(first) / float(per_segment), end = float(first + 1) / float(per_segment);
    const glm::vec4 a0 = p.start[0], a1 = p.start[second], a2 = p.start[third];
    const glm::vec4 d0 = p.end[0] - a0, d1 = p.end[second] - a1, d2 = p.end[third] - a2;
    const float extent = 0.5f * float(c.size), half = 0.5f * float(kTile);
    // Setup sees the triangle in its own order.
    const shared::CellTriangle given =
        shared::cell_triangle(a0, p.start[1], p.start[2], d0, p.end[1] - p.start[1], p.end[2] - p.start[2], start, end);
    const uint32_t seen =
        shared::prism_orientations(a0, p.start[1], p.start[2], d0, p.end[1] - p.start[1], p.end[2] - p.start[2], given, extent);
    if ((seen & (positive ? shared::kSeenPositive : shared::kSeenNegative)) == 0u) return std::nullopt;

    const shared::CellTriangle triangle = shared::cell_triangle(a0, a1, a2, d0, d1, d2, start, end);
    const glm::vec2 centre = glm::vec2(c.texel / kTile * kTile) + half - 0.5f * float(c.size);
    const glm::vec2 in_tile = glm::vec2(c.texel % kTile) + 0.5f - half;
    const float slack = shared::time_slack(c.cells);
    const glm::uvec2 rows = shared::tile_rows(triangle, centre.y, half, extent, slack);
    const uint32_t row = c.texel.y % kTile;
    if (row < rows.x || row > rows.y) return std::nullopt;
    const shared::TileBounds bounds = shared::tile_bounds(triangle, centre.x, centre.y, half, extent);
    const shared::ColumnBounds column = shared::column_bounds(bounds, in_tile.x);
    const glm::vec3 times = shared::texel_times(column, in_tile.y);
    if (!shared::touches_texel(times, slack)) return std::nullopt;
    const glm::vec2 range = shared::range_times(times, float(c.cell), 1.0f / float(c.cells), slack);
    return TexelRange{range.x, range.y, shared::nearest_depth(triangle, c.orthographic)};
}

Verdict check_containment(const ContainmentCase& c, std::mt19937& random) {
    constexpr int kPoints = 2, kInstants = 4, kFloatSamples = 8;
    Verdict verdict;
    const oracle::MovingTriangle triangle = exact(c.prism);
    const oracle::Box box = c.box();
    const std::optional<TexelRange> ranges[2] = {range_of(c, false), range_of(c, true)};
    const double start = c.local_start(), end = c.local_end();
    const auto contained = [&](bool positive, double from, double to) {
        const std::optional<TexelRange>& range = ranges[positive];
        return range && double(range->enter) <= c.shutter(from) && c.shutter(to) <= double(range->leave);
    };
    std::vector<double> times = {start, end};

    for (int i = 0; i < kPoints; ++i) {
        const glm::dvec2 point = i == 0 ? covered_point(c, random) : glm::dvec2(point_of(box, random));
        for (const oracle::Stay& stay : stays_at(triangle, point.x, point.y)) {
            const double enter = std::max(stay.enter, start), leave = std::min(stay.leave, end);
            if (enter >= leave) continue;
            ++verdict.stays;
            times.push_back(enter);
            times.push_back(leave);
            if (!contained(stay.positive, enter, leave)) {
                if (is_lost_in_rounding(c, 0.5 * (enter + leave))) {
                    ++verdict.excused;
                    continue;
                }
                verdict.error =
                    describe("stay", stay.positive, point, c.shutter(enter), c.shutter(leave), ranges[stay.positive]);
                return verdict;
            }
            const double s = uniform(random, enter, leave);
            const std::optional<oracle::Surface> surface = surface_at(triangle, point.x, point.y, s);
            if (surface && surface->positive == stay.positive && !(double(ranges[stay.positive]->nearest) <= surface->depth)) {
                verdict.error = describe("depth", stay.positive, point, c.shutter(s), surface->depth, ranges[stay.positive]);
                return verdict;
            }
        }
    }
    for (int i = 0; i < kInstants; ++i) {
        const double s = i < 2 ? (i == 0 ? start : end) : uniform(random, start, end);
        const std::optional<bool> positive = orientation_in(triangle, box, s);
        if (!positive) continue;
        ++verdict.overlaps;
        if (!contained(*positive, s, s)) {
            if (is_lost_in_rounding(c, s)) {
                ++verdict.excused;
                continue;
            }
            verdict.error = describe("overlap", *positive, box.lower, c.shutter(s), c.shutter(s), ranges[*positive]);
            return verdict;
        }
    }
    for (int i = 0; i < kFloatSamples; ++i) {
        // Where the exact times are the float test is least sure: at the ends of stays.
        const size_t known = std::uniform_int_distribution<size_t>(0, times.size() - 1)(random);
        const double s = i % 2 == 0 ? uniform(random, start, end) : times[known] + uniform(random, -1e-6, 1e-6);
        const float t = static_cast<float>(c.shutter(s));
        if (t < 0.0f || t >= 1.0f || shared::cell_of(t, c.cells) != c.cell) continue;
        const float local = t * float(c.segments) - float(c.segment);
        const glm::vec2 point = point_of(box, random);
        for (bool positive : {false, true}) {
            const std::optional<float> depth = float_depth(c, positive, point, local);
            if (!depth) continue;
            ++verdict.float_hits;
            const std::optional<TexelRange>& range = ranges[positive];
            if (!range || t < range->enter || t > range->leave) {
                if (is_lost_in_rounding(c, local)) {
                    ++verdict.excused;
                    continue;
                }
                verdict.error = describe("float test", positive, point, t, t, range);
                return verdict;
            }
        }
    }
    return verdict;
}

std::optional<glm::dvec2> true_range(const ContainmentCase& c, bool positive, int steps) {
    const oracle::MovingTriangle triangle = exact(c.prism);
    std::optional<glm::dvec2> hull;
    for (int i = 0; i <= steps; ++i) {
        const double s = glm::mix(c.local_start(), c.local_end(), double(i) / steps);
        if (orientation_in(triangle, c.box(), s) != std::optional(positive)) continue;
        const double t = c.shutter(s);
        hull = hull ? glm::dvec2(hull->x, t) : glm::dvec2(t, t);
    }
    return hull;
}

}  // namespace gnomon::test
