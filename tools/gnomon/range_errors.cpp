// SPDX-License-Identifier: Apache-2.0
#include "range_errors.hpp"

#include <algorithm>
#include <cmath>

#include "math/interval.h"
#include "math/prism.h"

namespace gnomon::cli {
namespace {

using shared::CellTriangle;

struct Range {
    double enter, leave, enter_metres, exit_metres;

    double metres(double t) const {
        return leave > enter ? enter_metres + (exit_metres - enter_metres) * (t - enter) / (leave - enter) : enter_metres;
    }
};

struct Lists {
    std::vector<float> entry_time, exit_time, entry_depth, exit_depth, linear_depth, prism_depth, prism_depth_texels;
};

glm::vec4 project(const ViewKey& key, const glm::vec3& position) {
    const glm::vec4 p(position - key.origin, 1.0f);
    return {glm::dot(key.row_x, p), glm::dot(key.row_y, p), glm::dot(key.row_z, p), glm::dot(key.row_w, p)};
}

CellTriangle reversed(const CellTriangle& c) { return {c.a0, c.a2, c.a1, c.b0, c.b2, c.b1}; }

std::vector<Range> true_ranges(const CellTriangle& c, float x, float y, bool orthographic) {
    std::vector<Range> ranges;
    for (const CellTriangle& side : {c, reversed(c)}) {
        const shared::PointPrism prism = shared::point_prism(side, x, y);
        const shared::Stays stays = shared::stays_over(prism);
        for (int i = 0; i < 4; ++i) {
            if (!(stays.enter[i] < stays.leave[i])) continue;
            const auto metres = [&](float t) { return double(shared::metres_at(prism, side, t, orthographic)); };
            const Range r{double(stays.enter[i]), double(stays.leave[i]), metres(stays.enter[i]), metres(stays.leave[i])};
            if (orthographic || std::min(r.enter_metres, r.exit_metres) > 0.0) ranges.push_back(r);
        }
    }
    std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.enter < b.enter; });
    // A triangle that turns is seen from one side, then from the other, without a gap.
    std::vector<Range> joined;
    for (const Range& r : ranges) {
        if (!joined.empty() && r.enter - joined.back().leave < 1e-6) {
            joined.back().leave = r.leave;
            joined.back().exit_metres = r.exit_metres;
        } else {
            joined.push_back(r);
        }
    }
    return joined;
}

double true_metres(const CellTriangle& c, float x, float y, double t, bool orthographic) {
    const float s = static_cast<float>(t);
    const auto at = [s](const glm::vec4& a, const glm::vec4& b) { return shared::vertex_at(a, b - a, s); };
    const glm::vec4 p0 = at(c.a0, c.b0), p1 = at(c.a1, c.b1), p2 = at(c.a2, c.b2);
    const glm::vec3 e = shared::edges_at(p0, p1, p2, x, y);
    return orthographic ? double(shared::depth_orthographic(e, p0, p1, p2))
                        : -1.0 / double(shared::depth_perspective(e, p0, p1, p2));
}

std::vector<Range> prism_ranges(const shared::PrismFragments& f, RangeErrors& errors) {
    std::vector<glm::dvec2> sorted;  // Metres, time.
    for (uint32_t i = 0; i < shared::kPrismTriangles; ++i) {
        if ((f.covered >> i & 1u) != 0) sorted.emplace_back(f.metres[i], f.time[i]);
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    errors.left_over += sorted.size() % 2;
    std::vector<Range> ranges;
    for (size_t i = 0; i + 1 < sorted.size(); i += 2) {
        const bool in_order = sorted[i].y <= sorted[i + 1].y;
        const glm::dvec2 &a = sorted[in_order ? i : i + 1], &b = sorted[in_order ? i + 1 : i];
        ranges.push_back({a.y, b.y, a.x, b.x});
    }
    return ranges;
}

double length(const std::vector<Range>& ranges) {
    double sum = 0.0;
    for (const Range& r : ranges) sum += r.leave - r.enter;
    return sum;
}

double shared_length(const std::vector<Range>& a, const std::vector<Range>& b) {
    double sum = 0.0;
    for (const Range& r : a) {
        for (const Range& s : b) sum += std::max(0.0, std::min(r.leave, s.leave) - std::max(r.enter, s.enter));
    }
    return sum;
}

class Comparison {
public:
    explicit Comparison(uint32_t segments) : per_segment_(1.0 / segments) {}

    /// All texels of a prism in one segment of a view.
    void add(const View& view, const CellTriangle& c) {
        const float half_width = 0.5f * static_cast<float>(view.width), half_height = 0.5f * static_cast<float>(view.height);
        int first_x = 0, first_y = 0, last_x = static_cast<int>(view.width) - 1, last_y = static_cast<int>(view.height) - 1;
        if (shared::cell_in_front(c)) {
            const shared::CellBox box = shared::cell_box(c, std::max(half_width, half_height), 0.0f);
            const auto bound = [](float v, int most) {
                return static_cast<int>(std::clamp(v, -1.0f, static_cast<float>(most)));
            };
            first_x = std::max(first_x, bound(std::ceil(box.lower.x + half_width - 0.5f), last_x + 1));
            first_y = std::max(first_y, bound(std::ceil(box.lower.y + half_height - 0.5f), last_y + 1));
            last_x = std::min(last_x, bound(std::floor(box.upper.x + half_width - 0.5f), last_x));
            last_y = std::min(last_y, bound(std::floor(box.upper.y + half_height - 0.5f), last_y));
        }
        if (first_x > last_x || first_y > last_y) return;
        const glm::vec2 centre(0.5f * static_cast<float>(first_x + last_x + 1) - half_width,
                               0.5f * static_cast<float>(first_y + last_y + 1) - half_height);
        const shared::PrismSurface surface = shared::prism_surface(c, centre.x, centre.y, view.orthographic);
        for (int y = first_y; y <= last_y; ++y) {
            for (int x = first_x; x <= last_x; ++x) {
                const glm::vec2 at(static_cast<float>(x) + 0.5f - half_width, static_cast<float>(y) + 0.5f - half_height);
                const shared::PrismFragments f = shared::fragments_at(surface, at.x - centre.x, at.y - centre.y,
                                                                      view.orthographic ? -shared::kFarthest : 0.0f);
                add_pair(view, c, at, true_ranges(c, at.x, at.y, view.orthographic), prism_ranges(f, errors_));
            }
        }
    }

    RangeErrors result() {
        errors_.entry_time = spread_of(std::move(lists_.entry_time));
        errors_.exit_time = spread_of(std::move(lists_.exit_time));
        errors_.entry_depth = spread_of(std::move(lists_.entry_depth));
        errors_.exit_depth = spread_of(std::move(lists_.exit_depth));
        errors_.linear_depth = spread_of(std::move(lists_.linear_depth));
        errors_.prism_depth = spread_of(std::move(lists_.prism_depth));
        errors_.prism_depth_texels = spread_of(std::move(lists_.prism_depth_texels));
        return errors_;
    }

private:
    void add_pair(const View& view, const CellTriangle& c, const glm::vec2& at, const std::vector<Range>& truth,
                  const std::vector<Range>& prism) {
        if (truth.empty() && prism.empty()) return;
        ++errors_.pairs;
        errors_.missed += prism.empty() ? 1 : 0;
        errors_.invented += truth.empty() ? 1 : 0;
        errors_.several += truth.size() > 1 ? 1 : 0;
        const double both = shared_length(truth, prism);
        errors_.true_time += length(truth) * per_segment_;
        errors_.time_missed += (length(truth) - both) * per_segment_;
        errors_.time_invented += std::max(0.0, length(prism) - both) * per_segment_;
        if (truth.size() != 1 || prism.size() != 1) return;
        const Range &t = truth[0], &p = prism[0];
        const auto push = [](std::vector<float>& list, double value) { list.push_back(static_cast<float>(std::fabs(value))); };
        push(lists_.entry_time, (p.enter - t.enter) * per_segment_);
        push(lists_.exit_time, (p.leave - t.leave) * per_segment_);
        push(lists_.entry_depth, p.enter_metres - t.enter_metres);
        push(lists_.exit_depth, p.exit_metres - t.exit_metres);
        double linear = 0.0, of_prism = 0.0, texels = 0.0;
        constexpr int kTimes = 8;
        for (int i = 1; i < kTimes; ++i) {
            const double time = t.enter + (t.leave - t.enter) * i / kTimes;
            const double metres = true_metres(c, at.x, at.y, time, view.orthographic);
            linear = std::max(linear, std::fabs(t.metres(time) - metres));
            if (time < p.enter || time > p.leave) continue;
            const double error = std::fabs(p.metres(time) - metres);
            of_prism = std::max(of_prism, error);
            const double texel = (view.orthographic ? 1.0 : metres) / double(std::min(view.scale_x, view.scale_y));
            texels = std::max(texels, error / texel);
        }
        push(lists_.linear_depth, linear);
        push(lists_.prism_depth, of_prism);
        push(lists_.prism_depth_texels, texels);
    }

    double per_segment_;
    RangeErrors errors_;
    Lists lists_;
};

}  // namespace

Spread spread_of(std::vector<float> values) {
    if (values.empty()) return {};
    double sum = 0.0;
    for (const float v : values) sum += double(v);
    const auto place = values.begin() + static_cast<ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return {sum / static_cast<double>(values.size()), double(*place), double(*std::max_element(place, values.end()))};
}

RangeErrors range_errors(const Scene& scene, const std::vector<Pose>& poses, const std::vector<View>& faces) {
    Comparison comparison(static_cast<uint32_t>(poses.size() - 1));
    for (const View& face : faces) {
        std::vector<std::vector<glm::vec4>> keys;
        for (size_t k = 0; k < poses.size(); ++k) {
            std::vector<glm::vec4>& key = keys.emplace_back();
            for (const glm::vec3& p : posed_positions(scene, poses[k])) key.push_back(project(face.keys[k], p));
        }
        for (size_t k = 0; k + 1 < keys.size(); ++k) {
            for (const Triangle& t : scene.triangles) {
                const auto& v = t.vertex;
                comparison.add(face, {keys[k][v[0]], keys[k][v[1]], keys[k][v[2]], keys[k + 1][v[0]], keys[k + 1][v[1]],
                                      keys[k + 1][v[2]]});
            }
        }
    }
    return comparison.result();
}

}  // namespace gnomon::cli
