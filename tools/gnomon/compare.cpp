// SPDX-License-Identifier: Apache-2.0
// `gnomon compare`: how far one image is from another.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "command.hpp"
#include "io/exr.hpp"
#include "io/image_compare.hpp"
#include "io/perceived_error.hpp"
#include "io/png.hpp"
#include "options.hpp"

namespace gnomon::cli {

namespace {

using io::ChannelError;
using io::ExrImage;

const std::map<std::string, io::Metric> kMetrics = {
    {"rmse", io::Metric::rmse}, {"max", io::Metric::max}, {"psnr", io::Metric::psnr}, {"relmse", io::Metric::rel_mse}};

/// What the pictures look like, where both have R, G and B.
struct PerceivedError {
    std::vector<double> flip;  ///< Per pixel.
    double flip_mean = 0.0;
    double flip_max = 0.0;
    double ssim = 0.0;
};

struct CompareOptions {
    std::string a;
    std::string b;
    std::string json;
    std::string diff;
    std::string diff_png;
    std::string flip_png;
    double exposure = 0.0;
    std::vector<std::string> channels;
    std::string metric = "rmse";
    std::optional<double> threshold;
};

std::string names_of(const ExrImage& image) {
    std::vector<std::string> names;
    for (const Channel& channel : image.channels) names.push_back(channel.name);
    return names.empty() ? "no channels" : fmt::format("{}", fmt::join(names, ", "));
}

/// The channels to compare: those asked for, else those that both images have, with a warning for each other one.
std::vector<std::string> common_channels(const ExrImage& a, const ExrImage& b, const CompareOptions& options) {
    std::vector<std::string> names;
    for (const std::string& name : options.channels) {
        for (const auto& [image, path] : {std::pair(&a, &options.a), std::pair(&b, &options.b)})
            if (image->find(name) == nullptr)
                throw Error(ErrorKind::input, "there is no channel " + name, *path, "it has " + names_of(*image));
        names.push_back(name);
    }
    if (!names.empty()) return names;
    for (const Channel& channel : a.channels) {
        if (b.find(channel.name) != nullptr) {
            names.push_back(channel.name);
        } else {
            spdlog::warn("channel {} is not compared: {} has none", channel.name, options.b);
        }
    }
    for (const Channel& channel : b.channels)
        if (a.find(channel.name) == nullptr) spdlog::warn("channel {} is not compared: {} has none", channel.name, options.a);
    if (names.empty())
        throw Error(ErrorKind::input, fmt::format("the images have no channel in common: {} and {}", names_of(a), names_of(b)),
                    options.a + " and " + options.b, "compare images with the same channels");
    return names;
}

/// a - b, channel by channel.
std::vector<Channel> difference(const ExrImage& a, const ExrImage& b, const std::vector<std::string>& names) {
    std::vector<Channel> channels;
    for (const std::string& name : names) {
        Channel channel = *a.find(name);
        const std::vector<float>& reference = b.find(name)->values;
        for (size_t i = 0; i < reference.size(); ++i) channel.values[i] -= reference[i];
        channels.push_back(std::move(channel));
    }
    return channels;
}

/// |a - b| as R, G and B: of these channels if all are there, else of the first channel in grey.
std::vector<Channel> difference_to_show(std::vector<Channel> channels) {
    std::vector<Channel> shown;
    for (const char* name : {"R", "G", "B"}) {
        const auto found = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
        if (found != channels.end()) shown.push_back(*found);
    }
    if (shown.size() < 3) {
        spdlog::info("the difference image shows channel {}", channels.front().name);
        shown.assign(3, channels.front());
        for (size_t i = 0; i < 3; ++i) shown[i].name = std::string(1, "RGB"[i]);
    }
    for (Channel& channel : shown)
        for (float& value : channel.values) value = std::abs(value);
    return shown;
}

std::optional<PerceivedError> perceived_error(const ExrImage& a, const ExrImage& b, const std::vector<std::string>& names,
                                              double exposure) {
    for (const char* name : {"R", "G", "B"})
        if (std::find(names.begin(), names.end(), name) == names.end()) return std::nullopt;
    const auto shown = io::shown_picture(a.channels, a.width, a.height, exposure);
    const auto reference = io::shown_picture(b.channels, b.width, b.height, exposure);
    PerceivedError error;
    error.flip = io::flip(*shown, *reference);
    for (const double value : error.flip) {
        error.flip_mean += value / static_cast<double>(error.flip.size());
        error.flip_max = std::max(error.flip_max, value);
    }
    error.ssim = io::ssim(*shown, *reference);
    return error;
}

/// Is what was asked for by name worse than the threshold? Nothing for the metrics of single channels.
std::optional<bool> is_over(const PerceivedError& error, const std::string& metric, double threshold) {
    if (metric == "flip") return error.flip_mean > threshold;
    if (metric == "ssim") return error.ssim < threshold;
    return std::nullopt;
}

void write_flip(const std::string& path, const ExrImage& image, const PerceivedError& error) {
    std::vector<uint8_t> grey;
    for (const double value : error.flip) grey.insert(grey.end(), 3, static_cast<uint8_t>(std::lround(255.0 * value)));
    io::write_png(path, image.width, image.height, grey);
}

/// The document "gnomon.compare". psnr is null where it is infinite, which is where the images are equal.
io::Json compare_json(const CompareOptions& options, const ExrImage& a, const std::vector<ChannelError>& errors,
                      const std::optional<PerceivedError>& perceived, bool over) {
    io::Json json = io::document("compare");
    json["a"] = options.a;
    json["b"] = options.b;
    json["width"] = a.width;
    json["height"] = a.height;
    json["channels"] = io::Json::array();
    for (const ChannelError& error : errors)
        json["channels"].push_back({{"name", error.name},
                                    {"rmse", error.rmse},
                                    {"max", error.max},
                                    {"psnr", error.psnr},
                                    {"relmse", error.rel_mse},
                                    {"compared", error.compared},
                                    {"not_finite", error.not_finite}});
    if (perceived) {
        json["flip"] = {{"mean", perceived->flip_mean},
                        {"max", perceived->flip_max},
                        {"pixels_per_degree", io::kPixelsPerDegree},
                        {"exposure", options.exposure}};
        json["ssim"] = perceived->ssim;
    }
    json["metric"] = options.metric;
    json["threshold"] = options.threshold ? io::Json(*options.threshold) : io::Json(nullptr);
    json["over_threshold"] = over;
    return json;
}

void print_table(const std::vector<ChannelError>& errors) {
    size_t width = 7;
    for (const ChannelError& error : errors) width = std::max(width, error.name.size());
    std::cout << fmt::format("{:<{}} {:>12} {:>12} {:>9} {:>12} {:>11}\n", "channel", width, "RMSE", "max", "PSNR dB",
                             "relative MSE", "not finite");
    for (const ChannelError& error : errors)
        std::cout << fmt::format("{:<{}} {:>12.6g} {:>12.6g} {:>9.2f} {:>12.6g} {:>11}\n", error.name, width, error.rmse,
                                 error.max, error.psnr, error.rel_mse, error.not_finite);
}

int compare(const CompareOptions& options) {
    if (!options.diff.empty()) check_ending(options.diff, ".exr", "--diff");
    if (!options.diff_png.empty()) check_ending(options.diff_png, ".png", "--diff-png");
    if (!options.flip_png.empty()) check_ending(options.flip_png, ".png", "--flip-png");

    const ExrImage a = io::read_exr(options.a);
    const ExrImage b = io::read_exr(options.b);
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorKind::input,
                    fmt::format("the images differ in size: {}x{} and {}x{}", a.width, a.height, b.width, b.height),
                    options.a + " and " + options.b, "compare images of one size");

    const std::vector<std::string> names = common_channels(a, b, options);
    std::vector<ChannelError> errors;
    bool over = false;
    for (const std::string& name : names) {
        errors.push_back(io::compare_channel(name, a.find(name)->values, b.find(name)->values));
        if (errors.back().not_finite > 0)
            spdlog::warn("channel {} has {} values that are not finite; the errors leave them out", name,
                         errors.back().not_finite);
        const auto metric = kMetrics.find(options.metric);
        over = over || (options.threshold && metric != kMetrics.end() &&
                        io::is_over(errors.back(), metric->second, *options.threshold));
    }
    const std::optional<PerceivedError> perceived = perceived_error(a, b, names, options.exposure);
    if (!perceived && (!options.flip_png.empty() || !kMetrics.contains(options.metric)))
        throw Error(ErrorKind::input, "FLIP and SSIM need the channels R, G and B", options.a + " and " + options.b,
                    "compare images that have them, and do not leave them out");
    if (perceived && options.threshold) over = over || is_over(*perceived, options.metric, *options.threshold).value_or(false);

    if (!options.flip_png.empty()) write_flip(options.flip_png, a, *perceived);
    if (!options.diff.empty() || !options.diff_png.empty()) {
        const std::vector<Channel> channels = difference(a, b, names);
        if (!options.diff.empty()) io::write_exr(options.diff, a.width, a.height, channels, {});
        if (!options.diff_png.empty())
            io::write_png(options.diff_png, a.width, a.height, io::tone_map(difference_to_show(channels), options.exposure));
    }
    if (!options.json.empty()) write_json(options.json, compare_json(options, a, errors, perceived, over));
    if (options.json != "-") {
        print_table(errors);
        if (perceived)
            std::cout << fmt::format("FLIP {:.6g} mean, {:.6g} max; SSIM {:.6g}\n", perceived->flip_mean, perceived->flip_max,
                                     perceived->ssim);
    }
    return over ? kOverThreshold : kDone;
}

}  // namespace

void add_compare(CLI::App& app, Invocation& invocation) {
    CLI::App* command =
        add_command(app, invocation, "compare", "Say how far image A is from the reference B, channel by channel");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("A", options->a, "Image, .exr")->required()->type_name("");
    command->add_option("B", options->b, "Reference, .exr")->required()->type_name("");
    command->add_option("--channels", options->channels, "Only these, separated by commas [all that both have]")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--metric", options->metric, "What the threshold is for: rmse, max, psnr, relmse, flip (its mean), ssim")
        ->type_name("NAME")
        ->check(CLI::IsMember({"rmse", "max", "psnr", "relmse", "flip", "ssim"}).description(""))
        ->capture_default_str();
    command
        ->add_option_function<std::string>(
            "--threshold",
            [options](const std::string& text) {
                options->threshold = parse_number(text, "--threshold", 0.0, std::numeric_limits<double>::max());
            },
            "Exit code 8 if a channel or the picture is above it (for psnr and ssim: below it)")
        ->type_name("VALUE");
    command->add_option("--diff", options->diff, "Image of A - B")->type_name("OUT.exr");
    command->add_option("--diff-png", options->diff_png, "Image of |A - B|, sRGB 8 bit")->type_name("OUT.png");
    command->add_option("--flip-png", options->flip_png, "FLIP of each pixel, 0 black, 1 white")->type_name("OUT.png");
    command
        ->add_option_function<std::string>(
            "--exposure",
            [options](const std::string& text) { options->exposure = parse_number(text, "--exposure", -100.0, 100.0); },
            "Pictures are shown brighter by 2^EV: --diff-png, FLIP and SSIM")
        ->type_name("EV")
        ->default_str("0");
    command->add_option("--json", options->json, "Write it as JSON; - for stdout, instead of the table")
        ->type_name("FILE.json");
    command->callback([&invocation, command, options] {
        invocation.run = [command, options] {
            warn_if_unused(*command, "--metric", "--threshold");
            return compare(*options);
        };
    });
}

}  // namespace gnomon::cli
