// SPDX-License-Identifier: Apache-2.0
// Malformed files from other projects' test suites, each loaded in a process of its own with bounded memory and time.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <cstdio>
#include <gnomon/error.hpp>
#include <gnomon/scene.hpp>

#include "support/assets.hpp"

namespace gnomon::test {
namespace {

// Rejected although the validator finds no error.
const std::map<std::string, std::string> kRejected = {
    {"base__data__asset__min_version_valid", "needs glTF 2.1"},
    {"base__data__root__named_objects", "its animation reads a buffer without data"},
    {"base__data__root__unused_objects", "its animation reads a buffer without data"},
};

// Loaded although the validator finds an error that naive use would stumble over.
const std::map<std::string, std::string> kTolerated = {
    {"base__data__animation_data__invalid_input_values", "equal and negative times of key frames are well defined"},
    {"base__data__skin_data__invalid_ibm", "only the last row of matrices is wrong, which is ignored with a warning"},
    {"base__data__mesh_data__joints_weights_complex", "the primitive is of points, which are ignored"},
    {"ext__KHR_texture_transform__data__textureInfo__uv_sets", "missing texture coordinates are (0, 0), with a warning"},
    {"assimp__issue_3269__texcoord_crash", "missing texture coordinates are (0, 0), with a warning"},
    {"base__data__skin__no_joints_in_scene", "joints outside the scene have matrices, too"},
    {"base__data__node__rotation_non_unit", "rotations are normalized, with a warning"},
};

enum Outcome { kLoaded = 0, kError = 10, kOtherException = 11 };

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;  // Its shadow memory needs more address space than any limit.
#else
constexpr bool kSanitized = false;
#endif

void limit(int resource, rlim_t most) {
    const rlimit bounds{most, most};
    setrlimit(static_cast<__rlimit_resource>(resource), &bounds);
}

int load_and_pose(const std::filesystem::path& path) {
    try {
        const Scene scene = load_scene(path);
        const std::vector<Pose> poses = pose_scene(scene, {AnimationChoice::Kind::all, 0}, 0.0, 1.0, 2);
        if (!scene.triangles.empty()) bounds_of(scene, poses);
        return kLoaded;
    } catch (const Error& e) {
        return e.kind() == ErrorKind::input ? kError : kOtherException;
    } catch (...) {
        return kOtherException;
    }
}

// What became of the file, in a child: an outcome, or 1000 + the signal that ended it.
int outcome_of(const std::filesystem::path& path) {
    const pid_t child = fork();
    if (child == 0) {
        if (!kSanitized) limit(RLIMIT_AS, rlim_t{2} << 30);
        limit(RLIMIT_CPU, 20);
        _exit(load_and_pose(path));
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

TEST(Malformed, LoadOrEndInAnError) {
    GN_SKIP_WITHOUT_ASSETS();
    const std::filesystem::path folder = assets_folder() / "malformed";
    const auto rows = read_table(folder / "MANIFEST.tsv");
    EXPECT_EQ(rows.size(), 224u);
    std::map<std::string, std::map<std::string, int>> summary;
    for (const auto& row : rows) {
        const std::string& file = row.at("file");
        const std::string name = file.substr(0, file.find('/'));
        const std::string hint = row.at("hint").substr(0, row.at("hint").find('('));
        const int outcome = outcome_of(folder / file);
        ++summary[hint][outcome == kLoaded ? "loaded" : outcome == kError ? "rejected" : "crashed"];
        ASSERT_TRUE(outcome == kLoaded || outcome == kError) << file << " ended with " << outcome;
        if (hint == "no-error") {
            EXPECT_EQ(outcome == kLoaded, !kRejected.contains(name)) << file << " must load";
        }
        if (hint == "structural") {
            EXPECT_EQ(outcome == kError, !kTolerated.contains(name))
                << file << " must be rejected: " << row.at("expected_error_codes");
        }
    }
    std::printf("%-18s %8s %8s %8s\n", "hint", "loaded", "rejected", "crashed");
    for (auto& [hint, counts] : summary) {
        std::printf("%-18s %8d %8d %8d\n", hint.c_str(), counts["loaded"], counts["rejected"], counts["crashed"]);
    }
}

}  // namespace
}  // namespace gnomon::test
