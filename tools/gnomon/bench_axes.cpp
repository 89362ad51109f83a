// SPDX-License-Identifier: Apache-2.0
#include "bench_axes.hpp"

#include <algorithm>
#include <functional>
#include <gnomon/error.hpp>
#include <sstream>

#include "methods/method.hpp"
#include "options.hpp"

namespace gnomon::cli {

namespace {

using Text = const std::string&;

struct AxisKind {
    const char* name;
    std::function<void(BenchGroup&, Text value, Text option)> set;
};

void set_size(BenchGroup& point, Text value, Text option) {
    const Size size = parse_size(value, option);
    point.settings.width = size.width;
    point.settings.height = size.height;
}

void set_pages(BenchGroup& point, Text value, Text option) {
    if (value != "auto" && value != "asked" && value != "all")
        throw Error(ErrorKind::usage, "no pages '" + value + "'", option, "use auto, asked or all");
    point.settings.pages = value;
}

void set_method(BenchGroup& point, Text value, Text option) {
    if (!find_method(value).has_s_buffer())
        throw Error(ErrorKind::usage, "method " + value + " has no S-buffer, whatever the layout", option,
                    "use methods that have one, see 'gnomon methods'");
    point.settings.method = value;
}

const std::vector<AxisKind>& kinds() {
    constexpr double kFastest = 1e6;
    static const std::vector<AxisKind> all = {
        {"shadow-res", [](auto& p, Text v, Text o) { p.settings.shadow_res = parse_count(v, o, 1, 16384); }},
        {"cells", [](auto& p, Text v, Text o) { p.settings.light_cells = parse_count(v, o, 1, kMostSegments); }},
        {"spp", [](auto& p, Text v, Text o) { p.settings.spp = parse_count(v, o, 1, 65536); }},
        {"speed", [](auto& p, Text v, Text o) { p.speed = parse_number(v, o, 0.0, kFastest); }},
        {"method", set_method},
        {"size", set_size},
        {"time-steps", [](auto& p, Text v, Text o) { p.time_steps = parse_count(v, o, 1, kMostSegments); }},
        {"raster", [](auto& p, Text v, Text) { p.settings.raster = v; }},
        {"pages", set_pages},
        {"memory-budget", [](auto& p, Text v, Text o) { p.settings.memory_budget = parse_bytes(v, o); }}};
    return all;
}

struct Fixed {
    const char* name;
    const char* why;
    const char* instead;
};

// What somebody may well try.
constexpr Fixed kFixed[] = {
    {"tile", "tiles are of 8x8 texels: shaders are compiled for that", "leave it out"},
    {"texels", "how texels are numbered is a layout's own, said by its manifest", "use --layout array,array-morton"},
    {"layout", "layouts are what is compared", "use --layout A,B"},
    {"scene", "scenes are named on their own", "use gnomon bench SCENE..."},
    {"seed", "another seed is another noise of the same picture", "use --repetitions"},
    {"device", "a run is of one device: other times can not be paired", "run once for each"},
};

const AxisKind* find_kind(Text name) {
    const auto found = std::find_if(kinds().begin(), kinds().end(), [&](const AxisKind& kind) { return name == kind.name; });
    return found == kinds().end() ? nullptr : &*found;
}

}  // namespace

std::string axis_names() {
    std::string names;
    for (const AxisKind& kind : kinds()) names += (names.empty() ? "" : ", ") + std::string(kind.name);
    return names;
}

void set_axis(Text name, Text value, BenchGroup& point) { find_kind(name)->set(point, value, "--axis " + name); }

Axis parse_axis(Text text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw Error(ErrorKind::usage, "'" + text + "' is not an axis", "--axis", "use NAME=VALUE,VALUE,...");
    Axis axis{text.substr(0, equals), {}};
    for (const Fixed& fixed : kFixed) {
        if (axis.name == fixed.name)
            throw Error(ErrorKind::usage, axis.name + " cannot be varied: " + fixed.why, "--axis", fixed.instead);
    }
    if (find_kind(axis.name) == nullptr)
        throw Error(ErrorKind::usage, "there is no axis '" + axis.name + "'", "--axis", "use " + axis_names());
    std::istringstream values(text.substr(equals + 1));
    for (std::string value; std::getline(values, value, ',');) {
        if (std::find(axis.values.begin(), axis.values.end(), value) != axis.values.end())
            throw Error(ErrorKind::usage, axis.name + " has the value '" + value + "' twice", "--axis", "name each once");
        BenchGroup trial;
        set_axis(axis.name, value, trial);
        axis.values.push_back(value);
    }
    return axis;
}

std::vector<AxisValues> combinations(const std::vector<Axis>& axes) {
    std::vector<AxisValues> all = {{}};
    for (const Axis& axis : axes) {
        std::vector<AxisValues> longer;
        for (const AxisValues& before : all) {
            for (Text value : axis.values) {
                longer.push_back(before);
                longer.back().emplace_back(axis.name, value);
            }
        }
        all = std::move(longer);
    }
    return all;
}

}  // namespace gnomon::cli
