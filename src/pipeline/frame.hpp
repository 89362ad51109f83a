// SPDX-License-Identifier: Apache-2.0
// One frame.
#pragma once

#include <gnomon/render.hpp>
#include <memory>

#include "stages/pose.hpp"

namespace gnomon {

/// Renderer::render, of arguments that were checked. loaded: what is on the device of the scene; none: nothing yet. frame: its
/// memory is used again.
void render_frame(gpu::Device& device, Programs& programs, const Scene& scene, std::shared_ptr<const SceneData> loaded,
                  const std::vector<Pose>& poses, const RenderSettings& settings, const Progress& progress, Frame& frame);

}  // namespace gnomon
