// SPDX-License-Identifier: Apache-2.0
// Models from the wild: all load, or fail for a stated reason, and move as far as others have measured.
#include <cmath>

#include "gltf_builder.hpp"
#include "support/assets.hpp"

namespace gnomon::test {
namespace {

// Models that gnomon cannot load, and what it must say.
const std::map<std::string, std::string> kUnsupported = {
    {"CesiumMan_Draco/CesiumMan.gltf", "KHR_draco_mesh_compression"},
    {"BoxMeshopt/BoxMeshopt.glb", "EXT_meshopt_compression"},
    {"ag_Compatibility_04/Compatibility_04.gltf", "needs glTF 2.1"},
};

TEST(Models, AllLoadWithTheirTriangles) {
    GN_SKIP_WITHOUT_ASSETS();
    const std::filesystem::path folder = assets_folder() / "models";
    const auto rows = read_table(folder / "MANIFEST.tsv");
    EXPECT_EQ(rows.size(), 85u);
    for (const auto& row : rows) {
        const std::string& file = row.at("file");
        SCOPED_TRACE(file);
        const auto unsupported = kUnsupported.find(file);
        try {
            const Scene scene = load_scene(folder / file);
            EXPECT_EQ(unsupported, kUnsupported.end());
            // The table counts all scenes of a file, gnomon shows one.
            const size_t expected = file == "MultipleScenes/MultipleScenes.gltf" ? 2 : std::stoul(row.at("inst_tri"));
            EXPECT_EQ(scene.triangles.size(), expected);
            EXPECT_EQ(std::to_string(scene.skin_count), row.at("skins"));
            for (size_t i = 0; i < std::max<size_t>(scene.animations.size(), 1); ++i) {
                const std::vector<Pose> poses =
                    pose_scene(scene, {AnimationChoice::Kind::one, static_cast<uint32_t>(i)}, 0, 0.1, 1);
                if (scene.triangles.empty()) continue;
                EXPECT_NO_THROW(bounds_of(scene, poses));
            }
        } catch (const Error& e) {
            ASSERT_NE(unsupported, kUnsupported.end()) << e.what();
            EXPECT_THAT(e.what(), testing::HasSubstr(unsupported->second));
        }
    }
}

// The largest displacement in a shutter, over the diagonal of the bounds at its start, as MOTION.tsv gives it. Its times have
// three decimals and the fastest motions are sensitive to them, and vertices without weights may follow other joints: hence the
// tolerance.
TEST(Models, MoveAsFarAsMeasured) {
    GN_SKIP_WITHOUT_ASSETS();
    const std::filesystem::path folder = assets_folder() / "models";
    std::string loaded;
    Scene scene;
    size_t checked = 0;
    for (const auto& row : read_table(folder / "MOTION.tsv")) {
        const std::string& file = row.at("file");
        const std::string& name = row.at("animation");
        SCOPED_TRACE(file + " " + name);
        if (file != loaded) scene = load_scene(folder / file);
        loaded = file;
        const AnimationChoice choice = choose_animation(scene, name[0] == '#' ? name.substr(1) : name);
        const double open = std::stod(row.at("at_t"));
        const double shutter = std::stod(row.at("shutter_s")) < 0.03 ? 1.0 / 48.0 : 1.0 / 24.0;
        const std::vector<Pose> poses = pose_scene(scene, choice, open, open + shutter, 1);
        const std::vector<glm::vec3> from = posed_positions(scene, poses[0]);
        const std::vector<glm::vec3> to = posed_positions(scene, poses[1]);
        float largest = 0.0f;
        for (size_t i = 0; i < from.size(); ++i) largest = std::max(largest, glm::length(to[i] - from[i]));
        const Bounds bounds = bounds_of(scene, {poses[0]});
        const double measured = std::stod(row.at("max_disp_over_bbox_diag"));
        EXPECT_NEAR(largest / glm::length(bounds.upper - bounds.lower), measured, 0.1 * measured + 1e-6);
        ++checked;
    }
    EXPECT_GT(checked, 300u);
}

}  // namespace
}  // namespace gnomon::test
