// SPDX-License-Identifier: Apache-2.0
// The public Renderer: a device and its programs, scenes that stay there, settings that are checked.
#include <gnomon/error.hpp>
#include <gnomon/render.hpp>
#include <limits>

#include "pipeline/closed.hpp"
#include "pipeline/frame.hpp"
#include "pipeline/memory_plan.hpp"
#include "shared/light.h"

namespace gnomon {

struct LoadedScene::Impl {
    const Scene& scene;
    std::shared_ptr<const SceneData> data;
    const gpu::Device* device = nullptr;  ///< It is on.
};

uint64_t FrameStats::lost_ranges() const {
    uint64_t lost = 0;
    for (const auto& [name, count] : counts) lost += name.starts_with("lost.") ? count : 0;
    return lost;
}

const Scene& LoadedScene::scene() const { return impl_->scene; }

struct Renderer::Impl {
    Impl(const std::string& choice, bool validate) : device(choice, validate), programs(device) {}

    gpu::Device device;
    Programs programs;
};

namespace {

void check_range(const char* option, uint64_t value, uint64_t low, uint64_t high) {
    if (value >= low && value <= high) return;
    throw Error(ErrorKind::usage, std::string(option) + " is " + std::to_string(value), "settings",
                "use " + std::to_string(low) + " to " + std::to_string(high));
}

void check(const Scene& scene, const std::vector<Pose>& poses, const RenderSettings& settings) {
    check_range("width", settings.width, 1, 16384);
    check_range("height", settings.height, 1, 16384);
    check_range("spp", settings.spp, 1, 65536);
    check_range("shadow resolution", settings.shadow_res, 1, 16384);
    if (settings.pages != "auto" && settings.pages != "asked" && settings.pages != "all")
        throw Error(ErrorKind::usage, "no pages '" + settings.pages + "'", "settings", "use auto, asked or all");
    check_range("number of poses", poses.size(), 2, kMostSegments + 1);
    if (scene.triangles.empty())
        throw Error(ErrorKind::input, "the scene has no triangles", scene.path.string(), "add a mesh with triangles");
    if (settings.camera >= scene.cameras.size()) {
        throw Error(ErrorKind::usage, "there is no camera " + std::to_string(settings.camera), scene.path.string(),
                    "the scene has " + std::to_string(scene.cameras.size()));
    }
    if (scene.lights.size() > shared::kMostLights) {
        throw Error(ErrorKind::input, std::to_string(scene.lights.size()) + " lights", scene.path.string(),
                    "use at most " + std::to_string(shared::kMostLights));
    }
}

}  // namespace

Renderer::Renderer(const std::string& device, bool validate) : impl_(std::make_unique<Impl>(device, validate)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const DeviceDescription& Renderer::device() const { return impl_->device.description(); }

Frame Renderer::render(const Scene& scene, const std::vector<Pose>& poses, const RenderSettings& settings,
                       const Progress& progress) {
    Frame frame;
    check(scene, poses, settings);
    check_turns(scene);
    render_frame(impl_->device, impl_->programs, scene, nullptr, poses, settings, progress, frame);
    return frame;
}

Frame Renderer::render(const LoadedScene& scene, const std::vector<Pose>& poses, const RenderSettings& settings,
                       const Progress& progress) {
    Frame frame;
    render(scene, poses, settings, frame, progress);
    return frame;
}

void Renderer::render(const LoadedScene& scene, const std::vector<Pose>& poses, const RenderSettings& settings, Frame& frame,
                      const Progress& progress) {
    if (scene.impl_ == nullptr || scene.impl_->device != &impl_->device)
        throw Error(ErrorKind::usage, "the scene was not loaded by this renderer", "scene", "load it with Renderer::load");
    check(scene.scene(), poses, settings);
    render_frame(impl_->device, impl_->programs, scene.scene(), scene.impl_->data, poses, settings, progress, frame);
}

LoadedScene Renderer::load(const Scene& scene) {
    check_turns(scene);
    check_scene(impl_->device, scene, 2, std::numeric_limits<uint64_t>::max());  // The budget is a frame's.
    impl_->device.set_budget(0);
    LoadedScene loaded;
    loaded.impl_ = std::make_shared<LoadedScene::Impl>(
        LoadedScene::Impl{scene, std::make_shared<SceneData>(upload_scene(impl_->device, scene)), &impl_->device});
    return loaded;
}

}  // namespace gnomon
