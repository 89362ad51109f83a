// SPDX-License-Identifier: Apache-2.0
// One image compared with another.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <map>

#include "command.hpp"
#include "compare.hpp"
#include "image_errors.hpp"
#include "io/perceived_error.hpp"
#include "io/png.hpp"
#include "options.hpp"

namespace gnomon::cli {

namespace {

using io::ChannelError;
using io::ExrImage;

const std::map<std::string, io::Metric> kMetrics = {
    {"rmse", io::Metric::rmse}, {"max", io::Metric::max}, {"psnr", io::Metric::psnr}, {"relmse", io::Metric::rel_mse}};

constexpr const char* kPicture[] = {"R", "G", "B"};

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
    for (const char* name : kPicture) {
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

/// Is what was asked for by name worse than the threshold? Pictures with values that are not finite always are. Never by the
/// metrics of single channels.
bool is_over(const PerceivedError& error, const std::string& metric, double threshold) {
    if (metric == "flip") return error.not_finite > 0 || error.flip_mean.mean > threshold;
    if (metric == "ssim") return error.not_finite > 0 || error.ssim < threshold;
    return false;
}

void write_flip(const std::string& path, const ExrImage& image, const PerceivedError& error) {
    std::vector<uint8_t> grey;
    for (const double value : error.flip) grey.insert(grey.end(), 3, static_cast<uint8_t>(std::lround(255.0 * value)));
    io::write_png(path, image.width, image.height, grey);
}

/// Both headers name a driver, and not the same.
bool drivers_differ(const ImagePair& pair) {
    const std::string a = driver_of(pair.a.image.attributes), b = driver_of(pair.b.image.attributes);
    return !a.empty() && !b.empty() && a != b;
}

io::Json driver_json(const NamedImage& image) {
    const std::string driver = driver_of(image.image.attributes);
    return driver.empty() ? io::Json(nullptr) : io::Json(driver);
}

/// The document "gnomon.compare". null: psnr where it is infinite, as between equal images; what is not known.
io::Json compare_json(const CompareOptions& options, const ImagePair& pair, const std::vector<ChannelError>& errors,
                      const std::optional<PerceivedError>& perceived, bool over) {
    io::Json json = io::document("compare");
    json["a"] = pair.a.path;
    json["b"] = pair.b.path;
    json["again"] = options.again.empty() ? io::Json(nullptr) : io::Json(options.again);
    json["drivers"] = {{"a", driver_json(pair.a)}, {"b", driver_json(pair.b)}, {"differ", drivers_differ(pair)}};
    json["width"] = pair.a.image.width;
    json["height"] = pair.a.image.height;
    json["channels"] = io::Json::array();
    for (const ChannelError& error : errors) {
        io::Json noise = nullptr;
        if (error.noise)
            noise = {{"variance", error.noise->variance},
                     {"share", error.noise->share},
                     {"mse_without", error.noise->mse_without},
                     {"mse_without_standard_error", error.noise->mse_without_standard_error}};
        json["channels"].push_back({{"name", error.name},
                                    {"bias", error.bias},
                                    {"bias_standard_error", error.bias_standard_error},
                                    {"rmse", error.rmse},
                                    {"rmse_standard_error", error.rmse_standard_error},
                                    {"max", error.max},
                                    {"psnr", error.psnr},
                                    {"relmse", error.rel_mse},
                                    {"relmse_standard_error", error.rel_mse_standard_error},
                                    {"noise", noise},
                                    {"compared", error.compared},
                                    {"not_finite", error.not_finite}});
    }
    if (perceived) {
        json["flip"] = {{"mean", perceived->flip_mean.mean},
                        {"mean_standard_error", perceived->flip_mean.standard_error},
                        {"max", perceived->flip_max},
                        {"not_finite", perceived->not_finite},
                        {"pixels_per_degree", io::kPixelsPerDegree},
                        {"exposure", options.exposure}};
        json["ssim"] = perceived->ssim;
    }
    json["metric"] = options.metric;
    json["threshold"] = options.threshold ? io::Json(*options.threshold) : io::Json(nullptr);
    json["over_threshold"] = over;
    return json;
}

/// What noise has in an error is at most what its heading says where only the number of samples tells it.
void print_table(const std::vector<ChannelError>& errors, bool noise_is_a_bound) {
    size_t width = 7;
    for (const ChannelError& error : errors) width = std::max(width, error.name.size());
    print_line(fmt::format("{:<{}} {:>11} {:>8} {:>12} {:>8} {:>8} {:>12} {:>9} {:>12} {:>11}", "channel", width, "bias",
                           "s.e.", "RMSE", "s.e.", noise_is_a_bound ? "noise <=" : "noise", "max", "PSNR dB", "relative MSE",
                           "not finite"));
    for (const ChannelError& error : errors) {
        const bool noise_is_known = error.noise && std::isfinite(error.noise->share);
        print_line(fmt::format("{:<{}} {:>11.4g} {:>8.2g} {:>12.6g} {:>8.2g} {:>8} {:>12.6g} {:>9.2f} {:>12.6g} {:>11}",
                               error.name, width, error.bias, error.bias_standard_error, error.rmse, error.rmse_standard_error,
                               noise_is_known ? fmt::format("{:.1f} %", 100.0 * error.noise->share) : "-", error.max,
                               error.psnr, error.rel_mse, error.not_finite));
    }
}

}  // namespace

int compare_images(const CompareOptions& options) {
    if (!options.diff.empty()) check_ending(options.diff, ".exr", "--diff");
    if (!options.diff_png.empty()) check_ending(options.diff_png, ".png", "--diff-png");
    if (!options.flip_png.empty()) check_ending(options.flip_png, ".png", "--flip-png");

    const NamedImage a = read_image(options.files.front()), b = read_image(options.files.back());
    const ImagePair pair{a, b};
    check_same_size(pair);
    if (const auto seed = common_seed(a.image.attributes, b.image.attributes); seed && options.again.empty())
        spdlog::info("both images have seed {}: their noise is partly the same, and how much it is not known", *seed);
    if (drivers_differ(pair))
        spdlog::warn("the images are of different drivers: {} of {}, {} of {}", a.path, driver_of(a.image.attributes), b.path,
                     driver_of(b.image.attributes));
    const std::vector<std::string> names = common_channels(pair, options.channels);
    std::optional<NamedImage> again;
    if (!options.again.empty()) {
        again = read_image(options.again);
        check_again(a, *again, names);
    }
    const std::vector<ChannelError> errors = channel_errors(pair, names, again ? &*again : nullptr);
    bool over = false;
    if (const auto metric = kMetrics.find(options.metric); options.threshold && metric != kMetrics.end())
        over = std::any_of(errors.begin(), errors.end(),
                           [&](const ChannelError& error) { return io::is_over(error, metric->second, *options.threshold); });

    const bool has_picture = std::all_of(std::begin(kPicture), std::end(kPicture), [&](const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    });
    const std::optional<PerceivedError> perceived =
        has_picture ? perceived_error(pair, options.exposure, again ? &*again : nullptr) : std::nullopt;
    if (!perceived && (!options.flip_png.empty() || !kMetrics.contains(options.metric)))
        throw Error(ErrorKind::input, "FLIP and SSIM need the channels R, G and B", pair.paths(),
                    "compare images that have them, and do not leave them out");
    if (perceived && options.threshold) over = over || is_over(*perceived, options.metric, *options.threshold);

    if (!options.flip_png.empty()) write_flip(options.flip_png, a.image, *perceived);
    if (!options.diff.empty() || !options.diff_png.empty()) {
        const std::vector<Channel> channels = difference(a.image, b.image, names);
        if (!options.diff.empty()) io::write_exr(options.diff, a.image.width, a.image.height, channels, {});
        if (!options.diff_png.empty())
            io::write_png(options.diff_png, a.image.width, a.image.height,
                          io::tone_map(difference_to_show(channels), options.exposure));
    }
    if (!options.json.empty()) write_json(options.json, compare_json(options, pair, errors, perceived, over));
    if (options.json != "-") {
        print_table(errors, options.again.empty());
        if (perceived)
            print_line(fmt::format("FLIP {:.6g} mean, s.e. {:.2g}, {:.6g} max; SSIM {:.6g}", perceived->flip_mean.mean,
                                   perceived->flip_mean.standard_error, perceived->flip_max, perceived->ssim));
    }
    return over ? kOverThreshold : kDone;
}

}  // namespace gnomon::cli
