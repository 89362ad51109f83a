// SPDX-License-Identifier: Apache-2.0
// How far a run's shadows are from the reference's.
#pragma once

#include <gnomon/render.hpp>
#include <optional>
#include <vector>

#include "reproduce/metric.hpp"

namespace gnomon::reproduce {

double mean(const std::vector<double>& values);

/// Of all shadow tests, those that are wrong; of shares of light, by how much.
struct FalseShare {
    double shadow = 0.0;  ///< Darker than the reference.
    double light = 0.0;   ///< Brighter.
};

/// Both frames hold the samples of the same settings; samples that hit different triangles are left out.
FalseShare false_share(const Frame& frame, const Frame& reference);

/// RMSE of the visibility of all lights, over the pixels where both frames have hits.
double visibility_error(const Frame& frame, const Frame& reference);

/// sqrt(error^2 - noise^2), 0 where noise is all there is.
Estimate without_noise(const Estimate& error, const Estimate& noise);

/// Mean over lights of frame - reference, per pixel; 0 where one of them has no hit.
std::vector<double> visibility_difference(const Frame& frame, const Frame& reference);

/// FLIP of the pictures, per pixel.
std::vector<double> flip_of(const Frame& frame, const Frame& reference);

/// How visibility varies between frames of different seeds.
class VisibilityVariance {
public:
    void add(const Frame& frame);

    /// Root of the mean variance, over pixels that have hits in all frames and all lights. Its standard error takes pixels for
    /// independent. Nothing of fewer than two frames.
    std::optional<Estimate> noise() const;

private:
    uint32_t frames_ = 0;
    std::vector<double> sums_, squares_;  // Of pixels, light after light.
    std::vector<uint32_t> hits_;          // Frames in which the pixel has hits.
};

}  // namespace gnomon::reproduce
