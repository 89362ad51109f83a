// SPDX-License-Identifier: Apache-2.0
// The options of `gnomon bench`.
#pragma once

#include <CLI/CLI.hpp>

#include "bench_case.hpp"
#include "bench_measure.hpp"
#include "render_options.hpp"
#include "synthetic_scene.hpp"

namespace gnomon::cli {

struct BenchOptions {
    std::vector<std::string> scenes;
    std::vector<std::string> layouts;  ///< Empty: all that are built in.
    std::string baseline;              ///< Empty: the first.
    std::vector<Axis> axes;
    std::vector<Synthetic> synthetic;
    BenchLimits limits;
    bool null = true;  ///< Measure the layout null too.
    std::string csv;
    std::string artifact;  ///< Empty: none. A folder to be made.
    RenderOptions render;  ///< Also "json".
};

/// Declare them; `options` must live until the command line is parsed.
void bind_bench_options(CLI::App& command, BenchOptions& options);

/// The layouts to measure: the baseline first, then the others as they come, the baseline again, and null where nobody named
/// it. Errors: as of find_layout; ErrorKind::usage for a layout or a name twice, and for a baseline that is not among them.
std::vector<BenchLayout> bench_layouts(const BenchOptions& options);

/// Without cases.
std::vector<BenchGroup> bench_points(const BenchOptions& options);

}  // namespace gnomon::cli
