// SPDX-License-Identifier: Apache-2.0
// The errors of one EXR image against another.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/exr.hpp"
#include "io/image_compare.hpp"
#include "io/pixel_mean.hpp"

namespace gnomon::cli {

using Attributes = std::map<std::string, std::string>;

struct NamedImage {
    std::string path;
    io::ExrImage image;
};

/// Two images of one size, b being the reference.
struct ImagePair {
    const NamedImage& a;
    const NamedImage& b;

    std::string paths() const { return a.path + " and " + b.path; }
};

NamedImage read_image(const std::string& path);

/// Errors: ErrorKind::input where the images differ in size.
void check_same_size(const ImagePair& pair);

/// The channels to compare: those asked for, else those that both images have, with a warning for each other one.
/// Errors: ErrorKind::input where there are none, or one that was asked for is missing.
std::vector<std::string> common_channels(const ImagePair& pair, const std::vector<std::string>& asked);

/// The seed with which the headers of two images say that they were rendered: their noise is partly the same.
std::optional<std::string> common_seed(const Attributes& a, const Attributes& b);

/// The driver, with its version, that an image's header names; empty where it names none.
std::string driver_of(const Attributes& attributes);

/// A setting in which the headers of two images differ, other than the seed.
std::optional<std::string> setting_that_differs(const Attributes& a, const Attributes& b);

/// Of these channels, which both have. Warns of values that are not finite.
///
/// What noise has in an error is known in every channel where there is a second render of a that differs from it in the seed;
/// that of b is left out. Else it is known in visibility.<i> where both images have visibility_var.<i>, several samples per
/// pixel, and no seed in common: the variance of as many independent samples, which is more than that of stratified ones.
std::vector<io::ChannelError> channel_errors(const ImagePair& pair, const std::vector<std::string>& names,
                                             const NamedImage* again = nullptr);

/// Errors: ErrorKind::input where the second render has the same seed, other settings than the seed differ, or it lacks one of
/// the channels.
void check_again(const NamedImage& image, const NamedImage& again, const std::vector<std::string>& names);

/// What the pictures look like.
struct PerceivedError {
    std::vector<double> flip;  ///< Per pixel.
    io::PixelMean flip_mean;
    double flip_max = 0.0;
    double ssim = 0.0;
    uint64_t not_finite = 0;  ///< Values of either picture that are NaN or infinite.
};

/// Nothing where an image lacks R, G or B. The second render of a is for the standard error.
std::optional<PerceivedError> perceived_error(const ImagePair& pair, double exposure, const NamedImage* again = nullptr);

}  // namespace gnomon::cli
