// SPDX-License-Identifier: Apache-2.0
#include "render_curves.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <gnomon/error.hpp>

#include "image_errors.hpp"
#include "io/report.hpp"
#include "text/json_bounds.hpp"
#include "text/read_text.hpp"

namespace gnomon::cli {

namespace {

using io::CurvePoint;

/// What a document "gnomon.render" says.
struct Render {
    std::string json;
    std::string method;
    std::string device;
    std::string driver;  ///< Empty where it names none.
    std::string exr;
    double seconds = 0.0;
    Attributes attributes;  ///< Those of its image.
};

/// A render and, where there is one, another that differs from it in the seed.
struct RenderTwice {
    Render first;
    std::optional<Render> again;
};

constexpr const char* kHint = "give what render --json has written";

[[noreturn]] void throw_not_a_render(const std::string& path, const std::string& reason) {
    throw Error(ErrorKind::input, "cannot read the render: " + reason, path, kHint);
}

/// The image is where the document says it is or, if that has moved, beside the document.
std::string find_image(const std::string& output, const std::string& json_path) {
    const std::filesystem::path beside =
        std::filesystem::path(json_path).parent_path() / std::filesystem::path(output).filename();
    std::error_code ignored;
    return std::filesystem::exists(output, ignored) ? output : beside.string();
}

/// The values of the settings that tell methods apart; "-" where this render has no such setting.
std::string method_of(const io::Json& settings, const std::vector<std::string>& by) {
    std::vector<std::string> values;
    for (const std::string& name : by) {
        const auto found = settings.find(name);
        values.push_back(found == settings.end() ? "-" : found->is_string() ? found->get<std::string>() : found->dump());
    }
    return fmt::format("{}", fmt::join(values, " "));
}

Render read_render(const std::string& path, const std::vector<std::string>& by) {
    std::string reason;
    const std::optional<std::string> text = read_text(path, reason);
    if (!text) throw_not_a_render(path, reason);
    check_json(*text, path, kHint);
    try {
        const io::Json json = io::Json::parse(*text);
        if (json.at("schema") != "gnomon.render") throw_not_a_render(path, "its schema is " + json.at("schema").dump());
        const io::Json& settings = json.at("settings");
        return {.json = path,
                .method = method_of(settings, by),
                .device = json.at("device"),
                .driver = json.value("driver", ""),
                .exr = find_image(json.at("outputs").at(0), path),
                .seconds = json.at("wall_seconds"),
                .attributes = io::exr_attributes(settings, json.at("effective"))};
    } catch (const nlohmann::json::exception& error) {
        throw_not_a_render(path, error.what());
    }
}

/// An image may have been overwritten since.
NamedImage image_of(const Render& render) {
    NamedImage image = read_image(render.exr);
    for (const auto& [name, value] : render.attributes) {
        const auto found = image.image.attributes.find(name);
        if (found == image.image.attributes.end() || found->second != value)
            throw Error(ErrorKind::input,
                        fmt::format("the image was not rendered as {} says: {} is not {}", render.json, name, value),
                        render.exr, "render it again, with an image and a JSON of its own");
    }
    return image;
}

std::vector<RenderTwice> read_renders(const CompareOptions& options) {
    std::vector<RenderTwice> renders;
    for (size_t i = 0; i + 1 < options.files.size(); ++i) {
        Render render = read_render(options.files[i], options.by);
        const auto found = std::find_if(renders.begin(), renders.end(), [&](const RenderTwice& other) {
            const Attributes &a = other.first.attributes, &b = render.attributes;
            return !other.again && !common_seed(a, b) && !setting_that_differs(a, b);
        });
        if (found != renders.end())
            found->again = std::move(render);
        else
            renders.push_back({std::move(render), std::nullopt});
    }
    return renders;
}

/// R, G, B and the visibilities: what a method's error shows in.
std::vector<std::string> channels_of_shadows(const ImagePair& pair) {
    std::vector<std::string> names;
    for (const std::string& name : common_channels(pair, {}))
        if (name == "R" || name == "G" || name == "B" || name.starts_with("visibility.")) names.push_back(name);
    if (names.empty())
        throw Error(ErrorKind::input, "the images have neither colours nor visibilities in common", pair.paths(),
                    "name channels with --channels");
    return names;
}

using NamedPoints = std::vector<std::pair<std::string, CurvePoint>>;

/// The error of each channel, or the mean FLIP of the picture.
NamedPoints errors_of(const Render& render, const ImagePair& pair, const NamedImage* again, const CompareOptions& options) {
    if (options.metric == "flip") {
        if (again != nullptr) check_again(pair.a, *again, {"R", "G", "B"});
        const auto error = perceived_error(pair, options.exposure, again);
        if (!error)
            throw Error(ErrorKind::input, "FLIP needs the channels R, G and B", pair.paths(), "compare images that have them");
        return {{"picture", {render.seconds, error->flip_mean.mean, error->flip_mean.standard_error}}};
    }
    const auto names = options.channels.empty() ? channels_of_shadows(pair) : common_channels(pair, options.channels);
    if (again != nullptr) check_again(pair.a, *again, names);
    NamedPoints points;
    for (const io::ChannelError& error : channel_errors(pair, names, again)) {
        if (options.metric == "rmse")
            points.push_back({error.name, {render.seconds, error.rmse, error.rmse_standard_error}});
        else
            points.push_back({error.name, {render.seconds, error.rel_mse, error.rel_mse_standard_error}});
    }
    return points;
}

/// The one of this name, which is added where there is none.
template <class Named>
Named& named(std::vector<Named>& all, std::string Named::*name, const std::string& value) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.*name == value; });
    if (found != all.end()) return *found;
    all.emplace_back().*name = value;
    return all.back();
}

/// Where a render has no error, as in the visibility of a light that nothing hides, methods cannot be compared.
bool lacks_an_error(const ChannelCurves& channel) {
    for (const MethodCurve& method : channel.methods) {
        for (const MethodCurve::Render& render : method.renders) {
            if (render.point.error > 0.0) continue;
            spdlog::warn("channel {} is left out: {} has no error in it", channel.name, render.json);
            return true;
        }
    }
    return false;
}

}  // namespace

io::ErrorCurve MethodCurve::curve() const {
    std::vector<CurvePoint> points;
    for (const Render& render : renders) points.push_back(render.point);
    return io::ErrorCurve(std::move(points), method);
}

std::vector<ChannelCurves> render_curves(const CompareOptions& options) {
    if (options.metric != "rmse" && options.metric != "relmse" && options.metric != "flip")
        throw Error(ErrorKind::usage, "there is no standard error of " + options.metric, "--metric",
                    "give rmse, relmse or flip");
    const std::vector<RenderTwice> renders = read_renders(options);
    const NamedImage reference = read_image(options.files.back());
    std::vector<ChannelCurves> channels;
    for (const auto& [render, second] : renders) {
        if (const Render& first = renders.front().first; render.device != first.device)
            spdlog::warn("{} was rendered on {}, {} on {}: their seconds differ for that", first.json, first.device,
                         render.json, render.device);
        else if (!render.driver.empty() && !first.driver.empty() && render.driver != first.driver)
            spdlog::warn("{} was rendered by the driver {}, {} by {}: their seconds differ for that", first.json, first.driver,
                         render.json, render.driver);
        const NamedImage image = image_of(render);
        const std::optional<NamedImage> again = second ? std::optional(image_of(*second)) : std::nullopt;
        const ImagePair pair{image, reference};
        check_same_size(pair);
        if (const auto seed = common_seed(image.image.attributes, reference.image.attributes))
            spdlog::warn("{} and the reference have seed {}: noise that they share is not in the error", image.path, *seed);
        const NamedPoints errors = errors_of(render, pair, again ? &*again : nullptr, options);
        for (const auto& [name, point] : errors) {
            ChannelCurves& channel = named(channels, &ChannelCurves::name, name);
            named(channel.methods, &MethodCurve::method, render.method).renders.push_back({render.json, render.driver, point});
        }
    }
    std::erase_if(channels, lacks_an_error);
    if (channels.empty())
        throw Error(ErrorKind::input, "there is no channel in which all renders have an error", reference.path,
                    "give a reference that differs from them");
    return channels;
}

}  // namespace gnomon::cli
