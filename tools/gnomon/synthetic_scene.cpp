// SPDX-License-Identifier: Apache-2.0
#include "synthetic_scene.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <numeric>
#include <random>
#include <sstream>

#include "made_scene.hpp"
#include "methods/method.hpp"
#include "options.hpp"

namespace gnomon::cli {

namespace {

constexpr uint32_t kSquares = 16;  ///< Along a side, of 1 m each.
constexpr double kLowest = 0.1, kHighest = 2.0, kMotion = 0.125;
constexpr uint32_t kDirections = 4, kGround = kDirections;  ///< Matrices.
constexpr double kMostMean = 1000.0;

struct Layer {
    uint32_t stack = 0;
    uint32_t number = 0;  ///< In its stack, from below.
    double height = 0.0;
};

template <class Value>
Value choose(const std::string& text, const std::vector<std::pair<std::string, Value>>& all, const std::string& member) {
    std::string names;
    for (const auto& [name, value] : all) {
        if (name == text) return value;
        names += (names.empty() ? "" : ", ") + name;
    }
    throw Error(ErrorKind::usage, "there are no " + member + " '" + text + "'", "--synthetic", "use " + names);
}

const std::vector<std::pair<std::string, Synthetic::Lengths>>& all_lengths() {
    using enum Synthetic::Lengths;
    static const std::vector<std::pair<std::string, Synthetic::Lengths>> all = {
        {"uniform", uniform}, {"zipf", zipf}, {"spike", spike}};
    return all;
}

const std::vector<std::pair<std::string, Synthetic::Order>>& all_orders() {
    using enum Synthetic::Order;
    static const std::vector<std::pair<std::string, Synthetic::Order>> all = {
        {"as-is", as_is}, {"shuffled", shuffled}, {"sorted", sorted}};
    return all;
}

template <class Value>
std::string name_of(Value value, const std::vector<std::pair<std::string, Value>>& all) {
    return std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.second == value; })->first;
}

/// Shuffled the same way by every standard library, as std::shuffle need not be.
template <class T>
void shuffle(std::vector<T>& values, std::mt19937& random) {
    for (size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random() % i]);
}

void add_layer(Scene& scene, const Layer& layer) {
    const uint32_t square = layer.stack / 2;
    const double x = square % kSquares - 0.5 * kSquares, z = square / kSquares - 0.5 * kSquares, y = layer.height;
    const uint32_t matrix = layer.number % kDirections;
    if (layer.stack % 2 == 0) {
        add_triangle(scene, {{x, y, z}, {x, y, z + 1.0}, {x + 1.0, y, z}}, matrix);
    } else {
        add_triangle(scene, {{x + 1.0, y, z + 1.0}, {x + 1.0, y, z}, {x, y, z + 1.0}}, matrix);
    }
}

}  // namespace

std::string Synthetic::name() const {
    const std::string base = "synthetic-" + name_of(lengths, all_lengths()) + "-" + number_text(mean);
    return order == Order::as_is ? base : base + "-" + name_of(order, all_orders());
}

Synthetic parse_synthetic(const std::string& text) {
    Synthetic result;
    bool has_lengths = false;
    std::istringstream members(text);
    for (std::string member; std::getline(members, member, ',');) {
        const size_t equals = member.find('=');
        const std::string name = member.substr(0, equals), value = equals == std::string::npos ? "" : member.substr(equals + 1);
        if (name == "lengths") {
            result.lengths = choose(value, all_lengths(), name);
            has_lengths = true;
        } else if (name == "order") {
            result.order = choose(value, all_orders(), name);
        } else if (name == "mean") {
            result.mean = parse_number(value, "--synthetic mean", 0.0, kMostMean);
        } else {
            throw Error(ErrorKind::usage, "there is no '" + name + "'", "--synthetic", "use lengths, mean and order");
        }
    }
    if (!has_lengths)
        throw Error(ErrorKind::usage, "lengths are not given", "--synthetic", "use lengths=uniform, zipf or spike");
    return result;
}

std::vector<uint32_t> stack_heights(const Synthetic& synthetic, uint32_t stacks) {
    // In any unit; scaled to the mean below.
    std::vector<double> shares(stacks);
    const uint32_t spikes = std::max(1u, stacks / 64);
    for (uint32_t i = 0; i < stacks; ++i) {
        switch (synthetic.lengths) {
            case Synthetic::Lengths::uniform:
                shares[i] = i + 0.5;
                break;
            case Synthetic::Lengths::zipf:
                shares[i] = 1.0 / (i + 1.0);
                break;
            case Synthetic::Lengths::spike:
                shares[i] = i < spikes ? 1.0 / spikes : 1.0 / (stacks - spikes);
                break;
        }
    }
    const double scale = synthetic.mean * stacks / std::accumulate(shares.begin(), shares.end(), 0.0);
    // What rounding takes from one the next ones get.
    std::vector<uint32_t> heights(stacks);
    double sum = 0.0;
    uint64_t given = 0;
    for (uint32_t i = 0; i < stacks; ++i) {
        sum += shares[i] * scale;
        heights[i] = static_cast<uint32_t>(std::max(0.0, std::round(sum - static_cast<double>(given))));
        given += heights[i];
    }
    return heights;
}

Scene synthetic_scene(const Synthetic& synthetic, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<uint32_t> heights = stack_heights(synthetic, 2 * kSquares * kSquares);
    shuffle(heights, random);
    std::vector<Layer> layers;
    for (uint32_t stack = 0; stack < heights.size(); ++stack) {
        for (uint32_t j = 0; j < heights[stack]; ++j)
            layers.push_back({stack, j, kLowest + (kHighest - kLowest) * (j + 0.5) / heights[stack]});
    }
    if (synthetic.order == Synthetic::Order::shuffled) shuffle(layers, random);
    if (synthetic.order == Synthetic::Order::sorted)
        std::stable_sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) { return a.height > b.height; });

    Scene scene;
    scene.path = synthetic.name();
    scene.materials.emplace_back();
    scene.morphs.emplace_back();
    const double half = kSquares;
    add_triangle(scene, {{-half, 0.0, -half}, {-half, 0.0, half}, {half, 0.0, -half}}, kGround);
    add_triangle(scene, {{half, 0.0, half}, {half, 0.0, -half}, {-half, 0.0, half}}, kGround);
    for (const Layer& layer : layers) add_layer(scene, layer);
    scene.cameras.push_back({"above", -1, CameraKind::perspective, 0.6, 0.0, 1.0, 1.0, 0.1, 0.0});
    Light& sun = scene.lights.emplace_back();
    sun.intensity = 3.0f;
    return scene;
}

std::vector<Pose> synthetic_poses(double speed, uint32_t segments) {
    constexpr double kAcross[kDirections][2] = {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};
    std::vector<Pose> poses;
    for (uint32_t k = 0; k <= segments; ++k) {
        Pose& pose = poses.emplace_back();
        const double moved = kMotion * speed * (static_cast<double>(k) / segments - 0.5);
        for (uint32_t m = 0; m <= kGround; ++m) {
            const double x = m == kGround ? 0.0 : kAcross[m][0] * moved, z = m == kGround ? 0.0 : kAcross[m][1] * moved;
            pose.palette.insert(pose.palette.end(), {{1, 0, 0, x}, {0, 1, 0, 0}, {0, 0, 1, z}});
        }
        constexpr double kDown = 50.0 / 180.0 * 3.14159265358979, kAway = 28.0;
        const glm::dvec3 eye(0.0, kAway * std::sin(kDown), kAway * std::cos(kDown));
        pose.cameras.push_back({eye, glm::angleAxis(-kDown, glm::dvec3(1.0, 0.0, 0.0))});
        pose.lights.push_back(looking_down({0.0, 10.0, 0.0}, 0.0));
    }
    return poses;
}

}  // namespace gnomon::cli
