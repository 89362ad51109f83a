// SPDX-License-Identifier: Apache-2.0
#include "bench_artifact.hpp"

#include <spdlog/fmt/fmt.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <gnomon/error.hpp>
#include <gnomon/version.hpp>
#include <nlohmann/json.hpp>

#include "bench_report.hpp"
#include "commit.hpp"
#include "io/atomic_file.hpp"
#include "text/percent_decoded.hpp"
#include "timing/machine.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;

/// From what stands on the command line to the copy in the folder.
using Copies = std::map<std::string, std::string>;

[[noreturn]] void fail(const std::string& what, const fs::path& where, const std::error_code& error) {
    throw Error(ErrorKind::input, what + (error ? ": " + error.message() : ""), where.string(), "name another folder");
}

void copy_into(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    if (!error) fs::copy_file(from, to, error);
    if (error) fail("cannot copy " + from.string(), to, error);
}

/// The scene was loaded: what it names is inside its folder.
void copy_scene(const fs::path& scene, const fs::path& to) {
    copy_into(scene, to / scene.filename());
    std::ifstream file(scene, std::ios::binary);
    const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
    if (json.is_discarded()) return;  // A .glb, most likely with all in it.
    for (const char* part : {"buffers", "images"}) {
        if (!json.contains(part)) continue;
        for (const nlohmann::json& element : json[part]) {
            const std::string uri = element.value("uri", "data:");
            const fs::path name = percent_decoded(uri).value_or(uri);
            if (!uri.starts_with("data:") && !fs::exists(to / name)) copy_into(scene.parent_path() / name, to / name);
        }
    }
}

Copies copy_scenes(const fs::path& folder, const std::vector<std::string>& scenes) {
    Copies copies;
    for (size_t i = 0; i < scenes.size(); ++i) {
        const fs::path to = fs::path("scenes") / std::to_string(i + 1);
        copy_scene(scenes[i], folder / to);
        copies[scenes[i]] = (to / fs::path(scenes[i]).filename()).string();
    }
    return copies;
}

Copies copy_layouts(const fs::path& folder, const std::vector<BenchLayout>& layouts) {
    Copies copies;
    for (const BenchLayout& layout : layouts) {
        if (!fs::is_directory(layout.asked)) continue;
        const fs::path to = fs::path("layouts") / std::to_string(copies.size() + 1);
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(layout.asked)) {
            if (entry.is_regular_file()) copy_into(entry.path(), folder / to / fs::relative(entry.path(), layout.asked));
        }
        copies[layout.asked] = to.string() + "/";
    }
    return copies;
}

std::string quoted(const std::string& text) {
    if (text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,:=+") == std::string::npos)
        return text;
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

std::string replaced(const std::string& names, const Copies& copies) {
    std::string result;
    for (size_t from = 0, to = 0; from <= names.size(); from = to + 1) {
        to = std::min(names.find(',', from), names.size());
        const std::string name = names.substr(from, to - from);
        const auto found = copies.find(name);
        result += (result.empty() ? "" : ",") + (found == copies.end() ? name : found->second);
    }
    return result;
}

/// The command again, of the copies, writing beside itself.
std::string script(const std::vector<std::string>& command, const Copies& scenes, const Copies& layouts) {
    std::string text =
        "#!/bin/sh\n"
        "# Repeats the run of this folder: results are written to again.json and again.csv beside it.\n"
        "# GNOMON=PATH sh run.sh takes another gnomon.\n"
        "cd \"$(dirname \"$0\")\" && \"${GNOMON:-gnomon}\"";
    for (size_t i = 1; i < command.size(); ++i) {
        const std::string& argument = command[i];
        const size_t equals = argument.starts_with("--") ? argument.find('=') : std::string::npos;
        const std::string name = argument.substr(0, equals);
        if (name == "--json" || name == "--csv" || name == "--artifact") {
            i += equals == std::string::npos ? 1 : 0;
        } else if ((name == "--layout" || name == "--baseline") && equals == std::string::npos && i + 1 < command.size()) {
            text += " " + name + " " + quoted(replaced(command[++i], layouts));
        } else if (name == "--layout" || name == "--baseline") {
            text += " " + name + "=" + quoted(replaced(argument.substr(equals + 1), layouts));
        } else {
            const auto scene = scenes.find(argument);
            text += " " + quoted(scene == scenes.end() ? argument : scene->second);
        }
    }
    return text + " --json again.json --csv again.csv\n";
}

std::string system_text(const BenchResults& results) {
    utsname system{};
    uname(&system);
    const DeviceDescription& device = results.device;
    std::string text = fmt::format(
        "date      {}\nhost      {}\nsystem    {} {} {}\nprocessor {}\ngnomon    {}, commit {}, {}\ndevice    {} ({})\n"
        "driver    {}\nVulkan    {}\nmemory    {} bytes\n",
        timing::utc_now(), timing::host_name(), system.sysname, system.release, system.machine, timing::cpu_name(),
        GNOMON_VERSION, kCommit, timing::build_type(), device.name, device.type, device.driver, device.vulkan,
        device.heap_bytes);
    text += fmt::format("copy rate {:.0f} bytes/s\n\nlimits\n", results.copy_bytes_per_second);
    for (const auto& [name, value] : device.limits) text += fmt::format("  {} {}\n", name, value);
    for (const std::string& fault : device.faults) text += "fault: " + fault + "\n";
    return text;
}

std::string citation_text() {
    return fmt::format(
        "cff-version: 1.2.0\nmessage: If you use this software or its results, please cite it as below.\ntype: software\n"
        "title: \"gnomon: motion-blurred shadows in Vulkan compute shaders\"\nversion: \"{}\"\ncommit: \"{}\"\n"
        "license: Apache-2.0\nauthors:\n  - name: The gnomon contributors\n",
        GNOMON_VERSION, kCommit);
}

std::string readme_text(const BenchResults& results, const Copies& scenes, const Copies& layouts) {
    std::string text = fmt::format(
        "# A run of gnomon bench\n\n"
        "gnomon {}, commit {}, on {}.\n\n"
        "| file | |\n| --- | --- |\n"
        "| `run.sh` | the same run again, with the scenes and layouts of this folder: `again.json` and `again.csv` |\n"
        "| `results.json` | all samples, counts and comparisons; Google Benchmark's `compare.py` reads it |\n"
        "| `results.csv` | all samples, one a line, in milliseconds |\n"
        "| `system.txt` | machine, device, driver, limits |\n"
        "| `CITATION.cff` | how to cite gnomon |\n",
        GNOMON_VERSION, kCommit, results.device.name);
    for (const auto& [from, to] : scenes) text += fmt::format("| `{}` | a scene, with its buffers and images |\n", to);
    for (const auto& [from, to] : layouts) text += fmt::format("| `{}` | a layout, of a folder |\n", to);
    text +=
        "\n`sh run.sh` takes the `gnomon` that is on the PATH, `GNOMON=/path/to/gnomon sh run.sh` another one. Counts are the "
        "same again,\n"
        "but for places that layouts give out in the order of arrival; times are compared by\n\n"
        "    compare.py benchmarks results.json again.json\n\n"
        "The figures are made of the results by\n\n    gnomon report results.json -o page.html\n";
    return text;
}

}  // namespace

void check_artifact(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder, error)) fail("there is something of that name", folder, {});
    const fs::path parent = fs::absolute(folder).lexically_normal().parent_path();
    if (!fs::is_directory(parent, error)) fail("there is no folder to make it in", folder, error);
}

void write_artifact(const fs::path& folder, const BenchResults& results, const std::vector<std::string>& scenes) {
    check_artifact(folder);
    fs::path whole = fs::absolute(folder).lexically_normal();
    if (!whole.has_filename()) whole = whole.parent_path();
    const fs::path part = whole.parent_path() / fmt::format(".{}.{}.part", whole.filename().string(), getpid());
    std::error_code error;
    if (!fs::create_directory(part, error)) fail("the folder cannot be made", part, error);
    try {
        const Copies copied_scenes = copy_scenes(part, scenes), copied_layouts = copy_layouts(part, results.layouts);
        io::write_file(part / "results.json", io::to_text(bench_json(results)) + "\n");
        io::write_file(part / "results.csv", bench_csv(results));
        io::write_file(part / "run.sh", script(results.command, copied_scenes, copied_layouts));
        io::write_file(part / "system.txt", system_text(results));
        io::write_file(part / "CITATION.cff", citation_text());
        io::write_file(part / "README.md", readme_text(results, copied_scenes, copied_layouts));
        fs::rename(part, whole, error);
        if (error) fail("the folder cannot be given its name", whole, error);
    } catch (...) {
        fs::remove_all(part, error);
        throw;
    }
}

}  // namespace gnomon::cli
