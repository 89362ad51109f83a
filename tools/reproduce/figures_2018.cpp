// SPDX-License-Identifier: Apache-2.0
// Hong and Oh 2018, "Motion-Blurred Shadows Utilizing a Depth-Time Ranges Shadow Map", figures 9 to 12.
#include "reproduce/figure.hpp"
#include "scenes/scene_makers.hpp"

namespace gnomon::reproduce {
namespace {

using Path = std::filesystem::path;

Setting two_cubes(uint32_t spp) {
    return {.scene = "two cubes",
            .make = [](const Path& path) { makers::make_two_cubes(path, {.triangles = 6000, .ground = 10.0}); },
            .spp = spp,
            .x = static_cast<double>(spp)};
}

Setting character(uint32_t spp) {
    return {.scene = "character, 265,000 triangles",
            .make = [](const Path& path) { makers::make_character(path, {.triangles = 265000}); },
            .spp = spp,
            .x = static_cast<double>(spp)};
}

const std::vector<Run> kRuns = {
    {.method = "tsm"},
    {.method = "tsm-dynamic-bias"},
    {.method = "dtr", .proposed = true},
    {.method = "dtr-analytic", .proposed = true},
    {.method = "exact", .proposed = true},
};

// The paper names no bias. Methods that compare depths have one here, if not told otherwise.
std::vector<Run> quality_runs() {
    std::vector<Run> runs = kRuns;
    runs.push_back({.method = "tsm", .parameters = {{"bias", 0.0}}, .label = "tsm, no bias"});
    runs.push_back({.method = "dtr", .parameters = {{"bias", 0.0}}, .label = "dtr, no bias", .proposed = true});
    return runs;
}

std::shared_ptr<const Experiment> quality(Setting setting) {
    return std::make_shared<Experiment>(
        Experiment{.settings = {std::move(setting)}, .runs = quality_runs(), .with_reference = true, .full_maps = true});
}

std::shared_ptr<const Experiment> sample_counts() {
    Experiment series{.runs = kRuns, .axis = "samples per pixel"};
    for (const uint32_t spp : {4, 8, 16, 32}) series.settings.push_back(two_cubes(spp));
    for (const uint32_t spp : {4, 8, 16, 32}) series.settings.push_back(character(spp));
    return std::make_shared<Experiment>(std::move(series));
}

std::vector<Claim> no_self_shadow(const std::string& caption) {
    const auto tsm = [&](const std::string& bias, const std::string& run) {
        return Claim{
            .quote = "The images rendered by TSM contain severe self-shadow artifacts …",
            .source = caption + bias,
            .comparisons = {{.left = {Metric::excess_shadow, run}, .sign = Comparison::Sign::greater, .number = 0.01}}};
    };
    return {tsm(", without a bias", "tsm, no bias"),
            tsm(", with a bias", "tsm"),
            {.quote = "… while those rendered by our method do not.",
             .source = caption,
             .comparisons = {{.left = {Metric::excess_shadow}, .number = 0.001}}}};
}

}  // namespace

std::vector<Figure> figures_2018() {
    using enum Comparison::Where;
    constexpr auto kGreater = Comparison::Sign::greater;
    const auto series = sample_counts();
    return {
        {.name = "2018-9",
         .title = "Quality against tsm, two cubes",
         .shows = "Two cubes of 6,000 triangles each move toward the light, 8 samples per pixel. The ground is small: the "
                  "light's map holds it all.",
         .experiment = quality(two_cubes(8)),
         .plots = {Metric::excess_shadow, Metric::false_shadow, Metric::flip},
         .claims = no_self_shadow("caption of Fig. 9")},
        {.name = "2018-10",
         .title = "Quality against tsm, character",
         .shows = "A character of 265,000 triangles, 20 samples per pixel. Its leg moves toward the light.",
         .experiment = quality(character(20)),
         .plots = {Metric::excess_shadow, Metric::false_shadow, Metric::flip},
         .claims = no_self_shadow("caption of Fig. 10")},
        {.name = "2018-11",
         .title = "Times per stage against samples",
         .shows = "The scenes of Fig. 9 and 10: the paper's text names one, its caption the other.",
         .experiment = series,
         .plots = {Metric::seconds, Metric::map_seconds, Metric::test_seconds},
         .stage_plot = true,
         .claims = {{.quote = "As the number of samples per pixel increases, TSM becomes increasingly slower compared to our "
                              "algorithm.",
                     .source = "section 5, Performance",
                     .comparisons = {{.left = {.metric = Metric::seconds, .run = "tsm", .over_run = kProposed},
                                      .sign = kGreater,
                                      .right = Term{.metric = Metric::seconds, .run = "tsm", .over_run = kProposed},
                                      .where = last_to_first}}},
                    {.quote = "Our algorithm performs the shadow pass faster than TSM.",
                     .source = "section 5, Performance",
                     .comparisons = {{.left = {Metric::map_seconds}, .right = Term{Metric::map_seconds, "tsm"}}}},
                    {.quote = "In general, the more samples per pixel, the slower the model performance.",
                     .source = "section 5, Performance",
                     .comparisons = {{.left = {Metric::seconds},
                                      .sign = kGreater,
                                      .right = Term{Metric::seconds},
                                      .where = last_to_first}}},
                    {.quote = "The shadow test in our algorithm takes more time than that in TSM.",
                     .source = "section 5, Performance",
                     .comparisons =
                         {{.left = {Metric::test_seconds}, .sign = kGreater, .right = Term{Metric::test_seconds, "tsm"}}}}}},
        {.name = "2018-12",
         .title = "Memory against samples",
         .shows = "Bytes of what the shadow tests read, for the scenes of Fig. 9 and 10.",
         .experiment = series,
         .plots = {Metric::map_bytes, Metric::equation_2},
         .claims = {{.quote = "The required memory for the shadow map in our algorithm depends on scene complexity, while that "
                              "for TSM depends on the number of samples per pixel.",
                     .source = "section 5, Memory",
                     .comparisons = {{.left = {Metric::map_bytes},
                                      .right = Term{.metric = Metric::map_bytes, .factor = 1.001},
                                      .where = last_to_first},
                                     {.left = {Metric::map_bytes, "tsm"},
                                      .sign = kGreater,
                                      .right = Term{.metric = Metric::map_bytes, .run = "tsm", .factor = 1.5},
                                      .where = last_to_first}}},
                    {.quote = "Memory = N_f * fragment_size + N_r * range_size + 2 * screen_resolution * 4.",
                     .source = "section 5, eq. 2, against what is allocated",
                     .comparisons = {{.left = {Metric::map_bytes, "dtr"}, .right = Term{Metric::equation_2, "dtr", 1.0001}},
                                     {.left = {Metric::map_bytes, "dtr"},
                                      .sign = kGreater,
                                      .right = Term{Metric::equation_2, "dtr", 0.9999}}}}}},
    };
}

}  // namespace gnomon::reproduce
