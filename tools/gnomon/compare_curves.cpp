// SPDX-License-Identifier: Apache-2.0
#include "compare_curves.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gnomon/error.hpp>
#include <iostream>

#include "command.hpp"
#include "image_errors.hpp"
#include "io/error_curve.hpp"

namespace gnomon::cli {

namespace {

using io::CurvePoint;
using io::CurveValue;
using io::ErrorCurve;

/// What a document "gnomon.render" says.
struct Render {
    std::string path;
    std::string method;  ///< The settings that tell methods apart.
    std::string device;
    std::string exr;
    double seconds = 0.0;
    std::map<std::string, std::string> attributes;  ///< Those of its image.
};

/// A render's error in one channel.
struct Point {
    const Render* render;
    CurvePoint point;
};

/// The renders of one method in one channel.
struct Curve {
    std::string method;
    std::vector<Point> points;

    ErrorCurve line() const {
        std::vector<CurvePoint> curve_points;
        for (const Point& point : points) curve_points.push_back(point.point);
        return ErrorCurve(std::move(curve_points), method);
    }
};

struct CurvesOfChannel {
    std::string name;
    std::vector<Curve> curves;  ///< As the methods come on the command line.
};

[[noreturn]] void throw_not_a_render(const std::string& path, const std::string& reason) {
    throw Error(ErrorKind::input, "cannot read the render: " + reason, path, "give what render --json has written");
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
    std::ifstream file(path);
    if (!file) throw_not_a_render(path, "the file cannot be opened");
    try {
        const io::Json json = io::Json::parse(file);
        if (json.at("schema") != "gnomon.render") throw_not_a_render(path, "its schema is " + json.at("schema").dump());
        return {.path = path,
                .method = method_of(json.at("settings"), by),
                .device = json.at("device"),
                .exr = find_image(json.at("outputs").at(0), path),
                .seconds = json.at("wall_seconds"),
                .attributes = io::exr_attributes(json.at("settings"), json.at("effective"))};
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
                        fmt::format("the image was not rendered as {} says: {} is not {}", render.path, name, value),
                        render.exr, "render it again, with an image and a JSON of its own");
    }
    return image;
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

/// The error of a render by channel, or of the picture.
std::vector<std::pair<std::string, CurvePoint>> errors_of(const Render& render, const ImagePair& pair,
                                                          const std::vector<std::string>& names, const CurveOptions& options) {
    std::vector<std::pair<std::string, CurvePoint>> errors;
    if (options.metric == "flip") {
        const auto perceived = perceived_error(pair, options.exposure);
        if (!perceived)
            throw Error(ErrorKind::input, "FLIP needs the channels R, G and B", pair.paths(), "compare images that have them");
        errors.push_back({"picture", {render.seconds, perceived->flip_mean.mean, perceived->flip_mean.standard_error}});
        return errors;
    }
    for (const io::ChannelError& error : channel_errors(pair, names))
        errors.push_back({error.name, options.metric == "rmse"
                                          ? CurvePoint{render.seconds, error.rmse, error.rmse_standard_error}
                                          : CurvePoint{render.seconds, error.rel_mse, error.rel_mse_standard_error}});
    return errors;
}

Curve& curve_of(std::vector<Curve>& curves, const std::string& method) {
    const auto found = std::find_if(curves.begin(), curves.end(), [&](const Curve& curve) { return curve.method == method; });
    return found != curves.end() ? *found : curves.emplace_back(Curve{method, {}});
}

std::vector<CurvesOfChannel> read_curves(const std::vector<Render>& renders, const CurveOptions& options) {
    const NamedImage reference = read_image(options.reference);
    std::vector<std::string> names = options.channels;
    std::vector<CurvesOfChannel> channels;
    for (const Render& render : renders) {
        const NamedImage image = image_of(render);
        const ImagePair pair{image, reference};
        check_same_size(pair);
        if (const auto seed = common_seed(pair))
            spdlog::warn("{} and the reference have seed {}: noise that they share is not in the error", image.path, *seed);
        names = names.empty() ? channels_of_shadows(pair) : common_channels(pair, names);
        const auto errors = errors_of(render, pair, names, options);
        if (channels.empty())
            for (const auto& [name, point] : errors) channels.push_back({name, {}});
        for (size_t i = 0; i < errors.size(); ++i)
            curve_of(channels[i].curves, render.method).points.push_back({&render, errors[i].second});
    }
    std::erase_if(channels, [](const CurvesOfChannel& channel) {
        for (const Curve& curve : channel.curves)
            for (const Point& point : curve.points)
                if (point.point.error == 0.0) {
                    spdlog::warn("channel {} is left out: {} has no error in it", channel.name, point.render->path);
                    return true;
                }
        return false;
    });
    if (channels.empty())
        throw Error(ErrorKind::input, "no channel has an error in all renders", options.reference,
                    "give a reference that differs from them");
    return channels;
}

std::vector<double> seconds_to_compare(const CurveOptions& options, const ErrorCurve& yardstick) {
    std::vector<double> seconds = options.after;
    if (seconds.empty())
        for (const CurvePoint& point : yardstick.points()) seconds.push_back(point.seconds);
    return seconds;
}

std::vector<double> errors_to_compare(const CurveOptions& options, const ErrorCurve& yardstick) {
    std::vector<double> errors = options.to;
    if (errors.empty())
        for (const CurvePoint& point : yardstick.points()) errors.push_back(point.error);
    return errors;
}

const char* name_of(CurveValue::Where where) {
    switch (where) {
        case CurveValue::Where::before_first:
            return "before_first";
        case CurveValue::Where::measured:
            return "measured";
        case CurveValue::Where::after_last:
            return "after_last";
    }
    return "";
}

/// The document "gnomon.error_curves".
io::Json curves_json(const CurveOptions& options, const std::vector<CurvesOfChannel>& channels) {
    io::Json json = io::document("error_curves");
    json["reference"] = options.reference;
    json["metric"] = options.metric;
    json["by"] = options.by;
    json["channels"] = io::Json::array();
    for (const CurvesOfChannel& channel : channels) {
        const ErrorCurve yardstick = channel.curves.front().line();
        io::Json methods = io::Json::array();
        for (const Curve& curve : channel.curves) {
            const ErrorCurve line = curve.line();
            io::Json points = io::Json::array(), after = io::Json::array(), to = io::Json::array();
            for (const auto& [render, point] : curve.points)
                points.push_back({{"render", render->path},
                                  {"seconds", point.seconds},
                                  {"error", point.error},
                                  {"standard_error", point.standard_error}});
            for (const double seconds : seconds_to_compare(options, yardstick)) {
                const CurveValue value = line.error_after(seconds);
                after.push_back({{"seconds", seconds},
                                 {"where", name_of(value.where)},
                                 {"error", value.value},
                                 {"standard_error", value.standard_error}});
            }
            for (const double error : errors_to_compare(options, yardstick)) {
                const CurveValue value = line.seconds_to(error);
                to.push_back({{"error", error},
                              {"where", name_of(value.where)},
                              {"seconds", value.value},
                              {"standard_error", value.standard_error}});
            }
            methods.push_back({{"method", curve.method}, {"renders", points}, {"error_after", after}, {"seconds_to", to}});
        }
        json["channels"].push_back({{"name", channel.name}, {"methods", methods}});
    }
    return json;
}

/// A row for each place, a column for each method.
void print_values(const std::string& heading, const CurvesOfChannel& channel, const std::vector<double>& places,
                  CurveValue (ErrorCurve::*value_at)(double) const, const char* before_first, const char* after_last) {
    const auto text_of = [&](const CurveValue& value) -> std::string {
        if (value.where == CurveValue::Where::before_first) return before_first;
        if (value.where == CurveValue::Where::after_last) return after_last;
        return fmt::format("{:.4g} +- {:.2g}", value.value, value.standard_error);
    };
    std::cout << fmt::format("{:<20}", heading);
    for (const Curve& curve : channel.curves) std::cout << fmt::format(" {:>20}", curve.method);
    std::cout << "\n";
    for (const double place : places) {
        std::cout << fmt::format("{:<20.4g}", place);
        for (const Curve& curve : channel.curves) std::cout << fmt::format(" {:>20}", text_of((curve.line().*value_at)(place)));
        std::cout << "\n";
    }
}

void print_tables(const CurveOptions& options, const std::vector<CurvesOfChannel>& channels) {
    for (const CurvesOfChannel& channel : channels) {
        const ErrorCurve yardstick = channel.curves.front().line();
        std::cout << fmt::format("{} of {} against {}\n", options.metric, channel.name, options.reference);
        print_values("error after seconds", channel, seconds_to_compare(options, yardstick), &ErrorCurve::error_after,
                     "before the first", "after the last");
        print_values("seconds to error", channel, errors_to_compare(options, yardstick), &ErrorCurve::seconds_to,
                     "below at the first", "not reached");
    }
}

}  // namespace

int compare_curves(const CurveOptions& options) {
    if (options.metric != "rmse" && options.metric != "relmse" && options.metric != "flip")
        throw Error(ErrorKind::usage, options.metric + " has no standard error", "--metric", "give rmse, relmse or flip");
    std::vector<Render> renders;
    for (const std::string& path : options.renders) renders.push_back(read_render(path, options.by));
    for (const Render& render : renders)
        if (render.device != renders.front().device)
            spdlog::warn("{} was rendered on {}, {} on {}: their seconds differ for that", renders.front().path,
                         renders.front().device, render.path, render.device);
    const std::vector<CurvesOfChannel> channels = read_curves(renders, options);
    for (const CurvesOfChannel& channel : channels)
        for (const Curve& curve : channel.curves) curve.line();  // What is no curve is refused before anything is printed.
    if (!options.json.empty()) write_json(options.json, curves_json(options, channels));
    if (options.json != "-") print_tables(options, channels);
    return kDone;
}

}  // namespace gnomon::cli
