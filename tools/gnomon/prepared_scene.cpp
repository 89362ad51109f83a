// SPDX-License-Identifier: Apache-2.0
#include "prepared_scene.hpp"

#include <spdlog/spdlog.h>

#include "additions.hpp"

namespace gnomon::cli {

namespace {

void log_warnings(const std::vector<std::string>& warnings, size_t first) {
    for (size_t i = first; i < warnings.size(); ++i) spdlog::warn("{}", warnings[i]);
}

}  // namespace

PreparedScene prepare_scene(const RenderOptions& options, const std::vector<FrameJob>& frames) {
    PreparedScene prepared{load_scene(options.scene), {}, options.settings};
    Scene& scene = prepared.scene;
    log_warnings(scene.warnings, 0);
    const size_t warned = scene.warnings.size();
    prepared.animation = choose_animation(scene, options.animation);
    if (!options.camera.empty()) prepared.settings.camera = choose_camera(scene, options.camera);
    const Additions additions(scene, prepared.animation, options, frames);
    if (!additions.empty()) scene = additions.apply(std::move(scene));
    log_warnings(scene.warnings, warned);
    return prepared;
}

}  // namespace gnomon::cli
