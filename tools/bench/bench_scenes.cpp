// SPDX-License-Identifier: Apache-2.0
// The scenes of the benchmark, made on the spot.
#include "bench/bench_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <gnomon/error.hpp>

#include "scenes/scene_makers.hpp"

namespace gnomon::bench {
namespace {

namespace fs = std::filesystem;

struct Entry {
    std::string name;
    uint32_t count;  // Triangles or cubes, at full size.
    uint32_t least;  // What its maker allows.
    std::function<void(const fs::path&, uint32_t count)> make;
};

void make_tube(const fs::path& path, uint32_t triangles) { makers::make_tube(path, {.triangles = triangles, .pixels = 10.0}); }

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = {
        {"two-cubes", 6000, 12, [](const fs::path& path, uint32_t n) { makers::make_two_cubes(path, {.triangles = n}); }},
        {"tube-70k", 70000, 1000, make_tube},
        {"tube-265k", 265000, 1000, make_tube},
        {"random-cubes", 5000, 1, [](const fs::path& path, uint32_t n) { makers::make_random_cubes(path, {.count = n}); }},
    };
    return all;
}

}  // namespace

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const Entry& entry : entries()) names.push_back(entry.name);
    return names;
}

PosedScene make_scene(const std::string& name, double scale) {
    const auto entry = std::find_if(entries().begin(), entries().end(), [&](const Entry& e) { return e.name == name; });
    if (entry == entries().end()) {
        std::string known;
        for (const std::string& other : scene_names()) known += (known.empty() ? "" : ", ") + other;
        throw Error(ErrorKind::usage, "there is no scene '" + name + "'", "--scenes", "use some of " + known);
    }
    const double count = std::max<double>(entry->least, std::round(entry->count * scale * scale));
    return makers::make_posed([&](const fs::path& path) { entry->make(path, static_cast<uint32_t>(count)); });
}

}  // namespace gnomon::bench
