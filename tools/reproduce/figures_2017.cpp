// SPDX-License-Identifier: Apache-2.0
// Hong and Oh 2017, "Efficient motion blurred shadows using a temporal shadow map", figures 5 to 12.
#include <spdlog/fmt/fmt.h>

#include "reproduce/figure.hpp"
#include "scenes/scene_makers.hpp"

namespace gnomon::reproduce {
namespace {

using Path = std::filesystem::path;

const std::vector<Run> kQualityRuns = {
    {.method = "tsm"},
    {.method = "dtr", .proposed = true},
    {.method = "dtr-analytic", .proposed = true},
    {.method = "exact", .proposed = true},
};

const std::vector<Run> kCubeRuns = {
    {.method = "dtr", .label = "without coverage map"},
    {.method = "temporal", .label = "with coverage map"},
    {.method = "dtr-analytic"},
    {.method = "exact"},
};

Setting character(const std::string& name, uint32_t triangles, uint32_t spp) {
    return {.scene = name,
            .make = [=](const Path& path) { makers::make_character(path, {.triangles = triangles}); },
            .spp = spp,
            .x = static_cast<double>(spp)};
}

Setting of_figure_5(uint32_t spp) { return character("character, 268,000 triangles", 268000, spp); }
Setting of_figure_6(uint32_t spp) { return character("character, 70,000 triangles", 70000, spp); }

// The paper does not say how large its cubes are: small ones move on by several times their side, large ones by less than one.
// All of a size are in one space, that which 5,000 of them fill at speeds in [4, 8]: more cubes are more in each texel.
struct CubeSize {
    std::string name;
    double side;    // Metres; speeds are metres in a shutter.
    double height;  // Of the space.
};

const CubeSize kSmallCubes{"cubes of side 1", 1.0, 98.0};
const CubeSize kLargeCubes{"cubes of side 10", 10.0, 513.0};

Setting cubes(const CubeSize& size, uint32_t count, double speed_min, double speed_max, double x) {
    return {.scene = size.name,
            .make =
                [=](const Path& path) {
                    makers::make_random_cubes(path, {.count = count,
                                                     .size = size.side,
                                                     .speed_min = speed_min,
                                                     .speed_max = speed_max,
                                                     .height = size.height,
                                                     .ground = 1.5});
                },
            .x = x};
}

std::shared_ptr<const Experiment> quality(Setting setting) {
    return std::make_shared<Experiment>(
        Experiment{.settings = {std::move(setting)}, .runs = kQualityRuns, .with_reference = true, .full_maps = true});
}

std::shared_ptr<const Experiment> sample_counts() {
    Experiment series{.runs = kQualityRuns, .axis = "samples per pixel"};
    for (const uint32_t spp : {4, 8, 16, 32}) series.settings.push_back(of_figure_5(spp));
    for (const uint32_t spp : {4, 8, 16, 32}) series.settings.push_back(of_figure_6(spp));
    return std::make_shared<Experiment>(std::move(series));
}

std::shared_ptr<const Experiment> cube_counts() {
    Experiment series{.runs = kCubeRuns, .axis = "cubes"};
    for (const CubeSize& size : {kSmallCubes, kLargeCubes})
        for (const uint32_t count : {1000, 2000, 3000, 4000, 5000})
            series.settings.push_back(cubes(size, count, 4.0, 8.0, count));
    return std::make_shared<Experiment>(std::move(series));
}

std::shared_ptr<const Experiment> cube_speeds() {
    Experiment series{.runs = kCubeRuns, .axis = "metres in a shutter"};
    for (const CubeSize& size : {kSmallCubes, kLargeCubes})
        for (const double least : {0.0, 4.0, 8.0, 12.0, 16.0})
            series.settings.push_back(cubes(size, 5000, least, least + 4.0, least + 2.0));
    return std::make_shared<Experiment>(std::move(series));
}

std::shared_ptr<const Experiment> heat_maps() {
    return std::make_shared<Experiment>(
        Experiment{.settings = {cubes(kLargeCubes, 4000, 4.0, 8.0, 0.0), cubes(kSmallCubes, 4000, 4.0, 8.0, 0.0)},
                   .runs = kCubeRuns,
                   .texel_ranges = true,
                   .full_maps = true});
}

Comparison grows(Metric metric, const std::string& run) {
    return {.left = {metric, run},
            .sign = Comparison::Sign::greater,
            .right = Term{metric, run},
            .where = Comparison::Where::last_to_first};
}

// What the coverage map saves, or costs.
Comparison saves(Metric metric, double factor) {
    return {.left = {metric, "with coverage map"}, .right = Term{metric, "without coverage map", factor}};
}

}  // namespace

std::vector<Figure> figures_2017() {
    const auto samples = sample_counts(), counts = cube_counts(), speeds = cube_speeds();
    const std::string stand_in = "A character stands in for the paper's, 8 samples per pixel.";
    const Claim memory_grows{.quote =
                                 "Graphics memory used for the temporal shadow map in our algorithm is varied from low to "
                                 "high when increasing moving speed of cubes, Figs. 9 and 11.",
                             .source = "Memory and performance",
                             .comparisons = {grows(Metric::map_bytes, "without coverage map")}};
    const Claim memory_saved{.quote = "Using the coverage map massively reduces the memory footprint.",
                             .source = "Memory and performance",
                             .comparisons = {saves(Metric::map_bytes, 0.5)}};
    const Claim time_kept{.quote = "… while remaining the similar rendering time.",
                          .source = "Memory and performance",
                          .comparisons = {saves(Metric::seconds, 1.25)}};
    return {
        {.name = "2017-5",
         .title = "Quality against tsm, first character",
         .shows = stand_in + " The paper gives 268 triangles; 268,000 are taken.",
         .experiment = quality(of_figure_5(8)),
         .plots = {Metric::excess_shadow, Metric::false_shadow, Metric::flip},
         .claims =
             {{.quote = "An image rendered by TSM have self-shadow artifacts and visual artifacts while ours does not.",
               .source = "caption of Fig. 5",
               .comparisons = {{.left = {Metric::excess_shadow, "tsm"}, .sign = Comparison::Sign::greater, .number = 0.005},
                               {.left = {Metric::excess_shadow}, .number = 0.001},
                               {.left = {Metric::false_light}, .number = 0.001}}}}},
        {.name = "2017-6",
         .title = "Quality against tsm, second character",
         .shows = stand_in,
         .experiment = quality(of_figure_6(8)),
         .plots = {Metric::excess_shadow, Metric::false_shadow, Metric::flip},
         .claims = {{.quote = "Our result image has the similar quality with the reference image, while TSM has visual "
                              "artifacts.",
                     .source = "caption of Fig. 6",
                     .comparisons = {{.left = {Metric::error}, .right = Term{Metric::error, "tsm"}},
                                     {.left = {Metric::flip}, .right = Term{Metric::flip, "tsm"}}}}}},
        {.name = "2017-7",
         .title = "Time against samples",
         .shows = "The scenes of Fig. 5 and 6.",
         .experiment = samples,
         .plots = {Metric::seconds, Metric::map_seconds, Metric::test_seconds},
         .stage_plot = true,
         .claims = {{.quote = "As increasing the number samples per pixel, the rendering time in both algorithms increases.",
                     .source = "Evaluation",
                     .comparisons = {grows(Metric::seconds, "tsm"), grows(Metric::seconds, kProposed)}},
                    {.quote = "In the shadow pass, the overhead of draw calls and state changes in TSM is higher than ours.",
                     .source = "Evaluation",
                     .comparisons = {{.left = {Metric::map_seconds}, .right = Term{Metric::map_seconds, "tsm"}}}}}},
        {.name = "2017-8",
         .title = "Ranges per texel",
         .shows = "4,000 cubes of random places and speeds in [4, 8] metres in a shutter. The paper does not say how large "
                  "its cubes are.",
         .experiment = heat_maps(),
         .plots = {Metric::ranges, Metric::map_bytes},
         .claims = {{.quote = "Using the coverage map significantly reduces the total number of visible time ranges stored in "
                              "the temporal shadow map.",
                     .source = "Memory and performance",
                     .comparisons = {saves(Metric::ranges, 0.5)}}}},
        {.name = "2017-9",
         .title = "Memory against the number of cubes",
         .shows = "Cubes of random places and speeds in [4, 8] metres in a shutter, all of a size in one space: more cubes "
                  "are more in each texel. The paper does not say how large its cubes are.",
         .experiment = counts,
         .plots = {Metric::map_bytes, Metric::ranges},
         .claims = {memory_grows, memory_saved}},
        {.name = "2017-10",
         .title = "Time against the number of cubes",
         .shows = "As Fig. 9.",
         .experiment = counts,
         .plots = {Metric::seconds, Metric::map_seconds, Metric::test_seconds},
         .stage_plot = true,
         .claims = {time_kept}},
        {.name = "2017-11",
         .title = "Memory against the speed of cubes",
         .shows = "5,000 cubes. The paper does not give its ranges of speed; here they are 4 metres in a shutter wide.",
         .experiment = speeds,
         .plots = {Metric::map_bytes, Metric::ranges},
         .claims = {memory_grows, memory_saved}},
        {.name = "2017-12",
         .title = "Time against the speed of cubes",
         .shows = "As Fig. 11.",
         .experiment = speeds,
         .plots = {Metric::seconds, Metric::map_seconds, Metric::test_seconds},
         .stage_plot = true,
         .claims = {time_kept}},
    };
}

}  // namespace gnomon::reproduce
