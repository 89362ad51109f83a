// SPDX-License-Identifier: Apache-2.0
// Methods compared after the same seconds and at the same error, from several renders of each.
#include <spdlog/fmt/fmt.h>

#include "command.hpp"
#include "compare.hpp"
#include "render_curves.hpp"

namespace gnomon::cli {

namespace {

using io::CurvePoint;
using io::CurveValue;
using io::ErrorCurve;

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

/// One of the two questions: what is asked for and what answers it.
struct Question {
    CurveValue (ErrorCurve::*answer)(double) const;
    std::vector<double> places;
};

/// The places that are asked for, else those of the first method's renders.
std::vector<double> places_of(const std::vector<double>& asked, const ChannelCurves& channel, double CurvePoint::*place) {
    std::vector<double> places = asked;
    const ErrorCurve first = channel.methods.front().curve();
    if (asked.empty())
        for (const CurvePoint& point : first.points()) places.push_back(point.*place);
    return places;
}

Question error_after(const CompareOptions& options, const ChannelCurves& channel) {
    return {&ErrorCurve::error_after, places_of(options.after, channel, &CurvePoint::seconds)};
}

Question seconds_to(const CompareOptions& options, const ChannelCurves& channel) {
    return {&ErrorCurve::seconds_to, places_of(options.to, channel, &CurvePoint::error)};
}

io::Json answers_json(const ErrorCurve& curve, const Question& question, const char* place_name, const char* value_name) {
    io::Json json = io::Json::array();
    for (const double place : question.places) {
        const CurveValue value = (curve.*question.answer)(place);
        json.push_back({{place_name, place},
                        {"where", name_of(value.where)},
                        {value_name, value.value},
                        {"standard_error", value.standard_error}});
    }
    return json;
}

/// The document "gnomon.error_curves". null: what was not measured.
io::Json curves_json(const CompareOptions& options, const std::vector<ChannelCurves>& channels) {
    io::Json json = io::document("error_curves");
    json["reference"] = options.files.back();
    json["metric"] = options.metric;
    json["by"] = options.by;
    json["channels"] = io::Json::array();
    for (const ChannelCurves& channel : channels) {
        io::Json methods = io::Json::array();
        for (const MethodCurve& method : channel.methods) {
            const ErrorCurve curve = method.curve();
            io::Json renders = io::Json::array();
            for (const auto& [path, driver, point] : method.renders)
                renders.push_back({{"render", path},
                                   {"driver", driver.empty() ? io::Json(nullptr) : io::Json(driver)},
                                   {"seconds", point.seconds},
                                   {"error", point.error},
                                   {"standard_error", point.standard_error}});
            methods.push_back({{"method", method.method},
                               {"renders", renders},
                               {"error_after", answers_json(curve, error_after(options, channel), "seconds", "error")},
                               {"seconds_to", answers_json(curve, seconds_to(options, channel), "error", "seconds")}});
        }
        json["channels"].push_back({{"name", channel.name}, {"methods", methods}});
    }
    return json;
}

/// A row for each place, a column for each method.
void print_answers(const std::string& heading, const ChannelCurves& channel, const Question& question, const char* after_last) {
    std::string line = fmt::format("{:<20}", heading);
    for (const MethodCurve& method : channel.methods) line += fmt::format("  {:>20}", method.method);
    print_line(line);
    for (const double place : question.places) {
        line = fmt::format("{:<20.4g}", place);
        for (const MethodCurve& method : channel.methods) {
            const CurveValue value = (method.curve().*question.answer)(place);
            std::string text = fmt::format("{:.4g} +- {:.2g}", value.value, value.standard_error);
            if (value.where == CurveValue::Where::before_first) text = "before the first";
            if (value.where == CurveValue::Where::after_last) text = after_last;
            line += fmt::format("  {:>20}", text);
        }
        print_line(line);
    }
}

}  // namespace

int compare_curves(const CompareOptions& options) {
    const std::vector<ChannelCurves> channels = render_curves(options);
    const io::Json json = curves_json(options, channels);
    if (!options.json.empty()) write_json(options.json, json);
    if (options.json == "-") return kDone;
    for (const ChannelCurves& channel : channels) {
        print_line(fmt::format("{} of {} against {}", options.metric, channel.name, options.files.back()));
        print_answers("error after seconds", channel, error_after(options, channel), "after the last");
        print_answers("seconds to error", channel, seconds_to(options, channel), "not reached");
    }
    return kDone;
}

}  // namespace gnomon::cli
