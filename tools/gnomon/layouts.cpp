// SPDX-License-Identifier: Apache-2.0
// `gnomon layouts`: the S-buffer layouts that are built in, and the beginning of another.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <gnomon/error.hpp>
#include <iostream>
#include <memory>

#include "check_layout.hpp"
#include "command.hpp"
#include "io/atomic_file.hpp"
#include "layouts/layout.hpp"
#include "layouts/memory.hpp"
#include "methods/method.hpp"

namespace gnomon::cli {

namespace {

// What it makes of ranges.
std::string keeps(const Layout& layout) {
    if (layout.lossless) return "all ranges";
    return layout.only_contains() ? "ranges that contain the true ones" : "some ranges, and counts those that are lost";
}

std::vector<std::string> passes(const Layout& layout) {
    std::vector<std::string> names = {"count"};
    if (layout.sizes.size() > 1) names.emplace_back("size");
    const auto summed = [](const LayoutSize& size) { return size.as == LayoutSize::As::offsets; };
    if (std::any_of(layout.sizes.begin(), layout.sizes.end(), summed)) names.emplace_back("scan");
    if (layout.prepare != Layout::Pass::none) names.emplace_back("prepare");
    names.emplace_back("fill");
    if (layout.finish != Layout::Pass::none) names.emplace_back("finish");
    return names;
}

std::vector<std::string> methods_of(const Layout& layout) {
    std::vector<std::string> names;
    for (const Method& method : methods()) {
        if (method.takes(layout)) names.push_back(method.name);
    }
    return names;
}

/// The document "gnomon.layouts".
io::Json layouts_json() {
    io::Json json = io::document("layouts");
    json["layouts"] = io::Json::array();
    for (const std::string& name : layout_names()) {
        const Layout layout = find_layout(name);
        json["layouts"].push_back({{"name", name},
                                   {"summary", layout.summary},
                                   {"source", layout.source},
                                   {"lossless", layout.lossless},
                                   {"keeps", keeps(layout)},
                                   {"bytes", bytes_formula(layout)},
                                   {"bytes_with_exit", bytes_formula(with_ranges(layout, true))},
                                   {"passes", passes(layout)},
                                   {"methods", methods_of(layout)}});
    }
    return json;
}

void print_layouts() {
    for (const std::string& name : layout_names()) {
        const Layout layout = find_layout(name);
        print_line(name);
        print_line(fmt::format("    {}", layout.summary));
        if (!layout.source.empty()) print_line(fmt::format("    from: {}", layout.source));
        print_line(fmt::format("    keeps {}", keeps(layout)));
        print_line(fmt::format("    bytes: {}", bytes_formula(layout)));
        print_line(fmt::format("    passes: {}", fmt::join(passes(layout), ", ")));
        print_line(fmt::format("    methods: {}", fmt::join(methods_of(layout), ", ")));
    }
}

struct NewOptions {
    std::string folder;
    std::string from = "array";
};

/// Where the string that is the value of the manifest's own member begins and ends, with its quotes; it is there.
std::pair<size_t, size_t> string_member(const std::string& json, std::string_view member) {
    const auto string_end = [&](size_t open) {
        size_t close = open + 1;
        while (json[close] != '"') close += json[close] == '\\' ? 2 : 1;
        return close + 1;
    };
    int depth = 0;
    for (size_t i = 0; i < json.size(); ++i) {
        if (json[i] == '{' || json[i] == '[') ++depth;
        if (json[i] == '}' || json[i] == ']') --depth;
        if (json[i] != '"') continue;
        const size_t end = string_end(i), next = json.find_first_not_of(" \t\r\n", end);
        if (depth == 1 && json[next] == ':' && json.compare(i + 1, end - i - 2, member) == 0) {
            const size_t open = json.find('"', next);
            return {open, string_end(open)};
        }
        i = end - 1;
    }
    throw Error(ErrorKind::internal, "a manifest without " + std::string(member), "layout.json", "report this as a bug");
}

// A copy of another, under a name of its own.
int make_layout(const NewOptions& options) {
    LayoutFiles files = layout_files(options.from);
    const std::filesystem::path folder = std::filesystem::path(options.folder).lexically_normal();
    const std::string name = folder.has_filename() ? folder.filename().string() : folder.parent_path().filename().string();
    std::error_code error;
    if (std::filesystem::exists(folder, error))
        throw Error(ErrorKind::input, "there is something of that name", options.folder, "name a folder that is not there");
    const auto [open, end] = string_member(files.manifest, "name");
    files.manifest.replace(open, end - open, io::Json(name).dump());
    if (!std::filesystem::create_directory(folder, error))
        throw Error(ErrorKind::input, "the folder cannot be made: " + error.message(), options.folder, "name another one");
    io::write_file(folder / "layout.json", files.manifest);
    io::write_file(folder / "layout.glsl", files.glsl);
    print_line(folder.string());
    return kDone;
}

struct CheckOptions {
    std::string layout, device, json;
    bool fail_fast = false;
};

int check(const CheckOptions& options) {
    Renderer renderer(options.device);
    log_device(renderer.device(), !options.device.empty());
    io::Json json = io::document("layout_check");
    json["layout"] = options.layout;
    json["checks"] = io::Json::array();
    int exit_code = kDone;
    check_layout(renderer, options.layout, [&](const LayoutCheck& check) {
        if (options.json != "-") {
            print_line(fmt::format("{:<34} {:<7} {}", check.name, check.passed ? "ok" : "failed", check.text));
            std::cout.flush();  // The next takes seconds, and may be interrupted.
        }
        if (!check.passed) spdlog::error("{} failed: {}", check.name, check.text);
        if (!check.passed) exit_code = kWrongResult;
        json["checks"].push_back({{"name", check.name}, {"passed", check.passed}, {"text", check.text}});
        return check.passed || !options.fail_fast;
    });
    if (!options.json.empty()) write_json(options.json, json);
    return exit_code;
}

}  // namespace

void add_layouts(CLI::App& app, Invocation& invocation) {
    CLI::App* command = add_command(app, invocation, "layouts", "List the layouts of --layout, or begin one");
    auto json = std::make_shared<std::string>();
    command->add_option("--json", *json, "Write it as JSON; - for stdout, instead of the text")->type_name("FILE.json");
    CLI::App* make = add_command(*command, invocation, "new", "Make a folder with a layout of your own, a copy of another");
    auto options = std::make_shared<NewOptions>();
    make->add_option("FOLDER", options->folder, "To be made")->required();
    make->add_option("--from", options->from, "A layout's name, or its folder")
        ->type_name("NAME or FOLDER")
        ->capture_default_str();
    CLI::App* checks =
        add_command(*command, invocation, "check",
                    "Compare all that a layout holds with what was put into it; exit code 9 if\nit is not the same");
    auto check_options = std::make_shared<CheckOptions>();
    checks->add_option("LAYOUT", check_options->layout, "A layout's name, or its folder")->required();
    checks->add_option("--device", check_options->device, "Vulkan device, as of gnomon render")->type_name("NAME");
    checks->add_flag("--fail-fast", check_options->fail_fast, "End with the first check that fails");
    checks->add_option("--json", check_options->json, "Write it as JSON; - for stdout, instead of the text")
        ->type_name("FILE.json");
    command->require_subcommand(0, 1);
    command->callback([&invocation, make, checks, json, options, check_options] {
        invocation.run = [make, checks, json, options, check_options] {
            if (make->parsed()) return make_layout(*options);
            if (checks->parsed()) return check(*check_options);
            if (!json->empty()) write_json(*json, layouts_json());
            if (*json != "-") print_layouts();
            return static_cast<int>(kDone);
        };
    });
}

}  // namespace gnomon::cli
