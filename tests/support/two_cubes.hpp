// SPDX-License-Identifier: Apache-2.0
// Fixture: small frames of the shipped scene two-cubes, on a device with validation.
#pragma once

#include <gtest/gtest.h>

#include <gnomon/render.hpp>

#include "support/paths.hpp"
#include "support/shared_devices.hpp"

namespace gnomon::test {

/// Base: the fixture's own base. Camera and light are added where the scene has none.
template <class Base = testing::Test>
class TwoCubes : public Base {
protected:
    TwoCubes(uint32_t width, uint32_t height, uint32_t spp)
        : scene(load_scene(std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "scenes" / "two-cubes.gltf")) {
        poses = pose_scene(scene, {AnimationChoice::Kind::all, 0}, 0.0, 0.5, 2);
        if (scene.cameras.empty())
            add_default_camera(scene, poses, bounds_of(scene, poses), static_cast<double>(width) / height);
        if (scene.lights.empty()) add_default_light(scene, poses);
        settings.width = width;
        settings.height = height;
        settings.spp = spp;
    }

    Frame render(const std::string& method) {
        settings.method = method;
        return validated_renderer().render(scene, poses, settings);
    }

    /// Of the samples that hit, the share whose light differs.
    static double differing(const Frame& a, const Frame& b) {
        double hits = 0.0, differ = 0.0;
        for (size_t i = 0; i < a.samples.size(); ++i) {
            EXPECT_EQ(a.samples[i].triangle, b.samples[i].triangle);
            if (a.samples[i].triangle == SampleRecord::kMiss) continue;
            hits += 1.0;
            differ += a.samples[i].lit != b.samples[i].lit ? 1.0 : 0.0;
        }
        return differ / hits;
    }

    static void expect_same_bits(const Frame& frame, const Frame& expected) {
        ASSERT_EQ(frame.channels.size(), expected.channels.size());
        for (size_t i = 0; i < frame.channels.size(); ++i)
            EXPECT_TRUE(frame.channels[i].values == expected.channels[i].values) << frame.channels[i].name;
    }

    Scene scene;
    std::vector<Pose> poses;
    RenderSettings settings;
};

}  // namespace gnomon::test
