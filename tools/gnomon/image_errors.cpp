// SPDX-License-Identifier: Apache-2.0
#include "image_errors.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <gnomon/error.hpp>

#include "io/perceived_error.hpp"

namespace gnomon::cli {

namespace {

using io::ExrImage;

const std::string kSeed = "gnomon:seed";

std::string names_of(const ExrImage& image) {
    std::vector<std::string> names;
    for (const Channel& channel : image.channels) names.push_back(channel.name);
    return names.empty() ? "no channels" : fmt::format("{}", fmt::join(names, ", "));
}

/// The standard errors of a channel's pixels, or null where they are not known: one sample does not tell.
const Channel* standard_errors_of(const ExrImage& image, const std::string& name) {
    const std::string prefix = "visibility.";
    const auto spp = image.attributes.find("gnomon:spp");
    const bool has_one_sample = spp != image.attributes.end() && spp->second == "1";
    if (!name.starts_with(prefix) || has_one_sample) return nullptr;
    return image.find("visibility_var." + name.substr(prefix.size()));
}

/// Of the difference of two images, from the standard errors that they come with. Empty where those are not known.
std::vector<double> variances_of_samples(const ImagePair& pair, const std::string& name) {
    const Channel* a = standard_errors_of(pair.a.image, name);
    const Channel* b = standard_errors_of(pair.b.image, name);
    if (a == nullptr || b == nullptr || common_seed(pair.a.image.attributes, pair.b.image.attributes)) return {};
    std::vector<double> variances;
    for (size_t i = 0; i < a->values.size(); ++i) {
        const double error_a = a->values[i], error_b = b->values[i];
        variances.push_back(error_a * error_a + error_b * error_b);
    }
    return variances;
}

std::optional<io::ShownPicture> shown_picture(const ExrImage& image, double exposure) {
    return io::shown_picture(image.channels, image.width, image.height, exposure);
}

}  // namespace

NamedImage read_image(const std::string& path) { return {path, io::read_exr(path)}; }

void check_same_size(const ImagePair& pair) {
    const ExrImage &a = pair.a.image, &b = pair.b.image;
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorKind::input,
                    fmt::format("the images differ in size: {}x{} and {}x{}", a.width, a.height, b.width, b.height),
                    pair.paths(), "compare images of one size");
}

std::vector<std::string> common_channels(const ImagePair& pair, const std::vector<std::string>& asked) {
    const ExrImage &a = pair.a.image, &b = pair.b.image;
    std::vector<std::string> names;
    for (const std::string& name : asked) {
        for (const NamedImage* named : {&pair.a, &pair.b})
            if (named->image.find(name) == nullptr)
                throw Error(ErrorKind::input, "there is no channel " + name, named->path, "it has " + names_of(named->image));
        names.push_back(name);
    }
    if (!names.empty()) return names;
    for (const Channel& channel : a.channels) {
        if (b.find(channel.name) != nullptr) {
            names.push_back(channel.name);
        } else {
            spdlog::warn("channel {} is not compared: {} has none", channel.name, pair.b.path);
        }
    }
    for (const Channel& channel : b.channels)
        if (a.find(channel.name) == nullptr) spdlog::warn("channel {} is not compared: {} has none", channel.name, pair.a.path);
    if (names.empty())
        throw Error(ErrorKind::input, fmt::format("the images have no channel in common: {} and {}", names_of(a), names_of(b)),
                    pair.paths(), "compare images with the same channels");
    return names;
}

std::optional<std::string> common_seed(const Attributes& a, const Attributes& b) {
    const auto in_a = a.find(kSeed), in_b = b.find(kSeed);
    return in_a != a.end() && in_b != b.end() && in_a->second == in_b->second ? std::optional(in_a->second) : std::nullopt;
}

std::string driver_of(const Attributes& attributes) {
    const auto found = attributes.find("gnomon:driver");
    return found == attributes.end() ? "" : found->second;
}

std::optional<std::string> setting_that_differs(const Attributes& a, const Attributes& b) {
    Attributes all = a;
    all.insert(b.begin(), b.end());
    for (const auto& [name, value] : all) {
        const auto in_a = a.find(name), in_b = b.find(name);
        if (name != kSeed && (in_a == a.end() || in_b == b.end() || in_a->second != in_b->second)) return name;
    }
    return std::nullopt;
}

std::vector<io::ChannelError> channel_errors(const ImagePair& pair, const std::vector<std::string>& names,
                                             const NamedImage* again) {
    const ExrImage &a = pair.a.image, &b = pair.b.image;
    std::vector<io::ChannelError> errors;
    for (const std::string& name : names) {
        std::vector<double> variances;
        io::PixelNoise noise;
        if (again != nullptr) {
            noise.again = again->image.find(name)->values;
        } else {
            variances = variances_of_samples(pair, name);
            noise.variances = variances;
        }
        errors.push_back(io::compare_channel(name, a.find(name)->values, b.find(name)->values, a.width, noise));
        if (errors.back().not_finite > 0)
            spdlog::warn("channel {} has {} values that are not finite; the errors leave them out", name,
                         errors.back().not_finite);
    }
    return errors;
}

void check_again(const NamedImage& image, const NamedImage& again, const std::vector<std::string>& names) {
    const ImagePair pair{image, again};
    check_same_size(pair);
    common_channels(pair, names);
    if (const auto seed = common_seed(pair.a.image.attributes, pair.b.image.attributes))
        throw Error(ErrorKind::input, "both renders have seed " + *seed, pair.paths(), "render one with another --seed");
    if (const auto name = setting_that_differs(image.image.attributes, again.image.attributes))
        throw Error(ErrorKind::input, "the renders differ in more than the seed: in " + *name, pair.paths(),
                    "give renders with the same settings");
}

std::optional<PerceivedError> perceived_error(const ImagePair& pair, double exposure, const NamedImage* again) {
    const auto shown = shown_picture(pair.a.image, exposure), reference = shown_picture(pair.b.image, exposure);
    if (!shown || !reference) return std::nullopt;
    PerceivedError error;
    error.flip = io::flip(*shown, *reference);
    error.flip_mean = io::pixel_mean(error.flip, shown->width);
    error.flip_max = *std::max_element(error.flip.begin(), error.flip.end());
    error.ssim = io::ssim(*shown, *reference);
    error.not_finite = shown->not_finite + reference->not_finite;
    if (error.not_finite > 0)
        spdlog::warn("{} values of R, G and B are not finite; FLIP and SSIM take them for black", error.not_finite);
    const auto shown_again = again != nullptr ? shown_picture(again->image, exposure) : std::nullopt;
    if (shown_again)
        error.flip_mean.standard_error =
            io::standard_error_of_two(error.flip, io::flip(*shown_again, *reference), shown->width);
    return error;
}

}  // namespace gnomon::cli
