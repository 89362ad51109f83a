// SPDX-License-Identifier: Apache-2.0
// The rows of the benchmark: scenes, made on the spot, and the frames that are made of them.
#include "bench/bench_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gnomon/error.hpp>
#include <numbers>

#include "scenes/scene_makers.hpp"

namespace gnomon::bench {
namespace {

namespace fs = std::filesystem;

BenchScene named(const std::string& name, const std::string& group) {
    BenchScene scene;
    scene.name = name;
    scene.group = group;
    return scene;
}

// Grounds are `ground` times as wide as the scene's own.
BenchScene two_cubes(double ground = 1.0) {
    BenchScene scene = named("two-cubes", "frames");
    scene.count = 6000;
    scene.least = 12;
    scene.make = [=](const fs::path& path, uint32_t n) {
        makers::make_two_cubes(path, {.triangles = n, .ground = 28.0 * ground});
    };
    return scene;
}

BenchScene tube(const std::string& name, uint32_t triangles, double ground = 1.0) {
    BenchScene scene = named(name, "frames");
    scene.count = triangles;
    scene.least = 1000;
    scene.make = [=](const fs::path& path, uint32_t n) { makers::make_tube(path, {.triangles = n, .ground = 8.0 * ground}); };
    return scene;
}

BenchScene random_cubes(double ground = 1.0, double motion = 1.0) {
    BenchScene scene = named("random-cubes", "frames");
    scene.count = 5000;
    scene.make = [=](const fs::path& path, uint32_t n) {
        makers::make_random_cubes(path, {.count = n, .ground = 4.0 * ground, .times = motion});
    };
    return scene;
}

BenchScene stadium(const std::string& name, uint32_t triangles, double motion) {
    BenchScene scene = named(name, "stadium");
    scene.count = triangles;
    scene.least = 1000;
    scene.make = [=](const fs::path& path, uint32_t n) { makers::make_stadium(path, {.triangles = n, .motion = motion}); };
    return scene;
}

BenchScene pillars() {
    BenchScene scene = named("pillars", "lamp");
    scene.count = 7;
    scene.make = [](const fs::path& path, uint32_t n) { makers::make_pillars(path, {.columns = n}); };
    return scene;
}

BenchScene of_4k(BenchScene scene) {
    scene.name += "-4k";
    scene.group = "4k";
    scene.width = 3840;
    scene.height = 2160;
    return scene;
}

// On a growth curve, at `value` of `what`.
BenchScene grown(BenchScene scene, const std::string& what, uint32_t value) {
    scene.name += "@" + what + "=" + std::to_string(value);
    scene.group = what;
    scene.value = value;
    return scene;
}

std::vector<BenchScene> growth_curves() {
    std::vector<BenchScene> all;
    for (const uint32_t n : {20000u, 70000u, 265000u, 1000000u}) all.push_back(grown(tube("tube", n), "triangles", n));
    for (const uint32_t n : {4u, 16u, 64u}) {
        all.push_back(grown(random_cubes(), "samples", n));
        all.back().spp = {n};
    }
    for (const uint32_t n : {512u, 1024u, 2048u, 4096u}) {
        all.push_back(grown(random_cubes(), "texels", n));
        all.back().shadow_res = n;
    }
    for (const uint32_t n : {1u, 4u, 16u}) all.push_back(grown(random_cubes(1.0, n), "motion", n));
    for (const uint32_t n : {1u, 2u, 4u, 8u}) {
        all.push_back(grown(random_cubes(), "lights", n));
        all.back().lights = n;
    }
    const auto of_ground = [&](const auto& make) {
        for (const uint32_t n : {1u, 4u, 16u}) all.push_back(grown(make(n), "ground", n));
    };
    of_ground([](double ground) { return two_cubes(ground); });
    of_ground([](double ground) { return tube("tube-70k", 70000, ground); });
    of_ground([](double ground) { return tube("tube-265k", 265000, ground); });
    of_ground([](double ground) { return random_cubes(ground); });
    return all;
}

// Suns from all sides, as many as are missing.
void add_suns(PosedScene& posed, uint32_t count) {
    for (auto i = static_cast<uint32_t>(posed.scene.lights.size()); i < count; ++i) {
        Light light;
        light.name = "sun " + std::to_string(i);
        posed.scene.lights.push_back(light);
        const double around = i * std::numbers::pi * (3.0 - std::sqrt(5.0));  // No two from one side, whatever their number.
        const glm::dvec3 direction(0.7 * std::cos(around), -1.0, 0.7 * std::sin(around));
        const Rigid place{{}, glm::quatLookAt(glm::normalize(direction), glm::dvec3(0.0, 1.0, 0.0))};
        for (Pose& pose : posed.poses) pose.lights.push_back(place);
    }
}

bool is_chosen(const BenchScene& scene, const std::string& name) {
    return name == scene.name || name == scene.group || (name == "growth" && scene.value > 0.0);
}

}  // namespace

const std::vector<BenchScene>& bench_scenes() {
    static const std::vector<BenchScene> all = [] {
        std::vector<BenchScene> scenes = {two_cubes(), tube("tube-70k", 70000), tube("tube-265k", 265000), random_cubes()};
        for (BenchScene& scene : scenes) scene.spp = {4, 8, 20, 64};
        for (BenchScene& scene : growth_curves()) scenes.push_back(std::move(scene));
        scenes.push_back(stadium("stadium-300k-still", 300000, 0.0));
        scenes.push_back(stadium("stadium-300k", 300000, 0.3));
        scenes.push_back(stadium("stadium-1m", 1000000, 0.3));
        scenes.push_back(of_4k(two_cubes()));
        scenes.push_back(of_4k(random_cubes()));
        scenes.push_back(pillars());
        scenes.push_back(pillars());
        scenes.back().name += "-point";
        scenes.back().point = true;
        return scenes;
    }();
    return all;
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names = {"growth"};
    for (const BenchScene& scene : bench_scenes()) {
        for (const std::string& name : {scene.group, scene.name}) {
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    }
    return names;
}

std::vector<BenchScene> choose_scenes(const std::vector<std::string>& names) {
    const std::vector<std::string> known = scene_names();
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        std::string list;
        for (const std::string& other : known) list += (list.empty() ? "" : ", ") + other;
        throw Error(ErrorKind::usage, "there is no scene '" + name + "'", "--scenes", "use some of " + list);
    }
    std::vector<BenchScene> chosen;
    for (const BenchScene& scene : bench_scenes()) {
        const auto chooses = [&](const std::string& name) { return is_chosen(scene, name); };
        if (std::any_of(names.begin(), names.end(), chooses)) chosen.push_back(scene);
    }
    return chosen;
}

PosedScene make_scene(const BenchScene& scene, double scale) {
    const auto count = static_cast<uint32_t>(std::max<double>(scene.least, std::round(scene.count * scale * scale)));
    PosedScene posed = makers::make_posed([&](const fs::path& path) { scene.make(path, count); });
    if (scene.point) posed.scene.lights.at(0).kind = LightKind::point;
    add_suns(posed, scene.lights);
    return posed;
}

}  // namespace gnomon::bench
