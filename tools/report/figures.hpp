// SPDX-License-Identifier: Apache-2.0
// The figures of a report.
#pragma once

#include <string>
#include <vector>

#include "html/plot.hpp"
#include "report/settings.hpp"

namespace gnomon::report {

/// Floors further below the least than this are said and not drawn where scales are logarithmic: they would leave the others no
/// room.
constexpr double kFloorWithin = 4.0;

struct Figure {
    std::string name;  ///< Of its file, without .svg: letters, digits and hyphens.
    html::Plot plot;
    std::string caption;    ///< A sentence or two that say what is seen.
    bool is_first = false;  ///< Of its scene: it stands for the others.
};

/// What figures have in common: the files, and which colour a layout has.
class Sources {
public:
    explicit Sources(const std::vector<BenchFile>& files) : files_(files), layouts_(layouts_of(files)) {}

    const std::vector<BenchFile>& files() const { return files_; }
    size_t colour_of(const std::string& layout) const;

    /// With the file's label where there are several.
    std::string title(const BenchFile& file, const std::string& what) const;

    /// "stages-random-cubes-shadow-res-256", and the file's number where there are several.
    std::string name(const BenchFile& file, const std::string& kind, const std::string& what) const;

private:
    const std::vector<BenchFile>& files_;
    std::vector<std::string> layouts_;
};

/// The ratios to the baseline with their intervals, of a stage; one for each setting, as the following.
std::vector<Figure> ratio_figures(const Sources& sources, const std::string& stage);

/// Stacked stages by layout, with the null layout and the copy rate as floors.
std::vector<Figure> stage_figures(const Sources& sources);

/// Bytes against query time, with the Pareto front.
std::vector<Figure> front_figures(const Sources& sources);

/// Sectors, lines and bytes per query, where they were counted.
std::vector<Figure> count_figures(const Sources& sources);

/// How long lists are; one for each set of layouts that have the same.
std::vector<Figure> length_figures(const Sources& sources);

/// How many ranges each texel has, in the same way.
std::vector<Figure> texel_figures(const Sources& sources);

/// A stage's time along each axis of more than one value, a curve for each layout.
std::vector<Figure> sweep_figures(const Sources& sources, const std::string& stage);

}  // namespace gnomon::report
