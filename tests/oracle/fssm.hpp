// SPDX-License-Identifier: Apache-2.0
// A tile of a filtered stochastic shadow map in double, from the paper's text: Andersson et al. 2015, sections 4 and 5.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace gnomon::oracle {

/// A sample of the light's view. Places are texels; motion is texels and metres per shutter.
struct MapSample {
    glm::dvec2 place{0.0};
    double t = 0.0;
    double depth = 0.0;
    glm::dvec3 motion{0.0};
    bool hit = true;  ///< Else there is nothing as far as the light sees.
};

struct FssmSettings {
    int tile = 8, window = 16, grid = 16, layers = 4;
    bool widen = true, tent = true;
};

/// What is looked up: a way in the light's view, and the hit's depth at its time.
struct FssmReceiver {
    glm::dvec2 begin{0.0}, end{0.0};
    double t_begin = 0.0, t_end = 0.0;
    double depth = 0.0;
    double t = 0.0;
};

struct FssmLayer {
    double near = 0.0, far = 0.0;  ///< Its nearest and farthest sample at t = 1/2.
    glm::dvec3 motion{0.0};
    std::vector<glm::dvec4> tuples;  ///< Eq. 7, rows of the grid.
};

class FssmTile {
public:
    /// samples: those in the window around the tile whose centre is `centre`.
    FssmTile(const std::vector<MapSample>& samples, const glm::dvec2& centre, const FssmSettings& settings);

    const std::vector<FssmLayer>& layers() const { return layers_; }

    /// Eq. 6 with t = 1/2, from the grid's corner.
    glm::dvec2 on_grid(const FssmLayer& layer, const glm::dvec2& place, double t) const;

    /// The share of light that reaches the receiver, without bias.
    double visibility(const FssmReceiver& receiver) const;

private:
    void find_layers(const std::vector<MapSample>& samples);
    void fill(FssmLayer& layer, const std::vector<MapSample>& samples) const;
    glm::dvec4 filtered(const FssmLayer& layer, glm::dvec2 p, int texels_wide) const;
    glm::dvec4 footprint(const FssmLayer& layer, const FssmReceiver& receiver, int texels_wide) const;

    glm::dvec2 centre_;
    FssmSettings settings_;
    std::vector<FssmLayer> layers_;
};

/// Of a set of intervals (ascending numbers): the intervals with which the second, third, ... of at most `most` layers begin.
std::vector<int> layer_starts(const std::vector<int>& occupied, int most);

/// Eq. 8 to 10 for one layer.
double visibility_through(const glm::dvec4& tuple, double depth);

}  // namespace gnomon::oracle
