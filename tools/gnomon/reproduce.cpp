// SPDX-License-Identifier: Apache-2.0
// `gnomon reproduce`: the papers' figures, rendered and measured again.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <gnomon/error.hpp>
#include <iostream>
#include <map>
#include <memory>

#include "command.hpp"
#include "io/atomic_file.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "reproduce/report.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;
using namespace gnomon::reproduce;

struct ReproduceOptions {
    std::vector<std::string> names;
    fs::path folder;
    MeasureOptions measure{.scale = 0.5};
    std::string device;
    bool list = false;
};

std::vector<const Figure*> chosen_figures(const std::vector<std::string>& names) {
    std::vector<const Figure*> chosen;
    for (const std::string& name : names) {
        if (name != "all") {
            chosen.push_back(&find_figure(name));
            continue;
        }
        for (const Figure& figure : figures()) chosen.push_back(&figure);
    }
    return chosen;
}

void print_list() {
    for (const Figure& figure : figures()) {
        std::string runs;
        for (const Run& run : figure.experiment->runs) runs += (runs.empty() ? "" : ", ") + run.label;
        std::cout << fmt::format("{:<9} {}\n          {}\n          {}\n", figure.name, figure.title, figure.shows, runs);
    }
}

// Figures that show the same experiment share its measurements.
double total_samples(const std::vector<const Figure*>& chosen, const MeasureOptions& options) {
    std::vector<const Experiment*> seen;
    double sum = 0.0;
    for (const Figure* figure : chosen) {
        const Experiment* experiment = figure->experiment.get();
        if (std::find(seen.begin(), seen.end(), experiment) != seen.end()) continue;
        seen.push_back(experiment);
        sum += sample_count(*experiment, options);
    }
    return sum;
}

void print_claims(const FigureReport& report, const fs::path& file) {
    print_line(fmt::format("{}: {}", report.figure.name, file.string()));
    for (const ClaimResult& claim : report.claims)
        std::cout << fmt::format("    {:<14} {}{}\n", to_text(claim.verdict), claim.run.empty() ? "" : claim.run + ": ",
                                 claim.quote);
    std::cout << std::flush;
}

int reproduce_figures(const ReproduceOptions& options, bool quiet) {
    const std::vector<const Figure*> chosen = chosen_figures(options.names);
    std::error_code error;
    fs::create_directories(options.folder, error);
    if (error)
        throw Error(ErrorKind::input, "cannot make the folder: " + error.message(), options.folder.string(),
                    "choose another -o");
    io::check_writable(options.folder / "index.html");
    Renderer renderer(options.device);
    log_device(renderer.device(), !options.device.empty());

    const double total = total_samples(chosen, options.measure);
    double done = 0.0;
    ProgressBar bar(total, quiet);
    const SamplesDone samples_done = [&](double samples) {
        done += samples;
        bar.update(done / total);
    };
    std::map<const Experiment*, ExperimentResult> measured;
    std::vector<IndexEntry> entries;
    for (const Figure* figure : chosen) {
        const Experiment* experiment = figure->experiment.get();
        if (!measured.contains(experiment)) {
            measured.emplace(experiment, measure(renderer, *experiment, options.measure, samples_done));
            bar.erase();
        }
        FigureReport report{*figure, measured.at(experiment), {}, options.measure, renderer.device().name};
        report.claims = check_claims(*figure, report.result);
        const fs::path file = options.folder / (figure->name + ".html");
        io::write_file(options.folder / (figure->name + ".json"), io::to_text(to_json(report)) + "\n");
        io::write_file(file, to_html(report));
        print_claims(report, file);
        // After each figure, so that an interrupted run leads to what it has made.
        entries.push_back({figure->name, figure->title, figure->shows, paper_of(figure->name), report.claims});
        if (chosen.size() > 1)
            io::write_file(options.folder / "index.html", index_html(entries, options.measure, renderer.device().name));
    }
    return kDone;
}

}  // namespace

void add_reproduce(CLI::App& app, Invocation& invocation) {
    CLI::App* command = add_command(app, invocation, "reproduce", "Render and measure the papers' figures, as pages to read");
    auto options = std::make_shared<ReproduceOptions>();
    command->add_option("FIGURE", options->names, "Which: all, or names of --list")->type_name("");
    command->add_flag("--list", options->list, "List the figures, what each shows, and its methods");
    command->add_option("-o,--output", options->folder, "Folder for FIGURE.html and FIGURE.json")->type_name("FOLDER");
    command
        ->add_option_function<std::string>(
            "--scale",
            [options](const std::string& text) { options->measure.scale = parse_number(text, "--scale", 0.01, 4.0); },
            "Of the sides of pictures, and of maps where times are compared; 1: the papers' sizes")
        ->type_name("F")
        ->default_str("0.5");
    command
        ->add_option_function<std::string>(
            "--repeat",
            [options](const std::string& text) { options->measure.repeat = parse_count(text, "--repeat", 3, 1000); },
            "Frames of each run, 3 or more, with seeds of their own")
        ->type_name("N")
        ->default_str("3");
    command
        ->add_option_function<std::string>(
            "--reference-spp",
            [options](const std::string& text) {
                options->measure.reference_spp = parse_count(text, "--reference-spp", 1, 65536);
            },
            "Samples per pixel of the reference")
        ->type_name("N")
        ->default_str("128");
    command->add_option("--device", options->device, "Which Vulkan device [the first hardware device, else a CPU]")
        ->type_name("NAME|INDEX|cpu|gpu");
    command->callback([&invocation, options] {
        invocation.run = [&invocation, options] {
            if (options->list) {
                print_list();
                return static_cast<int>(kDone);
            }
            if (options->names.empty())
                throw Error(ErrorKind::usage, "no figure is named", "FIGURE",
                            "use all, or names that 'gnomon reproduce --list' gives");
            if (options->folder.empty())
                throw Error(ErrorKind::usage, "no folder for the reports", "-o", "give one: -o FOLDER");
            return reproduce_figures(*options, invocation.quiet);
        };
    });
}

}  // namespace gnomon::cli
