// SPDX-License-Identifier: Apache-2.0
// A scene whose picture is known in closed form, and how far a frame of it is off.
#pragma once

#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <string>
#include <vector>

namespace gnomon::cli {

/// A rectangle flies over a ground that stands still, under a slanting sun; the camera looks straight down and sees all of the
/// ground, the rectangle, and its shadow beside it.
struct KnownPicture {
    KnownPicture();

    Scene scene;
    std::vector<Pose> poses;  ///< One segment.
    RenderSettings settings;  ///< 48 x 48 pixels, 64 samples each.
};

/// The mean of a channel over some pixels that is furthest from what is right.
struct WorstMean {
    std::string channel;                                ///< With "* A" where a mean over hits was weighted by their share.
    uint32_t left = 0, top = 0, right = 0, bottom = 0;  ///< Pixels, the last two excluded.
    double value = 0.0;
    double expected = 0.0;
    double standard_errors = 0.0;  ///< How far it is off; infinite where nothing is random and it is off by more than rounding.
};

/// Compare the means of each channel over the frame and over each square of 8 x 8 pixels with those that follow from the areas
/// that rectangle and shadow sweep. The standard errors are those of independent samples, which is more than those of
/// stratified ones.
WorstMean worst_mean(const Frame& frame);

}  // namespace gnomon::cli
