// SPDX-License-Identifier: Apache-2.0
// `gnomon bench`: layouts against each other, in turn, on one device.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <gnomon/error.hpp>
#include <iostream>
#include <memory>

#include "bench_artifact.hpp"
#include "bench_measure.hpp"
#include "bench_options.hpp"
#include "bench_report.hpp"
#include "command.hpp"
#include "copy_rate.hpp"
#include "io/atomic_file.hpp"
#include "methods/method.hpp"
#include "progress.hpp"

namespace gnomon::cli {

namespace {

void check_options(const BenchOptions& options) {
    if (options.scenes.empty() && options.synthetic.empty())
        throw Error(ErrorKind::usage, "there is nothing to measure", "command line", "name a SCENE or use --synthetic");
    const std::string& method = options.render.settings.method;
    if (!find_method(method).has_s_buffer())
        throw Error(ErrorKind::usage, "method " + method + " has no S-buffer, whatever the layout", "--method",
                    "use one that has, see 'gnomon methods'");
    const std::string& json = options.render.json;
    if (!json.empty() && json != "-") {
        check_ending(json, ".json", "--json");
        io::check_writable(json);
    }
    if (!options.csv.empty()) {
        check_ending(options.csv, ".csv", "--csv");
        io::check_writable(options.csv);
    }
    if (!options.artifact.empty()) check_artifact(options.artifact);
}

std::vector<BenchScene> load_scenes(const BenchOptions& options, const std::vector<BenchGroup>& points) {
    std::vector<double> speeds;
    for (const BenchGroup& point : points) speeds.push_back(point.speed);
    std::vector<BenchScene> scenes;
    const auto add = [&](BenchScene scene, const std::string& path) {
        const auto same = [&](const BenchScene& other) { return other.name == scene.name; };
        if (std::any_of(scenes.begin(), scenes.end(), same)) scene.name = path;
        if (std::any_of(scenes.begin(), scenes.end(), same))
            throw Error(ErrorKind::usage, "the scene " + path + " is named twice", "command line", "name it once");
        scenes.push_back(std::move(scene));
    };
    for (const std::string& path : options.scenes) add(scene_of_file(path, options.render, speeds), path);
    for (const Synthetic& synthetic : options.synthetic)
        add(scene_of(synthetic, options.render.settings.seed), synthetic.name());
    return scenes;
}

void add_cases(BenchGroup& group, const BenchScene& scene, const std::vector<BenchLayout>& layouts) {
    group.scene = scene.name;
    group.settings.camera = scene.camera;
    for (const BenchLayout& layout : layouts) {
        const std::string axes = axes_text(group.axes, "/");
        BenchCase& added = group.cases.emplace_back();
        added.layout = layout;
        added.name = scene.name + "/" + layout.name + (layout.again ? " (again)" : "") + (axes.empty() ? "" : "/" + axes);
    }
}

class Run {
public:
    Run(const BenchOptions& options, const std::vector<std::string>& command, bool quiet)
        : options_(options), points_(bench_points(options)), layouts_(bench_layouts(options)), quiet_(quiet) {
        results_.command = command;
        results_.repetitions = options.limits.repetitions;
        results_.seed = options.render.settings.seed;
        results_.axes = options.axes;
        results_.settings = options.render.settings;
        for (const BenchLayout& layout : layouts_) {
            if (!layout.again) results_.layouts.push_back(layout);
        }
    }

    int run() {
        const std::vector<BenchScene> scenes = load_scenes(options_, points_);
        const std::string& device = options_.render.device;
        Renderer renderer(device, options_.render.validate);
        log_device(renderer.device(), !device.empty());
        results_.device = renderer.device();
        results_.copy_bytes_per_second = copy_rate(device);

        for (const BenchScene& scene : scenes) {
            for (BenchGroup group : points_) {
                add_cases(group, scene, layouts_);
                results_.groups.push_back(std::move(group));
            }
        }
        ProgressBar bar(all_samples(), quiet_);
        size_t next = 0;
        for (const BenchScene& scene : scenes) {
            const LoadedScene loaded = renderer.load(scene.scene);
            for (size_t i = 0; i < points_.size(); ++i) measure(renderer, scene, loaded, results_.groups[next++], bar);
        }
        if (options_.render.json == "-") write_json("-", bench_json(results_));
        if (!options_.artifact.empty()) {
            write_artifact(options_.artifact, results_, options_.scenes);
            spdlog::info("wrote {}", options_.artifact);
        }
        return exit_code();
    }

private:
    double all_samples() const {
        double samples = 0.0;
        for (const BenchGroup& group : results_.groups)
            samples += static_cast<double>(frames_of(group, options_.limits)) * samples_of(group);
        return samples;
    }

    static double samples_of(const BenchGroup& group) {
        return static_cast<double>(group.settings.width) * group.settings.height * group.settings.spp;
    }

    void measure(Renderer& renderer, const BenchScene& scene, const LoadedScene& loaded, BenchGroup& group, ProgressBar& bar) {
        const double all = all_samples();
        measure_group(renderer, scene, loaded, options_.limits, group,
                      {[&](double frames) { bar.update((done_ + frames * samples_of(group)) / all); },
                       [&](const std::string& text) {
                           bar.erase();
                           spdlog::warn("{}", text);
                       }});
        done_ += static_cast<double>(frames_of(group, options_.limits)) * samples_of(group);
        bar.erase();
        if (options_.render.json != "-") {
            print_group(results_, group);
            std::cout.flush();
        }
        if (!group.cases.front().skipped.empty())
            spdlog::warn("{}: nothing is compared, since the baseline is left out", group.text());
        // So that a run that is interrupted leaves what it has measured.
        const std::string& json = options_.render.json;
        if (!json.empty() && json != "-") write_json(json, bench_json(results_));
        if (!options_.csv.empty()) io::write_file(options_.csv, bench_csv(results_));
    }

    int exit_code() const {
        const BenchCase* first_skipped = nullptr;
        bool any = false, wrong = false, lost = false;
        for (const BenchGroup& group : results_.groups) {
            for (const BenchCase& measured : group.cases) {
                if (!measured.layout.compared) continue;
                any = any || measured.skipped.empty();
                if (!measured.skipped.empty() && first_skipped == nullptr) first_skipped = &measured;
                wrong = wrong || measured.same_picture == false;
                const auto found = measured.counts.find("lost");
                lost = lost || (found != measured.counts.end() && found->second > 0.0);
            }
        }
        if (!any)
            throw Error(first_skipped->skipped_as, "nothing could be measured: " + first_skipped->skipped, first_skipped->name,
                        "choose other layouts or values");
        return wrong ? kWrongResult : lost ? kLostEntries : kDone;
    }

    const BenchOptions& options_;
    std::vector<BenchGroup> points_;
    std::vector<BenchLayout> layouts_;
    bool quiet_;
    BenchResults results_;
    double done_ = 0.0;  ///< Samples.
};

}  // namespace

void add_bench(CLI::App& app, Invocation& invocation) {
    CLI::App* command = add_command(app, invocation, "bench",
                                    "Measure S-buffer layouts against each other, in turn: what making and asking an S-buffer\n"
                                    "takes, with paired ratios and confidence intervals");
    auto options = std::make_shared<BenchOptions>();
    bind_bench_options(*command, *options);
    command->callback([&invocation, options] {
        invocation.run = [&invocation, options] {
            check_options(*options);
            return Run(*options, invocation.arguments, invocation.quiet).run();
        };
    });
}

}  // namespace gnomon::cli
