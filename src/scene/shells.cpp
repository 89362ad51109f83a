// SPDX-License-Identifier: Apache-2.0
#include "scene/shells.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace gnomon {
namespace {

// -0 and 0 are one: exporters write either for the same place, and no comparison tells them apart.
uint32_t bits(float value) { return std::bit_cast<uint32_t>(value == 0.0f ? 0.0f : value); }

bool same(const glm::vec3& a, const glm::vec3& b) {
    return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

bool posed_alike(const Scene& scene, const Vertex& a, const Vertex& b) {
    if (!same(a.position, b.position) || a.influence_count != b.influence_count) return false;
    for (uint32_t i = 0; i < a.influence_count; ++i) {
        const Influence& x = scene.influences[a.influence_first + i];
        const Influence& y = scene.influences[b.influence_first + i];
        if (x.matrix != y.matrix || bits(x.weight) != bits(y.weight)) return false;
    }
    const Morph& m = scene.morphs[a.morph];
    const Morph& n = scene.morphs[b.morph];
    if (m.target_count != n.target_count) return false;
    if (m.target_count > 0 && m.weight_first != n.weight_first) return false;
    for (uint32_t j = 0; j < m.target_count; ++j) {
        const glm::vec3& x = scene.morph_positions[m.delta_first + size_t{j} * m.vertex_count + a.morph_vertex];
        const glm::vec3& y = scene.morph_positions[n.delta_first + size_t{j} * n.vertex_count + b.morph_vertex];
        if (!same(x, y)) return false;
    }
    return true;
}

// Of all that posed_alike compares: where many vertices share a place at rest, not all of them may meet in the table.
class Hash {
public:
    void add(uint32_t word) {
        value_ = (value_ ^ word) * 0x9e3779b97f4a7c15u;
        value_ ^= value_ >> 29;
    }
    void add(const glm::vec3& v) {
        add(bits(v.x));
        add(bits(v.y));
        add(bits(v.z));
    }
    uint64_t value() const { return value_; }

private:
    uint64_t value_ = 0;
};

uint64_t hash_of(const Scene& scene, const Vertex& v) {
    Hash hash;
    hash.add(v.position);
    for (uint32_t i = 0; i < v.influence_count; ++i) {
        hash.add(scene.influences[v.influence_first + i].matrix);
        hash.add(bits(scene.influences[v.influence_first + i].weight));
    }
    const Morph& morph = scene.morphs[v.morph];
    for (uint32_t j = 0; j < morph.target_count; ++j)
        hash.add(scene.morph_positions[morph.delta_first + size_t{j} * morph.vertex_count + v.morph_vertex]);
    return hash.value();
}

// Of each vertex the first that is posed alike. A hash table with open addresses.
std::vector<uint32_t> welded(const Scene& scene) {
    constexpr uint32_t kFree = ~0u;
    const size_t slots = std::bit_ceil(2 * scene.vertices.size() + 2);
    const int shift = 64 - std::countr_zero(slots);
    std::vector<uint32_t> table(slots, kFree);
    std::vector<uint32_t> first(scene.vertices.size());
    for (uint32_t v = 0; v < scene.vertices.size(); ++v) {
        size_t slot = hash_of(scene, scene.vertices[v]) >> shift;
        while (table[slot] != kFree && !posed_alike(scene, scene.vertices[table[slot]], scene.vertices[v])) {
            slot = (slot + 1) & (slots - 1);
        }
        if (table[slot] == kFree) table[slot] = v;
        first[v] = table[slot];
    }
    return first;
}

// A triangle at an edge, among all at edges with the same lower vertex.
struct Use {
    uint32_t upper = 0;     // The edge's other vertex,
    uint32_t opposite = 0;  // and the triangle's third.
    uint32_t triangle = 0;  // Twice its number, and one more where it runs from the lower to the upper vertex.

    bool forward() const { return (triangle & 1u) != 0; }
};

// Triangles in sets that grow together.
class Sets {
public:
    explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    uint32_t of(uint32_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    // The lower number stands for both.
    void join(uint32_t a, uint32_t b) {
        a = of(a);
        b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<uint32_t> parent_;
};

// Two corners are one: it covers nothing at any time, and its edges cancel each other.
bool is_empty(const std::array<uint32_t, 3>& corners) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

}  // namespace

Shells find_shells(const Scene& scene) {
    const auto triangle_count = static_cast<uint32_t>(scene.triangles.size());
    const std::vector<uint32_t> vertex = welded(scene);
    std::vector<std::array<uint32_t, 3>> corners(triangle_count);
    std::vector<uint32_t> end(scene.vertices.size() + 1);  // Behind the uses of each lower vertex, once they are filled in.
    for (uint32_t t = 0; t < triangle_count; ++t) {
        for (size_t i = 0; i < 3; ++i) corners[t][i] = vertex[scene.triangles[t].vertex[i]];
        if (is_empty(corners[t])) continue;
        for (size_t i = 0; i < 3; ++i) ++end[std::min(corners[t][i], corners[t][(i + 1) % 3]) + 1];
    }
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Use> uses(end.back());
    for (uint32_t t = 0; t < triangle_count; ++t) {
        if (is_empty(corners[t])) continue;
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t a = corners[t][i], b = corners[t][(i + 1) % 3];
            uses[end[std::min(a, b)]++] = {std::max(a, b), corners[t][(i + 2) % 3], 2 * t + (a < b ? 1u : 0u)};
        }
    }

    Sets sets(triangle_count);
    std::vector<bool> open(triangle_count);
    size_t first = 0;
    for (size_t v = 0; v < scene.vertices.size(); ++v) {
        const auto from = uses.begin() + static_cast<std::ptrdiff_t>(first), to = uses.begin() + end[v];
        std::sort(from, to, [](const Use& a, const Use& b) {
            return a.upper != b.upper         ? a.upper < b.upper
                   : a.opposite != b.opposite ? a.opposite < b.opposite
                                              : a.forward() < b.forward();
        });
        for (auto edge = from; edge != to;) {
            int64_t balance = 0;
            bool sheet = false;
            auto use = edge;
            for (; use != to && use->upper == edge->upper; ++use) {
                balance += use->forward() ? 1 : -1;
                sheet =
                    sheet || (use != edge && use->opposite == (use - 1)->opposite && use->forward() != (use - 1)->forward());
                if (use != edge) sets.join(edge->triangle / 2, use->triangle / 2);
            }
            if (balance != 0 || sheet) open[edge->triangle / 2] = true;
            edge = use;
        }
        first = end[v];
    }
    for (uint32_t t = 0; t < triangle_count; ++t) {
        if (is_empty(corners[t])) open[t] = true;
        if (open[t]) open[sets.of(t)] = true;
    }

    constexpr uint32_t kNotYet = ~0u;
    Shells shells;
    std::vector<uint32_t> number(triangle_count, kNotYet);
    for (uint32_t t = 0; t < triangle_count; ++t) {
        const uint32_t set = sets.of(t);
        if (!open[set] && number[set] == kNotYet) number[set] = shells.count++;
    }
    shells.of_triangle.resize(triangle_count);
    for (uint32_t t = 0; t < triangle_count; ++t) {
        const uint32_t set = sets.of(t);
        shells.of_triangle[t] = open[set] ? shells.count : number[set];
    }
    return shells;
}

}  // namespace gnomon
