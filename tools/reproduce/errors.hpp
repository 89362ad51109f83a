// SPDX-License-Identifier: Apache-2.0
// How far a run's shadows are from the reference's.
#pragma once

#include <gnomon/render.hpp>
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

/// A square of each pixel, by several seeds; NaN where one of them has no hit.
struct PixelSquares {
    std::vector<double> all;
    std::vector<std::vector<double>> without;  ///< Each of the seeds.
};

/// a - factor * b; both of the same seeds.
PixelSquares difference(const PixelSquares& a, double factor, const PixelSquares& b);

/// The mean over pixels, rows of `width`. Its standard error is what other seeds would change, by the jackknife over seeds (too
/// large, up to twice, where noise is all there is); squares of 16 x 16 pixels are taken for independent.
Estimate over_seeds(const PixelSquares& squares, uint32_t width);

/// The root of a mean square, 0 of one below 0.
Estimate root_of(const Estimate& square);

/// Mean over lights of frame - reference, per pixel; 0 where one of them has no hit.
std::vector<double> visibility_difference(const Frame& frame, const Frame& reference);

/// FLIP of the pictures, per pixel.
std::vector<double> flip_of(const Frame& frame, const Frame& reference);

/// Visibility in frames of different seeds, at least 3; squares are means over the lights.
class VisibilityStatistics {
public:
    void add(const Frame& frame);

    /// The variance of a frame's pixel.
    PixelSquares noise() const;

    /// A frame's error against the reference.
    PixelSquares error(const Frame& reference) const;

    /// Of what more frames would not cure: estimates without bias of the square of the difference of the expected visibility
    /// and the reference's.
    PixelSquares systematic(const Frame& reference) const;

private:
    template <typename F>
    PixelSquares each(const F& square) const;
    template <typename F>
    PixelSquares against(const Frame& reference, const F& square) const;

    uint32_t lights_ = 0;
    std::vector<std::vector<float>> frames_;  // Of pixels, light after light.
    std::vector<uint32_t> hits_;              // Frames in which the pixel has hits.
};

}  // namespace gnomon::reproduce
