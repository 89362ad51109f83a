// SPDX-License-Identifier: Apache-2.0
// The papers' figures as data: what is rendered, what is measured of it, and which sentences of the paper it bears on.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reproduce/metric.hpp"

namespace gnomon::reproduce {

/// A method as a figure uses it.
struct Run {
    std::string method;
    std::map<std::string, double> parameters = {};
    std::string label = method;  ///< Its name in the report, no other run's of the figure.
    double map_scale = 1.0;      ///< Of the sides of the setting's map.
    std::string curve = {};      ///< Runs of one name are one method at several costs: its error against its seconds.
    bool proposed = false;       ///< The paper's own method, or the same idea done differently: claims are checked for each.
};

/// One picture's worth of settings, at full size.
struct Setting {
    std::string scene;  ///< In the report. Settings of the same scene are one curve of a plot.
    std::function<void(const std::filesystem::path&)> make;
    uint32_t width = 1024;
    uint32_t height = 768;
    uint32_t shadow_res = 1024;
    uint32_t camera = 0;
    uint32_t spp = 8;
    uint32_t segments = 1;  ///< Linear pieces of motion.
    double x = 0.0;         ///< Place on the plots' axis, where there is one.
};

/// What is rendered. Several figures may show the same.
struct Experiment {
    std::vector<Setting> settings = {};
    std::vector<Run> runs = {};
    std::string axis = {};        ///< What `x` is; empty: settings are not a series.
    bool with_reference = false;  ///< Trace the reference: pictures, and errors against it.
    bool texel_ranges = false;    ///< Heat maps of ranges per texel.
    /// Maps have their full size at any scale of the pictures: what a coarse map does to shadows, and what it holds, are then
    /// those of full size. Else they are scaled too: the parts of a frame keep their shares of its time.
    bool full_maps = false;
};

/// As the name of a run in a claim: each proposed run in turn.
inline const std::string kProposed = "*";

/// What was measured of a run at a setting.
struct Term {
    Metric metric;
    std::string run = kProposed;
    double factor = 1.0;        ///< Times this.
    std::string over_run = {};  ///< Divided by the same metric of this run; empty: not.
    /// Not empty: `run` is a curve, taken where it has as many seconds as this run (io/error_curve.hpp).
    std::string at_time_of = {};
};

/// left > right, or left < right. The right side is a term or a number.
struct Comparison {
    enum class Sign { less, greater };
    /// Where: at each setting; or the left at the last setting of a scene and the right at the first.
    enum class Where { each, last_to_first };

    Term left;
    Sign sign = Sign::less;
    std::optional<Term> right = {};
    double number = 0.0;  ///< Without a right side; in the metric's own unit (shares of 1, seconds, bytes).
    Where where = Where::each;
    std::string scene = {};  ///< Only settings of this scene; empty: all.
};

/// What a paper says, and what would have to be measured for it to hold: all of the comparisons.
struct Claim {
    std::string quote;
    std::string source;  ///< Section or figure.
    std::vector<Comparison> comparisons;
};

struct Figure {
    std::string name;   ///< "2018-9"
    std::string title;  ///< A few words.
    std::string shows;  ///< What is to be seen, and where it differs from the paper's.
    std::shared_ptr<const Experiment> experiment;
    std::vector<Metric> plots = {};
    bool stage_plot = false;  ///< Seconds of each part of the frame as bars.
    std::vector<Claim> claims = {};
};

/// "Hong and Oh 2018, ..." of a figure's name.
std::string paper_of(const std::string& figure_name);

/// All, in the order of the papers.
const std::vector<Figure>& figures();

/// Errors: ErrorKind::usage, naming those that exist.
const Figure& find_figure(const std::string& name);

/// Of one paper each.
std::vector<Figure> figures_2015();
std::vector<Figure> figures_2017();
std::vector<Figure> figures_2018();

}  // namespace gnomon::reproduce
