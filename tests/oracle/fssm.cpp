// SPDX-License-Identifier: Apache-2.0
#include "oracle/fssm.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::oracle {
namespace {

constexpr int kIntervals = 64;
// The anisotropy of the paper's hardware.
constexpr double kMostProbes = 16.0;

double at_middle(const MapSample& s) { return s.depth + s.motion.z * (0.5 - s.t); }

int interval(double z, double low, double high) {
    return high > low ? std::min(kIntervals - 1, static_cast<int>(std::floor(kIntervals * (z - low) / (high - low)))) : 0;
}

}  // namespace

std::vector<int> layer_starts(const std::vector<int>& occupied, int most) {
    struct Gap {
        int length, start;
    };
    std::vector<Gap> gaps;
    for (size_t i = 1; i < occupied.size(); ++i) {
        if (occupied[i] > occupied[i - 1] + 1) gaps.push_back({occupied[i] - occupied[i - 1] - 1, occupied[i]});
    }
    std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.length > b.length; });
    gaps.resize(std::min(gaps.size(), static_cast<size_t>(most - 1)));
    std::vector<int> starts;
    for (const Gap& gap : gaps) starts.push_back(gap.start);
    std::sort(starts.begin(), starts.end());
    return starts;
}

double visibility_through(const glm::dvec4& tuple, double depth) {
    if (tuple.z == 0.0 || tuple.w == 0.0) return 1.0;
    const double z = tuple.x / tuple.z, z2 = tuple.y / tuple.z, alpha = tuple.z / tuple.w;
    const double variance = std::max(0.0, z2 - z * z);
    const double v = depth <= z ? 1.0 : variance / (variance + (depth - z) * (depth - z));
    return 1.0 - alpha * (1.0 - v);
}

FssmTile::FssmTile(const std::vector<MapSample>& samples, const glm::dvec2& centre, const FssmSettings& settings)
    : centre_(centre), settings_(settings) {
    find_layers(samples);
    for (FssmLayer& layer : layers_) fill(layer, samples);
}

void FssmTile::find_layers(const std::vector<MapSample>& samples) {
    std::vector<const MapSample*> hits;
    for (const MapSample& s : samples) {
        if (s.hit) hits.push_back(&s);
    }
    if (hits.empty()) return;
    std::sort(hits.begin(), hits.end(), [](auto* a, auto* b) { return at_middle(*a) < at_middle(*b); });
    const double low = at_middle(*hits.front()), high = at_middle(*hits.back());
    std::set<int> occupied;
    for (const MapSample* s : hits) occupied.insert(interval(at_middle(*s), low, high));
    const std::vector<int> starts = layer_starts({occupied.begin(), occupied.end()}, settings_.layers);
    size_t next = 0;
    for (size_t layer = 0; layer <= starts.size(); ++layer) {
        FssmLayer found;
        found.near = at_middle(*hits[next]);
        size_t count = 0;
        while (next < hits.size() && (layer == starts.size() || interval(at_middle(*hits[next]), low, high) < starts[layer])) {
            found.motion += hits[next]->motion;
            found.far = at_middle(*hits[next]);
            ++next;
            ++count;
        }
        found.motion /= static_cast<double>(count);
        layers_.push_back(found);
    }
}

glm::dvec2 FssmTile::on_grid(const FssmLayer& layer, const glm::dvec2& place, double t) const {
    const glm::dvec2 d(layer.motion);
    const double f = settings_.window, o = settings_.grid, length = glm::length(d), angle = std::atan2(d.y, d.x);
    // M: a rotation that takes d to the u axis, then eq. 11.
    const glm::dvec2 turned(std::cos(angle) * (place - centre_).x + std::sin(angle) * (place - centre_).y,
                            std::cos(angle) * (place - centre_).y - std::sin(angle) * (place - centre_).x);
    const glm::dvec2 m = o / f * glm::dvec2(f / (f + length), 1.0) * turned;
    return m + glm::dvec2(o / f * f * length / (f + length), 0.0) * (0.5 - t) + 0.5 * o;
}

void FssmTile::fill(FssmLayer& layer, const std::vector<MapSample>& samples) const {
    const int o = settings_.grid;
    layer.tuples.assign(static_cast<size_t>(o * o), glm::dvec4(0.0));
    for (const MapSample& s : samples) {
        const bool in = s.hit && at_middle(s) >= layer.near && at_middle(s) <= layer.far;
        const bool behind = !s.hit || at_middle(s) > layer.far;
        if (!in && !behind) continue;
        const glm::dvec2 p = glm::floor(on_grid(layer, s.place, s.t));
        if (p.x < 0.0 || p.y < 0.0 || p.x >= o || p.y >= o) continue;
        const double z = s.depth + (0.5 - s.t) * layer.motion.z;
        layer.tuples[static_cast<size_t>(p.y) * static_cast<size_t>(o) + static_cast<size_t>(p.x)] +=
            in ? glm::dvec4(z, z * z, 1.0, 1.0) : glm::dvec4(0.0, 0.0, 0.0, 1.0);
    }
}

// The grid in texels `wide` of its own texels wide, each the sum of what it holds; bilinear, its border repeated.
glm::dvec4 FssmTile::filtered(const FssmLayer& layer, glm::dvec2 p, int wide) const {
    const int o = settings_.grid, count = o / wide;
    p /= static_cast<double>(wide);
    glm::dvec4 sum(0.0);
    for (int y = -o; y < count + o; ++y) {
        for (int x = -o; x < count + o; ++x) {
            const double weight = std::max(0.0, 1.0 - std::abs(p.x - x - 0.5)) * std::max(0.0, 1.0 - std::abs(p.y - y - 0.5));
            if (weight == 0.0) continue;
            const int bx = std::clamp(x, 0, count - 1) * wide, by = std::clamp(y, 0, count - 1) * wide;
            for (int i = 0; i < wide * wide; ++i)
                sum += weight * layer.tuples[static_cast<size_t>((by + i / wide) * o + bx + i % wide)];
        }
    }
    return sum;
}

glm::dvec4 FssmTile::footprint(const FssmLayer& layer, const FssmReceiver& r, int wide) const {
    const double o = settings_.grid;
    const glm::dvec2 low(0.5), high(o - 0.5);
    const glm::dvec2 a = glm::clamp(on_grid(layer, r.begin, r.t_begin), low, high);
    const glm::dvec2 b = glm::clamp(on_grid(layer, r.end, r.t_end), low, high);
    const double probes = std::clamp(std::ceil(glm::length(b - a)), 1.0, kMostProbes);
    const double width = settings_.tent ? std::max(0.0, 0.05 * (glm::length(glm::dvec2(layer.motion)) - 2.0)) : 0.0;
    const double half = std::min(0.5 * width, 0.5 * o);
    const int rows = static_cast<int>(std::ceil(half));
    glm::dvec4 sum(0.0);
    for (int i = 0; i < static_cast<int>(probes); ++i) {
        for (int row = -rows; row <= rows; ++row) {
            const double share = row / (rows + 1.0);
            sum += (1.0 - std::abs(share)) *
                   filtered(layer, a + (i + 0.5) / probes * (b - a) + glm::dvec2(0.0, half * share), wide);
        }
    }
    return sum;
}

double FssmTile::visibility(const FssmReceiver& r) const {
    double total = 1.0;
    for (const FssmLayer& layer : layers_) {
        glm::dvec4 tuple(0.0);
        for (int wide = 1; wide <= (settings_.widen ? settings_.grid : 1) && tuple.w == 0.0; wide *= 2)
            tuple = footprint(layer, r, wide);
        total *= visibility_through(tuple, r.depth + (0.5 - r.t) * layer.motion.z);
    }
    return total;
}

}  // namespace gnomon::oracle
