// SPDX-License-Identifier: Apache-2.0
// `gnomon sbuffer`: what is in the S-buffer that `gnomon render --dump-sbuffer` wrote, and whether it is sound.
#include <spdlog/fmt/fmt.h>

#include <memory>

#include "command.hpp"
#include "io/sbuffer_check.hpp"

namespace gnomon::cli {

namespace {

using io::Json;

/// Bounds of a bin of the histogram.
uint64_t least_of(size_t bin) { return bin == 0 ? 0 : uint64_t{1} << (bin - 1); }
uint64_t most_of(size_t bin) { return bin == 0 ? 0 : (uint64_t{1} << bin) - 1; }

/// The document "gnomon.sbuffer". settings: the text attributes of the file's header that are gnomon's.
Json sbuffer_json(const io::SBufferFile& file, const io::SBufferSummary& s) {
    Json json = io::document("sbuffer");
    json["file"] = file.path().string();
    json["settings"] = Json::object();
    for (const auto& [name, value] : file.attributes())
        if (name.starts_with("gnomon:")) json["settings"][name.substr(7)] = value;
    json["width"] = file.width();
    json["height"] = file.height();
    json["exit_depths"] = file.exit_depths();
    json["texels"] = s.texels;
    json["texels_with_ranges"] = s.texels_with;
    json["ranges"] = s.ranges;
    json["triangles"] = s.triangles;
    json["ranges_per_texel"] = {{"mean", static_cast<double>(s.ranges) / static_cast<double>(s.texels)},
                                {"max", s.most},
                                {"max_at", {s.most_x, s.most_y}}};
    json["histogram"] = Json::array();
    for (size_t i = 0; i < s.histogram.size(); ++i)
        json["histogram"].push_back({{"from", least_of(i)}, {"to", most_of(i)}, {"texels", s.histogram[i]}});
    const bool any = s.ranges > 0;
    json["time"] = any ? Json{s.enter, s.exit} : Json(nullptr);
    json["depth"] = any ? Json{s.nearest, s.farthest} : Json(nullptr);
    json["bytes"] = {{"file", s.file_bytes}, {"ranges", s.range_bytes}};
    return json;
}

void print_sbuffer(const io::SBufferFile& file, const io::SBufferSummary& s) {
    const auto attribute = [&](const std::string& name) {
        const auto found = file.attributes().find("gnomon:" + name);
        return found == file.attributes().end() ? std::string("?") : found->second;
    };
    print_row("of", fmt::format("{}, light {}, method {}, raster {}, layout {}", attribute("scene"), attribute("light"),
                                attribute("effective.method"), attribute("effective.raster"), attribute("effective.layout")));
    print_row("texels",
              fmt::format("{} x {}, {} faces; {} have ranges", file.width(), file.height(), attribute("faces"), s.texels_with));
    print_row("ranges", fmt::format("{} of triangles up to number {}, depths at the {}", s.ranges,
                                    s.triangles > 0 ? s.triangles - 1 : 0, file.exit_depths() ? "entry and exit" : "entry"));
    print_row("per texel",
              fmt::format("{:.4g} mean, {} at most, in texel {},{}",
                          static_cast<double>(s.ranges) / static_cast<double>(s.texels), s.most, s.most_x, s.most_y));
    if (s.ranges > 0) {
        print_row("time", fmt::format("{:.6g} to {:.6g} of the shutter", s.enter, s.exit));
        print_row("depth", fmt::format("{:.6g} to {:.6g} m", s.nearest, s.farthest));
    }
    print_row("bytes", fmt::format("{} in the file, {} without compression", s.file_bytes, s.range_bytes));
    for (size_t i = 0; i < s.histogram.size(); ++i) {
        const std::string bounds = i < 2 ? std::to_string(least_of(i)) : fmt::format("{} to {}", least_of(i), most_of(i));
        print_row(i == 0 ? "histogram" : "",
                  fmt::format("{:>15} ranges: {:>10} texels, {:6.2f} %", bounds, s.histogram[i],
                              100.0 * static_cast<double>(s.histogram[i]) / static_cast<double>(s.texels)));
    }
    print_row("checked", "times, depths, triangles and their order: all is sound");
}

}  // namespace

void add_sbuffer(CLI::App& app, Invocation& invocation) {
    struct Options {
        std::string file;
        std::string json;
    };
    CLI::App* command = add_command(app, invocation, "sbuffer",
                                    "Say what is in an S-buffer of 'render --dump-sbuffer', and check every range of it");
    auto options = std::make_shared<Options>();
    command->add_option("FILE", options->file, "Deep image, .exr")->required()->type_name("");
    command->add_option("--json", options->json, "Write it as JSON; - for stdout, instead of the text")->type_name("FILE.json");
    command->callback([&invocation, options] {
        invocation.run = [options] {
            const io::SBufferFile file(options->file);
            const io::SBufferSummary summary = io::check_sbuffer(file);
            if (!options->json.empty()) write_json(options->json, sbuffer_json(file, summary));
            if (options->json != "-") print_sbuffer(file, summary);
            return static_cast<int>(kDone);
        };
    });
}

}  // namespace gnomon::cli
