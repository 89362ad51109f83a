// SPDX-License-Identifier: Apache-2.0
// Methods compared after the same seconds and at the same error, from several renders of each.
#pragma once

#include <string>
#include <vector>

namespace gnomon::cli {

struct CurveOptions {
    std::vector<std::string> renders;  ///< Documents "gnomon.render".
    std::string reference;
    std::string json;
    double exposure = 0.0;
    std::vector<std::string> channels;  ///< Empty: R, G, B and the visibilities.
    std::string metric;                 ///< "rmse", "relmse", "flip"
    std::vector<std::string> by;        ///< Settings; renders in which all are alike are of one method.
    std::vector<double> after;          ///< Seconds. Empty: those of the first method's renders.
    std::vector<double> to;             ///< Errors. Empty: those of the first method's renders.
};

/// Reads and compares the images, prints the tables or writes the JSON, and returns the exit code.
/// Errors: ErrorKind::usage where a metric has no standard error; input where a render or its image cannot be read, is not what
/// its JSON says, or has no error at all.
int compare_curves(const CurveOptions& options);

}  // namespace gnomon::cli
