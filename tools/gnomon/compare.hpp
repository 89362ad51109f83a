// SPDX-License-Identifier: Apache-2.0
// The two things that `gnomon compare` does.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

struct CompareOptions {
    std::vector<std::string> files;     ///< The reference is the last.
    std::vector<std::string> channels;  ///< Empty: all of two images; of renders R, G, B and the visibilities.
    std::string metric = "rmse";        ///< Of two images what the threshold is for, of renders the error.
    double exposure = 0.0;
    std::string json;
    bool hash = false;

    // Of two images.
    std::string again;  ///< The first, rendered with another seed: tells its noise.
    std::optional<double> threshold;
    std::string diff;
    std::string diff_png;
    std::string flip_png;

    // Of renders.
    std::vector<std::string> by = {"method"};  ///< Settings: renders in which all are alike are of one method.
    std::vector<double> after;                 ///< Seconds. Empty: those of the first method's renders.
    std::vector<double> to;                    ///< Errors. Empty: those of the first method's renders.
};

/// An image against its reference: the errors of each channel and, where there is a picture, FLIP and SSIM. Prints the table or
/// writes the JSON, writes the images that are asked for, and returns the exit code: kOverThreshold over the threshold.
/// Errors: those of image_errors.hpp; ErrorKind::input where FLIP or SSIM is asked for and there is no picture.
int compare_images(const CompareOptions& options);

/// Renders against their reference: what each method's error is after the same seconds, and its seconds to the same error.
/// Prints the tables or writes the JSON, and returns the exit code. Errors: those of render_curves.hpp.
int compare_curves(const CompareOptions& options);

/// Prints a hash of the bits of each image, a line for each, or writes the JSON, and returns the exit code: kOverThreshold
/// where not all are the same. Errors: those of image_errors.hpp.
int compare_hashes(const CompareOptions& options);

}  // namespace gnomon::cli
