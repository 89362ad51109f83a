// SPDX-License-Identifier: Apache-2.0
// Scenes for whole frames: from the makers, from the assets, and how both programs render them.
#pragma once

#include <filesystem>
#include <functional>
#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "agreement.hpp"
#include "moving_triangles.hpp"
#include "reference.hpp"

namespace gnomon::test {

/// The file that `make` writes, as NAME.glb in the build tree; written once.
std::filesystem::path made_file(const std::string& name, const std::function<void(const std::filesystem::path&)>& make);

struct LoadOptions {
    std::string animation = "0";
    uint32_t segments = 1;
    bool ground = false;        ///< Six times as wide as the scene, below it.
    double aspect = 4.0 / 3.0;  ///< Of the default camera.
};

/// Loaded and posed over the default shutter, with a camera and a light where it has none.
PosedScene load_posed(const std::filesystem::path& path, const LoadOptions& options = {});

/// The device's renderer, one for all tests of a process.
Renderer& shared_renderer();

/// The reference's frame for these settings, samples kept.
Frame reference_frame(const PosedScene& posed, const RenderSettings& settings);

/// gnomon's frame with its samples.
Frame sampled_frame(const PosedScene& posed, RenderSettings settings);

/// Both, compared.
Agreement agreement_of(const PosedScene& posed, const RenderSettings& settings, const oracle::Rounding& rounding = {});

/// The values of a channel. A test fails where the frame has none of this name.
const std::vector<float>& channel(const Frame& frame, std::string_view name);

/// Of all bits of all channels.
uint64_t hash_of(const Frame& frame);

/// A rotation that takes -Z to `direction`, +Y up; any direction that is not vertical.
glm::dquat looking(const glm::dvec3& direction);

}  // namespace gnomon::test
