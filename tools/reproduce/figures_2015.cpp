// SPDX-License-Identifier: Apache-2.0
// Andersson et al. 2015, "Filtered Stochastic Shadow Mapping using a Layered Approach", figures 9 and 11 to 15.
#include "reproduce/figure.hpp"
#include "scenes/scene_makers.hpp"

namespace gnomon::reproduce {
namespace {

using Path = std::filesystem::path;

// bias: metres; of a spot's map the methods' own is that of the far end of the scene.
std::vector<Run> quality_runs(std::optional<double> bias) {
    std::map<std::string, double> parameters;
    if (bias) parameters["bias"] = *bias;
    return {
        {.method = "tsm", .parameters = parameters},
        {.method = "tsm-dynamic-bias", .parameters = parameters},
        {.method = "dsm", .parameters = parameters},
        {.method = "fssm", .parameters = {{"tile", 4.0}}, .proposed = true},
        {.method = "exact"},
    };
}

// Fig. 9, insets A to C.
const std::vector<Run> kInsets = {
    {.method = "tsm"},
    {.method = "fssm", .proposed = true},
    {.method = "fssm", .parameters = {{"layers", 3.0}}, .label = "fssm, 3 layers"},
    {.method = "fssm", .parameters = {{"neighbours", 0.0}}, .label = "fssm, no neighbours"},
    {.method = "fssm", .parameters = {{"tent", 0.0}}, .label = "fssm, no tent"},
    {.method = "exact"},
};

// tsm with the samples of fssm, then with more on larger and larger maps, until it takes as long.
const std::vector<Run> kEqualRuns = {
    {.method = "fssm", .proposed = true},
    {.method = "tsm-dynamic-bias", .curve = "tsm"},
    {.method = "tsm-dynamic-bias", .parameters = {{"map-spp", 8.0}}, .label = "tsm, 8 samples", .curve = "tsm"},
    {.method = "tsm-dynamic-bias",
     .parameters = {{"map-spp", 8.0}},
     .label = "tsm, 8, map × 1.5",
     .map_scale = 1.5,
     .curve = "tsm"},
    {.method = "tsm-dynamic-bias",
     .parameters = {{"map-spp", 8.0}},
     .label = "tsm, 8, map × 2",
     .map_scale = 2.0,
     .curve = "tsm"},
    {.method = "tsm-dynamic-bias",
     .parameters = {{"map-spp", 16.0}},
     .label = "tsm, 16, map × 2",
     .map_scale = 2.0,
     .curve = "tsm"},
    {.method = "exact"},
};

// The paper times no method that forgets the time of its samples.
const std::vector<Run> kTimedRuns = {
    {.method = "tsm"},
    {.method = "tsm-dynamic-bias"},
    {.method = "fssm", .proposed = true},
    {.method = "exact"},
};

Setting setting(const std::string& scene, std::function<void(const Path&)> make, uint32_t shadow_res) {
    return {.scene = scene, .make = std::move(make), .width = 1280, .height = 720, .shadow_res = shadow_res, .spp = 4};
}

// Section 6: 4 samples per pixel, maps of 512 texels.
std::shared_ptr<const Experiment> difficult(const std::string& scene, std::function<void(const Path&)> make,
                                            std::optional<double> bias = {}, uint32_t segments = 1) {
    Experiment quality{.settings = {setting(scene, std::move(make), 512)},
                       .runs = quality_runs(bias),
                       .with_reference = true,
                       .full_maps = true};
    quality.settings[0].segments = segments;
    return std::make_shared<Experiment>(std::move(quality));
}

// Section 6: 4 samples per pixel, maps of 1024 texels.
std::vector<Setting> rich_scenes() {
    return {setting(
                "wrecking ball, 8,000 triangles", [](const Path& path) { makers::make_wrecking_ball(path); }, 1024),
            setting(
                "chess", [](const Path& path) { makers::make_chess(path); }, 1024),
            setting(
                "runner in a hall, 262,000 triangles", [](const Path& path) { makers::make_runner(path); }, 1024),
            setting(
                "tree, moving light", [](const Path& path) { makers::make_tree(path); }, 1024)};
}

Setting octopus(const std::string& name, uint32_t camera) {
    Setting seen = setting(
        name, [](const Path& path) { makers::make_octopus(path); }, 1024);
    seen.camera = camera;
    return seen;
}

std::shared_ptr<const Experiment> against_reference(std::vector<Setting> settings, std::vector<Run> runs) {
    return std::make_shared<Experiment>(
        Experiment{.settings = std::move(settings), .runs = std::move(runs), .with_reference = true, .full_maps = true});
}

const std::string kOctopus = "octopus", kAbove = "octopus from above";

// by: what is wrong in the same places for all seeds, or what is wrong in one frame.
Claim worse(const std::string& quote, const std::string& run, Metric by, const std::string& scene) {
    return {.quote = quote,
            .source = "caption of Fig. 9",
            .comparisons = {{.left = {by, run}, .sign = Comparison::Sign::greater, .right = Term{by, "fssm"}, .scene = scene}}};
}

const Comparison kDynamicBiasIsBetter{.left = {Metric::error, "tsm-dynamic-bias"}, .right = Term{Metric::error, "tsm"}};

}  // namespace

std::vector<Figure> figures_2015() {
    constexpr auto kGreater = Comparison::Sign::greater;
    const Claim dynamic_bias{.quote = "We will show how this adjustment improves image quality of TSM.",
                             .source = "section 5.1",
                             .comparisons = {kDynamicBiasIsBetter}};
    const Claim less_noise{
        .quote = "At equal samples per pixel and shadow resolution, our algorithm has considerably less noise.",
        .source = "section 6",
        .comparisons = {{.left = {Metric::noise}, .right = Term{Metric::noise, "tsm-dynamic-bias", 0.75}}}};
    return {
        {.name = "2015-9",
         .title = "Parts of the method switched off",
         .shows = "Shadows of an octopus' arms, 4 samples per pixel. Insets A to C leave out a layer, the choice of "
                  "neighbours, and the filter across fast motion. Each is asked about where its part has work: four layers "
                  "lie above each other in the whole octopus, and tiles' borders and fast arms are seen from above.",
         .experiment = against_reference({octopus(kOctopus, 0), octopus(kAbove, 1)}, kInsets),
         .plots = {Metric::systematic, Metric::noise, Metric::flip},
         .claims =
             {worse("In inset (A), we have reduced the number of maximum layers from 4 to 3 […], with an incorrect shadow as "
                    "the result.",
                    "fssm, 3 layers", Metric::systematic, kOctopus),
              worse("Inset (B) shows our algorithm without the stochastic neighbor selection enabled, leading to visible tile "
                    "boundaries.",
                    "fssm, no neighbours", Metric::systematic, kAbove),
              worse("In inset (C), the v-direction filter for large motion is disabled, with some streaking artifacts as a "
                    "consequence.",
                    "fssm, no tent", Metric::error, kAbove)}},
        {.name = "2015-11",
         .title = "Pillars below a moving light",
         .shows = "The light moves up and away from pillars that stand still. The turn of the light is cut into 4 linear "
                  "pieces.",
         .experiment = difficult(
             "pillars", [](const Path& path) { makers::make_pillars(path, {.rising = true}); }, 0.08, 4),
         .plots = {Metric::systematic, Metric::noise, Metric::flip},
         .claims = {{.quote = "DSM does not account for moving light sources either, and get severe self-shadowing artifacts.",
                     .source = "caption of Fig. 11",
                     .comparisons = {{.left = {Metric::excess_shadow, "dsm"}, .sign = kGreater, .number = 0.05}}},
                    dynamic_bias,
                    less_noise}},
        {.name = "2015-12",
         .title = "Two quads that cross",
         .shows = "Two quads at two depths move fast and at right angles to each other over a plane.",
         .experiment = difficult("crossing quads", [](const Path& path) { makers::make_crossing_quads(path); }),
         .plots = {Metric::systematic, Metric::noise, Metric::flip},
         .claims =
             {{.quote = "TSM [is] able to capture the diagonal shadow stripe that appears on the green, moving receiver, "
                        "whereas DSM does not.",
               .source = "caption of Fig. 12",
               .comparisons =
                   {{.left = {Metric::false_light, "dsm"}, .sign = kGreater, .right = Term{Metric::false_light, "tsm", 2.0}},
                    {.left = {Metric::systematic, "dsm"}, .sign = kGreater, .right = Term{Metric::systematic, "tsm", 2.0}}}},
              less_noise}},
        {.name = "2015-13",
         .title = "Two quads toward and away from a light",
         .shows = "One quad moves toward a spot light and the other away from it, by more than their height over the plane.",
         .experiment = difficult(
             "receding quads", [](const Path& path) { makers::make_receding_quads(path); }, 0.05),
         .plots = {Metric::excess_shadow, Metric::systematic, Metric::noise},
         .claims = {{.quote = "With our dynamic bias from Section 5.1, TSM does not exhibit self-shadowing artifacts.",
                     .source = "caption of Fig. 13",
                     .comparisons = {{.left = {Metric::excess_shadow, "tsm-dynamic-bias"}, .number = 0.001},
                                     {.left = {Metric::excess_shadow, "tsm-dynamic-bias"},
                                      .right = Term{Metric::excess_shadow, "tsm", 0.5}}}},
                    {.quote =
                         "The bias in DSM cannot be fixed with an increased bias value, since the movement of the quads is "
                         "larger than the gap between them and the ground plane.",
                     .source = "caption of Fig. 13",
                     .comparisons = {{.left = {Metric::excess_shadow, "dsm"}, .sign = kGreater, .number = 0.005}}},
                    dynamic_bias,
                    less_noise}},
        {.name = "2015-14",
         .title = "Equal samples and equal time",
         .shows = "4 samples per pixel, maps of 1024 texels. Scenes of the same kind stand in for the paper's. For equal "
                  "time tsm has up to four times the samples and larger maps.",
         .experiment = against_reference(rich_scenes(), kEqualRuns),
         .plots = {Metric::noise, Metric::systematic},
         .claims = {{.quote = "Our algorithm has significantly less noise compared to time-dependent shadow maps (TSM).",
                     .source = "caption of Fig. 14",
                     .comparisons = {{.left = {Metric::noise}, .right = Term{Metric::noise, "tsm-dynamic-bias", 0.75}}}},
                    {.quote =
                         "For low complexity scenes, such as Wrecking ball (8k tris), TSM achieves slightly better quality at "
                         "equal time.",
                     .source = "section 6",
                     .comparisons = {{.left = {Metric::error},
                                      .sign = kGreater,
                                      .right = Term{.metric = Metric::error, .run = "tsm", .at_time_of = kProposed},
                                      .scene = "wrecking ball, 8,000 triangles"}}},
                    {.quote =
                         "At higher polygon counts, the cost of stochastic rasterization is non-negligible, and our algorithm "
                         "produces better quality shadows at equal time. This is visible in the Sponza runner scene.",
                     .source = "section 6",
                     .comparisons = {{.left = {Metric::error},
                                      .right = Term{.metric = Metric::error, .run = "tsm", .at_time_of = kProposed},
                                      .scene = "runner in a hall, 262,000 triangles"}}}}},
        {.name = "2015-15",
         .title = "Times per stage",
         .shows = "4 samples per pixel, maps of 1024 texels. Scenes of the same kind stand in for the paper's.",
         .experiment = std::make_shared<Experiment>(Experiment{.settings = rich_scenes(), .runs = kTimedRuns}),
         .stage_plot = true,
         .claims = {{.quote = "Although we store motion vectors when rendering from the light (visibility sampling), the cost "
                              "for that step is very similar for both algorithms.",
                     .source = "section 6",
                     .comparisons = {{.left = {Metric::map_seconds, "tsm-dynamic-bias"},
                                      .right = Term{Metric::map_seconds, "tsm", 1.25}}}},
                    {.quote = "However, the shadow lookup and shading pass are more expensive with our algorithm as we perform "
                              "filtering in this step.",
                     .source = "section 6",
                     .comparisons =
                         {{.left = {Metric::test_seconds}, .sign = kGreater, .right = Term{Metric::test_seconds, "tsm"}}}}}},
    };
}

}  // namespace gnomon::reproduce
