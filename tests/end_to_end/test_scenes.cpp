// SPDX-License-Identifier: Apache-2.0
// Scenes for whole frames: from the makers, from the assets, and how both programs render them.
#include "test_scenes.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "io/image_hash.hpp"
#include "scenes/scene_makers.hpp"
#include "support/paths.hpp"
#include "support/shared_devices.hpp"

namespace gnomon::test {

namespace fs = std::filesystem;

fs::path made_file(const std::string& name, const std::function<void(const fs::path&)>& make) {
    const fs::path folder = GN_PATH(GNOMON_SCENE_FOLDER);
    fs::path path = folder / (name + ".glb");
    if (fs::exists(path)) return path;
    fs::create_directories(folder);
    // Tests run side by side: whoever is first wins, and no one reads half a file.
    const fs::path own = folder / (name + "." + std::to_string(getpid()) + ".glb");
    make(own);
    fs::rename(own, path);
    return path;
}

PosedScene load_posed(const fs::path& path, const LoadOptions& options) {
    PosedScene posed{load_scene(path), {}};
    posed.poses = pose_scene(posed.scene, choose_animation(posed.scene, options.animation), 0.0, makers::kShutterSeconds,
                             options.segments);
    const Bounds bounds = bounds_of(posed.scene, posed.poses);
    if (options.ground) {
        const glm::vec3 centre = 0.5f * (bounds.lower + bounds.upper);
        const float radius = 0.5f * glm::length(glm::vec2(bounds.upper.x - bounds.lower.x, bounds.upper.z - bounds.lower.z));
        add_ground(posed.scene, posed.poses, {centre.x, centre.z}, bounds.lower.y, 6.0f * radius);
    }
    if (posed.scene.cameras.empty()) add_default_camera(posed.scene, posed.poses, bounds, options.aspect);
    if (posed.scene.lights.empty()) add_default_light(posed.scene, posed.poses);
    return posed;
}

Renderer& shared_renderer() {
    static std::unique_ptr<Renderer> renderer;
    return make_once(renderer);
}

Frame reference_frame(const PosedScene& posed, const RenderSettings& settings) {
    ReferenceSettings reference;
    reference.width = settings.width;
    reference.height = settings.height;
    reference.spp = settings.spp;
    reference.seed = settings.seed;
    reference.camera = settings.camera;
    reference.keep_samples = true;
    return trace_reference(posed.scene, posed.poses, reference);
}

Frame sampled_frame(const PosedScene& posed, RenderSettings settings) {
    settings.keep_samples = true;
    return shared_renderer().render(posed.scene, posed.poses, settings);
}

Agreement agreement_of(const PosedScene& posed, const RenderSettings& settings, const oracle::Rounding& rounding) {
    const oracle::SampleJudge judge(posed.scene, posed.poses, settings.camera, settings.width, settings.height, rounding);
    return compare_samples(sampled_frame(posed, settings), reference_frame(posed, settings), settings.spp, settings.seed,
                           judge);
}

const std::vector<float>& channel(const Frame& frame, std::string_view name) {
    for (const Channel& c : frame.channels) {
        if (c.name == name) return c.values;
    }
    ADD_FAILURE() << "the frame has no channel " << name;
    static const std::vector<float> none;
    return none;
}

uint64_t hash_of(const Frame& frame) { return io::image_hash(frame.width, frame.height, frame.channels); }

glm::dquat looking(const glm::dvec3& direction) {
    return glm::quatLookAt(glm::normalize(direction), glm::dvec3(0.0, 1.0, 0.0));
}

}  // namespace gnomon::test
