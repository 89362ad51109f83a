// SPDX-License-Identifier: Apache-2.0
// The pictures of a report: to be flipped, zoomed and compared (page/viewer.js).
#include "reproduce/viewer.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "html/html.hpp"
#include "reproduce/errors.hpp"
#include "reproduce/picture.hpp"

namespace gnomon::reproduce {
namespace {

using namespace html;

struct Layer {
    std::string name;   // In the page: picture, difference, same, flip.
    std::string title;  // What it shows.
    std::string address;
};

struct Pane {
    std::string name;
    std::string note;
    std::vector<Layer> layers;  // The picture first.
};

struct LayerButton {
    const char* layer;
    const char* key;
    const char* text;
};

std::string button(std::initializer_list<Attribute> attributes, const std::string& key, const std::string& text) {
    return element("button", attributes, element("kbd", key) + " " + escaped(text));
}

std::string image(const std::string& pane, const Layer& layer) {
    return empty_element(
        "img",
        {{"data-layer", layer.name}, {"alt", pane + (layer.title.empty() ? "" : ": " + layer.title)}, {"src", layer.address}});
}

// first: which pane is shown first. flips: the first pane is what the others are flipped against.
std::string viewer(uint32_t width, uint32_t height, const std::vector<Pane>& panes, size_t first, bool flips,
                   const std::vector<LayerButton>& layers) {
    std::string choices, layer_buttons, strip;
    const std::string aspect = fmt::format("--aspect: {} / {}", width, height);
    for (size_t i = 0; i < panes.size(); ++i) {
        choices += button({{"type", "button"}, {"data-image", ""}}, std::to_string(i + 1), panes[i].name);
        std::string images;
        for (const Layer& layer : panes[i].layers) images += image(panes[i].name, layer);
        strip += element("figure", {{"class", "pane"}},
                         element("div", {{"class", "frame"}, {"style", aspect}}, images) +
                             element("figcaption", element("b", escaped(panes[i].name)) + " " + escaped(panes[i].note)));
    }
    for (const LayerButton& layer : layers)
        layer_buttons += button({{"type", "button"}, {"data-layer", layer.layer}}, layer.key, layer.text);
    if (flips) choices += button({{"type", "button"}, {"data-flip", ""}}, "space", "flip to the reference");
    const std::string fit = button({{"type", "button"}, {"data-fit", ""}}, "0", "fit");
    const std::string large = element("div", {{"class", "frame large"}, {"style", aspect}},
                                      empty_element("img", {{"alt", ""}}) + element("span", {{"class", "shown"}}, ""));
    return element("section", {{"class", "viewer"}, {"data-first", std::to_string(first)}},
                   element("div", {{"class", "bar"}}, choices) +
                       element("div", {{"class", "bar"}}, layer_buttons + element("span", {{"class", "gap"}}, "") + fit) +
                       large + element("div", {{"class", "strip"}}, strip)) +
           "\n";
}

std::string metric_note(const RunResult& run, std::initializer_list<Metric> metrics) {
    std::string note;
    for (const Metric metric : metrics) {
        const auto found = run.metrics.find(metric);
        if (found == run.metrics.end()) continue;
        note += (note.empty() ? "" : ", ") + info(metric).title + " " + shown(metric, {found->second.value, 0.0}) +
                (info(metric).unit.name == "%" ? " %" : "");
    }
    return note;
}

}  // namespace

std::string picture_viewer(const Experiment& experiment, const SettingResult& result) {
    const uint32_t width = result.settings.width, height = result.settings.height;
    const auto picture = [](const Frame& frame) { return Layer{"picture", "", picture_of(frame)}; };
    std::vector<Pane> panes = {{"reference", "ray-traced, converged", {picture(result.converged)}},
                               {"ray-traced", "at the samples of the runs", {picture(result.same_samples)}}};
    for (size_t i = 0; i < result.runs.size(); ++i) {
        const RunResult& run = result.runs[i];
        panes.push_back(
            {experiment.runs[i].label,
             metric_note(run, {Metric::flip, Metric::false_shadow, Metric::false_light}),
             {picture(run.frame),
              {"difference", "|difference| to the reference", difference_picture(run.frame, result.converged)},
              {"same", "visibility less that of the ray-traced picture at the same samples; orange: too dark, blue: too bright",
               signed_picture(width, height, visibility_difference(run.frame, result.same_samples))},
              {"flip", "FLIP to the reference", scale_picture(width, height, run.flip)}}});
    }
    return viewer(width, height, panes, 2, true,
                  {{"picture", "p", "picture"},
                   {"difference", "d", "difference to the reference"},
                   {"same", "s", "false shadow and light, same samples"},
                   {"flip", "f", "FLIP"}});
}

std::string heat_map_viewer(const Experiment& experiment, const SettingResult& result) {
    uint32_t most = 1;
    for (const RunResult& run : result.runs)
        for (const auto& light : run.frame.texel_ranges)
            for (const uint32_t count : light) most = std::max(most, count);
    std::vector<Pane> panes;
    for (size_t i = 0; i < result.runs.size(); ++i) {
        const RunResult& run = result.runs[i];
        if (run.frame.texel_ranges.empty() || run.frame.texel_ranges[0].empty()) continue;
        const std::vector<uint32_t>& counts = run.frame.texel_ranges[0];
        std::vector<double> shares(counts.size());
        std::transform(counts.begin(), counts.end(), shares.begin(),
                       [&](uint32_t count) { return std::log1p(count) / std::log1p(most); });
        const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
        const std::string note = fmt::format("{:.2f} ranges per texel, at most {}", sum / static_cast<double>(counts.size()),
                                             *std::max_element(counts.begin(), counts.end()));
        panes.push_back({experiment.runs[i].label,
                         note,
                         {{"picture", note, scale_picture(result.settings.shadow_res, result.settings.shadow_res, shares)}}});
    }
    if (panes.empty()) return "";
    const std::string ramp = element("div", {{"class", "ramp"}},
                                     "0 " + element("i", {{"style", "background: " + scale_gradient()}}, "") +
                                         fmt::format(" {} ranges per texel, logarithmic", most));
    return ramp + viewer(result.settings.shadow_res, result.settings.shadow_res, panes, 0, false, {});
}

}  // namespace gnomon::reproduce
