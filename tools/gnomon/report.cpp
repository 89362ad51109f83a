// SPDX-License-Identifier: Apache-2.0
// `gnomon report`: what `gnomon bench` has measured, as a page, as figures and as tables.
#include <filesystem>
#include <gnomon/error.hpp>
#include <iostream>
#include <memory>
#include <set>

#include "command.hpp"
#include "html/plot.hpp"
#include "io/atomic_file.hpp"
#include "report/report_page.hpp"
#include "report/tables.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;
using namespace gnomon::report;

constexpr size_t kMostFiles = 16;

struct ReportOptions {
    std::vector<std::string> files;
    std::string page;
    std::string svg;
    std::string csv;
    std::string markdown;
    std::string latex;
};

void make_folder(const fs::path& folder, const std::string& option) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw Error(ErrorKind::input, "cannot make the folder: " + error.message(), folder.string(),
                    "choose another " + option);
}

void write_text(const std::string& target, const std::string& text) {
    if (target == "-")
        std::cout << text;
    else
        io::write_file(target, text);
}

void write_figures(const fs::path& folder, const std::vector<Section>& sections) {
    std::set<std::string> taken;
    for (const Section& section : sections) {
        for (const FigureGroup& group : section.groups) {
            for (const Figure& figure : group.figures) {
                // Scenes may differ in characters that the names of files do not have.
                std::string name = figure.name;
                for (int i = 2; !taken.insert(name).second; ++i) name = figure.name + "-" + std::to_string(i);
                io::write_file(folder / (name + ".svg"), html::svg_file(figure.plot));
            }
        }
    }
}

int report(const ReportOptions& options) {
    if (options.page.empty() && options.svg.empty() && options.csv.empty() && options.markdown.empty() && options.latex.empty())
        throw Error(ErrorKind::usage, "nothing is to be written", "command line",
                    "give -o, --svg, --csv, --markdown or --latex");
    if (options.files.size() > kMostFiles)
        throw Error(ErrorKind::usage, "there are more than " + std::to_string(kMostFiles) + " files", "command line",
                    "give fewer");
    if (!options.page.empty()) io::check_writable(options.page);
    std::vector<BenchFile> files;
    for (const std::string& path : options.files) files.push_back(read_bench_file(path));
    label_files(files);

    if (!options.page.empty() || !options.svg.empty()) {
        const std::vector<Section> sections = sections_of(files);
        if (!options.page.empty()) io::write_file(options.page, to_html(files, sections));
        if (!options.svg.empty()) {
            make_folder(options.svg, "--svg");
            write_figures(options.svg, sections);
        }
    }
    const std::vector<DataTable> tables = all_tables(files);
    if (!options.csv.empty()) make_folder(options.csv, "--csv");
    std::string markdown, latex;
    for (const DataTable& table : tables) {
        if (!options.csv.empty()) io::write_file(fs::path(options.csv) / (table.name + ".csv"), table.csv());
        markdown += table.markdown();
        latex += table.latex();
    }
    if (!options.markdown.empty()) write_text(options.markdown, markdown);
    if (!options.latex.empty()) write_text(options.latex, latex);
    return kDone;
}

}  // namespace

void add_report(CLI::App& app, Invocation& invocation) {
    CLI::App* command =
        add_command(app, invocation, "report", "Make a page, figures and tables of what gnomon bench has measured");
    auto options = std::make_shared<ReportOptions>();
    command->add_option("FILES", options->files, "What gnomon bench --json has written, of one or several devices")
        ->required()
        ->type_name("");
    command->add_option("-o,--output", options->page, "The page, which needs no other file")->type_name("FILE.html");
    command->add_option("--svg", options->svg, "Each figure alone")->type_name("FOLDER");
    command->add_option("--csv", options->csv, "Each table alone, numbers in full")->type_name("FOLDER");
    command->add_option("--markdown", options->markdown, "The tables; - for stdout")->type_name("FILE.md");
    command->add_option("--latex", options->latex, "The tables, for booktabs; - for stdout")->type_name("FILE.tex");
    command->callback([&invocation, options] { invocation.run = [options] { return report(*options); }; });
}

}  // namespace gnomon::cli
