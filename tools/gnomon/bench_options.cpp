// SPDX-License-Identifier: Apache-2.0
#include "bench_options.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "bench_axes.hpp"
#include "layouts/layout.hpp"

namespace gnomon::cli {

namespace {

constexpr const char* kNull = "null";

BenchLayout layout_of(const std::string& asked) {
    const Layout layout = find_layout(asked);
    return {asked, layout.name, layout.lossless};
}

void add_axis(std::vector<Axis>& axes, const std::string& text) {
    Axis axis = parse_axis(text);
    const auto same = [&](const Axis& other) { return other.name == axis.name; };
    if (std::any_of(axes.begin(), axes.end(), same))
        throw Error(ErrorKind::usage, "the axis " + axis.name + " is given twice", "--axis", "name all its values at once");
    axes.push_back(std::move(axis));
}

}  // namespace

void bind_bench_options(CLI::App& command, BenchOptions& options) {
    constexpr const char* kWhat = "What is compared";
    constexpr const char* kHow = "How it is measured";
    constexpr const char* kOutput = "Output";
    BenchOptions& o = options;
    const auto each = [&](const std::string& name, const std::string& type, const std::string& description, auto add) {
        command
            .add_option_function<std::vector<std::string>>(
                name,
                [add](const std::vector<std::string>& texts) {
                    for (const std::string& text : texts) add(text);
                },
                description)
            ->allow_extra_args(false)
            ->type_name(type)
            ->group(kWhat);
    };
    command.add_option("SCENE", o.scenes, "Scenes, .gltf or .glb")->type_name("")->group(kWhat);
    command.add_option("--layout", o.layouts, "S-buffer layouts, by name or folder [all that are built in]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("NAME|FOLDER,...")
        ->group(kWhat);
    command.add_option("--baseline", o.baseline, "The layout that the others are compared with [the first]")
        ->type_name("NAME|FOLDER")
        ->group(kWhat);
    each("--axis", "NAME=V,V,...",
         "Measure with each of these values, and all combinations of several axes: " + axis_names() +
             ". speed 2 opens the shutter twice as long, so that things move twice as far",
         [&o](const std::string& text) { add_axis(o.axes, text); });
    each("--synthetic", "lengths=uniform|zipf|spike,...",
         "A scene of stacks of triangles, as lists of these lengths: with mean=8 ranges, order=as-is, shuffled or sorted",
         [&o](const std::string& text) { o.synthetic.push_back(parse_synthetic(text)); });
    command.add_flag("!--no-null", o.null, "Leave out the layout null, which shows what a frame takes without any layout")
        ->group(kWhat);

    command.add_option("--repetitions", o.limits.repetitions, "Frames of each case; of fewer than 9 nothing is decided")
        ->type_name("N")
        ->check(CLI::Range(1, 1000).description(""))
        ->capture_default_str()
        ->group(kHow);
    command.add_option("--timeout", o.limits.timeout, "Leave out a case whose frames take longer in all [no limit]")
        ->type_name("SECONDS")
        ->check(CLI::PositiveNumber.description(""))
        ->group(kHow);

    command
        .add_option("--json", o.render.json,
                    "Everything, as Google Benchmark's tools read it; - for stdout, instead of the text")
        ->type_name("FILE.json")
        ->group(kOutput);
    command.add_option("--csv", o.csv, "All samples, one a line")->type_name("FILE.csv")->group(kOutput);
    command.add_option("--artifact", o.artifact, "Make a folder with all that somebody needs who repeats the run")
        ->type_name("FOLDER")
        ->group(kOutput);
    bind_setting_options(command, o.render);
}

std::vector<BenchLayout> bench_layouts(const BenchOptions& options) {
    std::vector<std::string> asked = options.layouts;
    if (asked.empty()) {
        asked = layout_names();
        std::erase(asked, kNull);
    }
    std::vector<BenchLayout> layouts;
    for (const std::string& name : asked) {
        layouts.push_back(layout_of(name));
        const auto same = [&](const BenchLayout& other) { return other.name == layouts.back().name; };
        if (std::any_of(layouts.begin(), layouts.end() - 1, same))
            throw Error(ErrorKind::usage, "two layouts are called " + layouts.back().name, "--layout",
                        "name each once; a folder's is in its layout.json");
    }
    if (!options.baseline.empty()) {
        const std::string name = layout_of(options.baseline).name;
        const auto found = std::find_if(layouts.begin(), layouts.end(), [&](const auto& other) { return other.name == name; });
        if (found == layouts.end())
            throw Error(ErrorKind::usage, "the baseline " + name + " is not measured", "--baseline", "name it in --layout too");
        std::rotate(layouts.begin(), found, found + 1);
    }
    const bool has_null = std::any_of(layouts.begin(), layouts.end(), [](const auto& other) { return other.name == kNull; });
    layouts.push_back(layouts.front());
    layouts.back().again = true;
    if (options.null && !has_null) {
        layouts.push_back(layout_of(kNull));
        layouts.back().compared = false;
    }
    return layouts;
}

std::vector<BenchGroup> bench_points(const BenchOptions& options) {
    std::vector<BenchGroup> points;
    for (const AxisValues& values : combinations(options.axes)) {
        BenchGroup& point = points.emplace_back();
        point.settings = options.render.settings;
        point.time_steps = options.render.time_steps;
        point.axes = values;
        for (const auto& [name, value] : values) set_axis(name, value, point);
    }
    return points;
}

}  // namespace gnomon::cli
