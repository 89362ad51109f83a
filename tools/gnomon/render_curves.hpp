// SPDX-License-Identifier: Apache-2.0
// The errors of renders against their seconds, by channel and method.
#pragma once

#include <string>
#include <vector>

#include "compare.hpp"
#include "io/error_curve.hpp"

namespace gnomon::cli {

/// The renders of one method in one channel.
struct MethodCurve {
    struct Render {
        std::string json;
        std::string driver;  ///< Empty where the document names none.
        io::CurvePoint point;
    };
    std::string method;           ///< The values of the settings that tell methods apart.
    std::vector<Render> renders;  ///< As on the command line.

    io::ErrorCurve curve() const;
};

struct ChannelCurves {
    std::string name;  ///< "picture" for FLIP.
    std::vector<MethodCurve> methods;
};

/// Of the documents "gnomon.render" in options.files, whose images are read and compared with the reference. A render that
/// differs from an earlier one in the seed alone is no point of its own but tells the other's standard errors. A channel in
/// which a render has no error is left out with a warning. Warns where seeds or devices make the comparison unfair.
///
/// Errors: ErrorKind::usage where a metric has no standard error; input where a render or its image cannot be read, the image
/// is not what its document says, or nothing is left to compare.
std::vector<ChannelCurves> render_curves(const CompareOptions& options);

}  // namespace gnomon::cli
