// SPDX-License-Identifier: Apache-2.0
// frame_bench: whole frames of gnomon and of Embree in turn.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <gnomon/error.hpp>
#include <gnomon/version.hpp>
#include <iostream>
#include <thread>

#include "bench/report.hpp"
#include "io/atomic_file.hpp"
#include "tool_main.hpp"

namespace {

using namespace gnomon;

struct Options {
    std::string json, markdown, csv, device;
    std::vector<std::string> scenes = {bench::kDefaultScenes};
    std::vector<uint32_t> spp;
    uint32_t repeat = 3;
    std::string pages = RenderSettings().pages;
    uint32_t threads = std::max(1u, std::thread::hardware_concurrency());
    double scale = 1.0;
};

// Of every group its name and its scenes.
std::string names_by_group() {
    std::string text = "growth: all groups of names with @", last;
    for (const bench::BenchScene& scene : bench::bench_scenes()) {
        text += scene.group == last ? ", " : "\n" + scene.group + ": ";
        text += scene.name;
        last = scene.group;
    }
    return text;
}

void add_options(CLI::App& app, Options& o) {
    app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    app.add_option("--json", o.json, "Everything that was measured; - for stdout")->type_name("FILE.json");
    app.add_option("--markdown", o.markdown, "The tables; they go to stdout otherwise")->type_name("FILE.md");
    app.add_option("--csv", o.csv, "A line of seconds for each row")->type_name("FILE.csv");
    app.add_option("--scenes", o.scenes, "Which scenes or groups of scenes, see below")
        ->delimiter(',')
        ->type_name("NAME,...")
        ->capture_default_str();
    app.footer(names_by_group());
    app.add_option("--spp", o.spp, "Samples per pixel, of all scenes [each has its own]")
        ->delimiter(',')
        ->type_name("N,...")
        ->check(CLI::Range(1, 65536).description(""));
    app.add_option("--scale", o.scale, "Of the sides of image and shadow map; triangles keep their size in pixels")
        ->type_name("F")
        ->check(CLI::Range(0.01, 4.0).description(""))
        ->capture_default_str();
    app.add_option("--pages", o.pages,
                   "Of S-buffers make all pages, or those that hits ask for; auto: asked where lists are long")
        ->type_name("auto|asked|all")
        ->check(CLI::IsMember({"auto", "asked", "all"}).description(""))
        ->capture_default_str();
    app.add_option("--repeat", o.repeat, "Timed pairs of frames")
        ->type_name("N")
        ->check(CLI::Range(1, 1000).description(""))
        ->capture_default_str();
    app.add_option("--threads", o.threads, "Threads of Embree and of lavapipe")
        ->type_name("N")
        ->envname("LP_NUM_THREADS")
        ->check(CLI::Range(1, 1024).description(""))
        ->capture_default_str();
    app.add_option("--device", o.device, "Which Vulkan device [the first hardware device, else a CPU]")
        ->type_name("NAME|INDEX|cpu|gpu");
}

uint32_t scaled(uint32_t side, double scale) { return static_cast<uint32_t>(std::max(1.0, std::round(side * scale))); }

bench::Settings settings_of(const bench::BenchScene& scene, const Options& options) {
    bench::Settings settings;
    settings.width = scaled(scene.width, options.scale);
    settings.height = scaled(scene.height, options.scale);
    settings.shadow_res = scaled(scene.shadow_res, options.scale);
    settings.threads = options.threads;
    settings.repeat = options.repeat;
    settings.pages = options.pages;
    return settings;
}

// After every row, so that an interrupted benchmark leaves what it has measured.
void write_files(const Options& options, const bench::Context& context, const std::vector<bench::Row>& rows) {
    if (!options.json.empty() && options.json != "-") {
        io::write_file(options.json, bench::to_json(context, rows).dump(2) + "\n");
    }
    if (!options.markdown.empty()) io::write_file(options.markdown, bench::to_markdown(context, rows));
    if (!options.csv.empty()) io::write_file(options.csv, bench::to_csv(rows));
}

void run(const Options& options) {
    for (const std::string& file : {options.json, options.markdown, options.csv}) {
        if (!file.empty() && file != "-") io::check_writable(file);
    }
    const std::vector<bench::BenchScene> scenes = bench::choose_scenes(options.scenes);
    // Mesa reads it when the driver is loaded.
    setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
    Renderer renderer(options.device);
    bench::Context context{renderer.device(), {}, options.scale};
    context.settings = settings_of({}, options);
    if (context.device.type != "cpu") {
        std::cerr << "frame_bench: warning: " << context.device.name << " is not a CPU: --threads is for Embree only\n";
    }

    std::vector<bench::Row> rows;
    for (const bench::BenchScene& scene : scenes) {
        const bench::PosedScene posed = bench::make_scene(scene, options.scale);
        bench::Settings settings = settings_of(scene, options);
        for (const uint32_t spp : options.spp.empty() ? scene.spp : options.spp) {
            settings.spp = spp;
            rows.push_back(bench::measure_row(renderer, scene, posed, settings, [&](const std::string& what) {
                std::cerr << "frame_bench: " << scene.name << ", " << spp << " spp: " << what << '\n';
            }));
            write_files(options, context, rows);
        }
    }
    if (options.json == "-") {
        std::cout << bench::to_json(context, rows).dump(2) << '\n';
    } else if (options.markdown.empty()) {
        std::cout << bench::to_markdown(context, rows);
    }
}

}  // namespace

int main(int argc, char** argv) {
    constexpr tools::Tool kTool{"frame_bench", "Times whole frames of gnomon and of an Embree ray tracer in turn.",
                                "use a smaller --scale or fewer --spp"};
    return tools::tool_main(kTool, argc, argv, add_options, run);
}
