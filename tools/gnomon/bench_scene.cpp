// SPDX-License-Identifier: Apache-2.0
#include "bench_scene.hpp"

#include <algorithm>
#include <filesystem>

#include "prepared_scene.hpp"

namespace gnomon::cli {

namespace {

Shutter open_for(const Shutter& shutter, double speed) {
    return {shutter.open, shutter.open + speed * (shutter.close - shutter.open)};
}

}  // namespace

BenchScene scene_of_file(const std::string& path, const RenderOptions& options, const std::vector<double>& speeds) {
    RenderOptions of_file = options;
    of_file.scene = path;
    // The default camera frames all that moves from the first to the last of these.
    std::vector<FrameJob> frames;
    for (const double speed : speeds) frames.push_back({{}, open_for(options.shutter, speed), {}, {}, {}});
    std::sort(frames.begin(), frames.end(),
              [](const FrameJob& a, const FrameJob& b) { return a.shutter.close < b.shutter.close; });
    PreparedScene prepared = prepare_scene(of_file, frames);
    const auto poses = [animation = prepared.animation, shutter = options.shutter](const Scene& scene, double speed,
                                                                                   uint32_t segments) {
        const Shutter open = open_for(shutter, speed);
        return pose_scene(scene, animation, open.open, open.close, segments);
    };
    return {std::filesystem::path(path).stem().string(), std::move(prepared.scene), prepared.settings.camera, poses};
}

BenchScene scene_of(const Synthetic& synthetic, uint32_t seed) {
    return {synthetic.name(), synthetic_scene(synthetic, seed), 0,
            [](const Scene&, double speed, uint32_t segments) { return synthetic_poses(speed, segments); }};
}

}  // namespace gnomon::cli
