// SPDX-License-Identifier: Apache-2.0
// Random changes to small valid files: each must load or end in gnomon::Error, and what loads must pose.
#include <chrono>
#include <cstdio>
#include <random>

#include "rich_document.hpp"

namespace gnomon::test {
namespace {

class Mutator {
public:
    explicit Mutator(uint32_t seed) : random_(seed) {}

    size_t below(size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random_); }

    // Changes one value, somewhere in the document.
    void mutate(json& value) {
        if (value.is_structured() && !value.empty() && below(8) != 0) {
            auto it = value.begin();
            std::advance(it, below(value.size()));
            mutate(*it);
            return;
        }
        if (value.is_structured() && !value.empty() && below(2) == 0) {
            if (value.is_array()) {
                below(2) == 0 ? value.erase(below(value.size())) : value.push_back(value[below(value.size())]);
            } else {
                auto it = value.begin();
                std::advance(it, below(value.size()));
                value.erase(it);
            }
            return;
        }
        value = interesting(value);
    }

    // Overwrites, removes or doubles a few bytes.
    void mutate(std::string& bytes) {
        for (size_t i = below(4) + 1; i > 0 && !bytes.empty(); --i) {
            const size_t at = below(bytes.size());
            switch (below(3)) {
                case 0:
                    bytes[at] = static_cast<char>(below(256));
                    break;
                case 1:
                    bytes.erase(at, below(8) + 1);
                    break;
                default:
                    bytes.insert(at, bytes.substr(at, below(8) + 1));
                    break;
            }
        }
    }

private:
    json interesting(const json& before) {
        static const std::vector<json> kValues = {0,
                                                  1,
                                                  2,
                                                  3,
                                                  4,
                                                  5,
                                                  7,
                                                  12,
                                                  255,
                                                  256,
                                                  5120,
                                                  5121,
                                                  5123,
                                                  5125,
                                                  5126,
                                                  65535,
                                                  65536,
                                                  2147483647,
                                                  2147483648u,
                                                  4294967295u,
                                                  4294967296u,
                                                  uint64_t{18446744073709551615u},
                                                  -1,
                                                  -2147483648LL,
                                                  0.5,
                                                  1e30,
                                                  1e300,
                                                  -1e300,
                                                  "",
                                                  "SCALAR",
                                                  "VEC4",
                                                  "MAT4",
                                                  "MAT2",
                                                  "scale",
                                                  "CUBICSPLINE",
                                                  "../x",
                                                  "/etc/passwd",
                                                  "data.bin",
                                                  "data:;base64,AAAA",
                                                  nullptr,
                                                  true,
                                                  json::array(),
                                                  json::object(),
                                                  json::array({0}),
                                                  json::array({1, 2, 3})};
        if (before.is_number_integer() && below(2) == 0) return before.get<int64_t>() + static_cast<int64_t>(below(5)) - 2;
        return kValues[below(kValues.size())];
    }

    std::mt19937 random_;
};

struct Counts {
    int loaded = 0;
    int rejected = 0;
};

// Any other exception, a signal or a report of a sanitizer fails the test.
void try_file(const std::filesystem::path& path, Counts& counts) {
    try {
        const Scene scene = load_scene(path);
        ++counts.loaded;
        for (const Triangle& triangle : scene.triangles) {
            for (const uint32_t vertex : triangle.vertex) ASSERT_LT(vertex, scene.vertices.size());
        }
        const std::vector<Pose> poses = pose_scene(scene, {AnimationChoice::Kind::all, 0}, 0.0, 1.0, 2);
        if (!scene.triangles.empty()) bounds_of(scene, poses);
    } catch (const Error& e) {
        ASSERT_EQ(e.kind(), ErrorKind::input) << e.what();
        ASSERT_FALSE(std::string(e.what()).empty());
        ++counts.rejected;
    }
}

constexpr int kRuns = 3000;

// Calls run(i) up to kRuns times, less on slow machines.
template <typename F>
void bounded_runs(const F& run) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
    int done = 0;
    while (done < kRuns && std::chrono::steady_clock::now() < end) run(done++);
    EXPECT_GT(done, 50);
}

TEST(Mutation, TheOriginalLoads) {
    Gltf gltf;
    rich_document(gltf);
    EXPECT_EQ(gltf.error(), "");
}

TEST(Mutation, OfValues) {
    Gltf gltf;
    const json original = rich_document(gltf);
    Mutator mutator(1);
    Counts counts;
    bounded_runs([&](int) {
        json changed = original;
        for (size_t i = mutator.below(3) + 1; i > 0; --i) mutator.mutate(changed);
        try_file(gltf.folder.write("scene.gltf", changed.dump()), counts);
    });
    std::printf("values: %d loaded, %d rejected\n", counts.loaded, counts.rejected);
    EXPECT_GT(counts.loaded, 0);
    EXPECT_GT(counts.rejected, 0);
}

TEST(Mutation, OfBytes) {
    Gltf gltf;
    const std::string original = rich_document(gltf).dump();
    Mutator mutator(2);
    Counts counts;
    bounded_runs([&](int) {
        std::string changed = original;
        mutator.mutate(changed);
        try_file(gltf.folder.write("scene.gltf", changed), counts);
    });
    std::printf("bytes: %d loaded, %d rejected\n", counts.loaded, counts.rejected);
    EXPECT_GT(counts.loaded, 0);
    EXPECT_GT(counts.rejected, 0);
}

TEST(Mutation, OfBuffers) {
    Gltf gltf;
    rich_document(gltf);
    std::ifstream file(gltf.folder.path() / "data.bin", std::ios::binary);
    const std::string original((std::istreambuf_iterator<char>(file)), {});
    Mutator mutator(3);
    Counts counts;
    bounded_runs([&](int) {
        std::string changed = original;
        mutator.mutate(changed);
        changed.resize(original.size());
        gltf.folder.write("data.bin", changed);
        try_file(gltf.folder.path() / "scene.gltf", counts);
    });
    std::printf("buffers: %d loaded, %d rejected\n", counts.loaded, counts.rejected);
    EXPECT_GT(counts.loaded, 0);
    EXPECT_GT(counts.rejected, 0);
}

// A GLB of the same document: header and chunks are hit, too.
TEST(Mutation, OfGlb) {
    Gltf gltf;
    json document = rich_document(gltf);
    document["buffers"][0].erase("uri");
    std::ifstream file(gltf.folder.path() / "data.bin", std::ios::binary);
    std::string binary((std::istreambuf_iterator<char>(file)), {});
    binary.resize((binary.size() + 3) / 4 * 4);
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto u32 = [](size_t value) {
        std::string bytes(4, '\0');
        for (size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i) & 0xffu);
        return bytes;
    };
    const std::string original = "glTF" + u32(2) + u32(28 + text.size() + binary.size()) + u32(text.size()) + "JSON" + text +
                                 u32(binary.size()) + std::string("BIN\0", 4) + binary;
    Mutator mutator(4);
    Counts counts;
    try_file(gltf.folder.write("scene.glb", original), counts);
    ASSERT_EQ(counts.loaded, 1);
    bounded_runs([&](int run) {
        std::string changed = original;
        // Every other time only the first bytes, where the lengths are.
        std::string head = changed.substr(0, 28);
        mutator.mutate(run % 2 == 0 ? changed : head);
        if (run % 2 != 0) changed.replace(0, 28, head);
        try_file(gltf.folder.write("scene.glb", changed), counts);
    });
    std::printf("glb: %d loaded, %d rejected\n", counts.loaded, counts.rejected);
    EXPECT_GT(counts.rejected, 0);
}

}  // namespace
}  // namespace gnomon::test
