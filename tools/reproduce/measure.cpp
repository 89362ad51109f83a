// SPDX-License-Identifier: Apache-2.0
// Renders an experiment and measures it.
#include "reproduce/measure.hpp"

#include <algorithm>
#include <cmath>

#include "io/perceived_error.hpp"
#include "reference.hpp"
#include "reproduce/errors.hpp"
#include "scenes/posed_scene.hpp"

namespace gnomon::reproduce {
namespace {

uint32_t scaled(uint32_t side, double scale) { return static_cast<uint32_t>(std::max(8.0, std::round(side * scale))); }

RenderSettings render_settings(const Experiment& experiment, const Setting& setting, double scale) {
    return {.width = scaled(setting.width, scale),
            .height = scaled(setting.height, scale),
            .spp = setting.spp,
            .camera = setting.camera,
            .shadow_res = experiment.full_maps ? setting.shadow_res : scaled(setting.shadow_res, scale)};
}

RenderSettings settings_of(const RenderSettings& settings, const Run& run) {
    RenderSettings result = settings;
    result.method = run.method;
    result.parameters = run.parameters;
    result.shadow_res = scaled(settings.shadow_res, run.map_scale);
    return result;
}

ReferenceSettings reference_settings(const RenderSettings& settings) {
    // Fast motion traces faster in more segments; the picture is the same.
    return {.width = settings.width,
            .height = settings.height,
            .spp = settings.spp,
            .seed = settings.seed,
            .camera = settings.camera,
            .embree_segments = 8};
}

double sample_count(const RenderSettings& settings) { return double(settings.width) * settings.height * settings.spp; }

// A count that frames have for each light that has it.
std::optional<double> over_lights(const Frame& frame, const std::string& name) {
    std::optional<double> sum;
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        const auto found = frame.stats.counts.find(name + "." + std::to_string(light));
        if (found != frame.stats.counts.end()) sum = sum.value_or(0.0) + static_cast<double>(found->second);
    }
    return sum;
}

// The frames of one run, seed by seed.
class RunMeasurement {
public:
    void add(Frame frame, const SettingResult& setting, const Frame* same_samples) {
        double seconds = 0.0, map_seconds = 0.0, test_seconds = 0.0;
        for (const FrameStats::Stage& stage : frame.stats.stages) {
            seconds += stage.seconds;
            map_seconds += stage.map_seconds;
            if (stage.name == "sample/shadow") test_seconds += stage.seconds;
            const auto [at, is_new] = stages_.try_emplace(stage.name);
            if (is_new) order_.push_back(stage.name);
            at->second.first.push_back(stage.seconds);
            at->second.second.push_back(stage.map_seconds);
        }
        values_[Metric::seconds].push_back(seconds);
        values_[Metric::map_seconds].push_back(map_seconds);
        values_[Metric::test_seconds].push_back(test_seconds);
        for (const Metric metric : {Metric::map_bytes, Metric::ranges})
            if (const auto count = over_lights(frame, info(metric).key)) values_[metric].push_back(*count);
        if (const auto fragments = over_lights(frame, "fragments")) {
            const double texels = double(setting.settings.shadow_res) * setting.settings.shadow_res * frame.light_count;
            values_[Metric::equation_2].push_back(*fragments * 16.0 + values_[Metric::ranges].back() * 24.0 + texels * 8.0);
        }
        if (same_samples != nullptr) {
            const FalseShare share = false_share(frame, *same_samples);
            values_[Metric::false_shadow].push_back(share.shadow);
            values_[Metric::false_light].push_back(share.light);
            values_[Metric::excess_shadow].push_back(share.shadow - share.light);
            statistics_.add(frame);
            std::vector<double> flip = flip_of(frame, setting.converged);
            values_[Metric::flip].push_back(mean(flip));
            if (result_.flip.empty()) result_.flip = std::move(flip);
        }
        frame.samples = {};
        frame.sample_visibility = {};
        if (result_.frame.channels.empty()) result_.frame = std::move(frame);
    }

    RunResult result(const SettingResult& setting) {
        for (const auto& [metric, values] : values_) result_.metrics[metric] = estimate(values);
        result_.by_seed = values_;
        if (values_.contains(Metric::flip)) {
            result_.squares = {{Metric::error, statistics_.error(setting.converged)},
                               {Metric::noise, statistics_.noise()},
                               {Metric::systematic, statistics_.systematic(setting.converged)}};
            for (const auto& [metric, squares] : result_.squares)
                result_.metrics[metric] = root_of(over_seeds(squares, setting.settings.width));
        }
        for (const std::string& name : order_) {
            const auto& [seconds, map_seconds] = stages_.at(name);
            result_.stages.push_back({name, estimate(seconds), estimate(map_seconds)});
        }
        return std::move(result_);
    }

private:
    RunResult result_;
    std::map<Metric, std::vector<double>> values_;
    std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> stages_;
    std::vector<std::string> order_;  // In which the stages ran first.
    VisibilityStatistics statistics_;
};

// Programs are compiled and memory is touched before anything is timed.
void warm_up(Renderer& renderer, const makers::PosedScene& posed, RenderSettings settings) {
    settings.width = std::max(8u, settings.width / 8);
    settings.height = std::max(8u, settings.height / 8);
    settings.shadow_res = std::max(8u, settings.shadow_res / 8);
    renderer.render(posed.scene, posed.poses, settings);
}

}  // namespace

double sample_count(const Experiment& experiment, const MeasureOptions& options) {
    double sum = 0.0;
    for (const Setting& setting : experiment.settings) {
        const double samples = sample_count(render_settings(experiment, setting, options.scale));
        sum += samples * options.repeat * static_cast<double>(experiment.runs.size() + (experiment.with_reference ? 1 : 0));
        if (experiment.with_reference) sum += samples / setting.spp * options.reference_spp;
    }
    return sum;
}

ExperimentResult measure(Renderer& renderer, const Experiment& experiment, const MeasureOptions& options,
                         const SamplesDone& done) {
    ExperimentResult result;
    for (const Setting& setting : experiment.settings) {
        const makers::PosedScene posed = makers::make_posed(setting.make, setting.segments);
        SettingResult& at = result.settings.emplace_back();
        at.settings = render_settings(experiment, setting, options.scale);
        at.triangles = posed.scene.triangles.size();
        const auto trace = [&](ReferenceSettings reference) { return trace_reference(posed.scene, posed.poses, reference); };
        if (experiment.with_reference) {
            ReferenceSettings converged = reference_settings(at.settings);
            converged.spp = options.reference_spp;
            converged.seed = options.repeat;  // None of the runs'.
            at.converged = trace(converged);
            done(double(converged.width) * converged.height * converged.spp);
        }
        std::vector<RunMeasurement> runs(experiment.runs.size());
        for (const Run& run : experiment.runs) warm_up(renderer, posed, settings_of(at.settings, run));
        for (uint32_t seed = 0; seed < options.repeat; ++seed) {
            RenderSettings settings = at.settings;
            settings.seed = seed;
            settings.keep_samples = experiment.with_reference;
            Frame same_samples;
            if (experiment.with_reference) {
                ReferenceSettings reference = reference_settings(settings);
                reference.keep_samples = true;
                same_samples = trace(reference);
                done(sample_count(settings));
            }
            for (size_t i = 0; i < runs.size(); ++i) {
                double reported = 0.0;
                Frame frame =
                    renderer.render(posed.scene, posed.poses, settings_of(settings, experiment.runs[i]), [&](double share) {
                        done((share - reported) * sample_count(settings));
                        reported = share;
                        return true;
                    });
                runs[i].add(std::move(frame), at, experiment.with_reference ? &same_samples : nullptr);
            }
            if (seed == 0) {
                same_samples.samples = {};
                at.same_samples = std::move(same_samples);
            }
        }
        for (size_t i = 0; i < runs.size(); ++i) {
            at.runs.push_back(runs[i].result(at));
            if (!experiment.texel_ranges) continue;
            RenderSettings settings = settings_of(at.settings, experiment.runs[i]);
            settings.keep_texel_ranges = true;
            at.runs.back().frame.texel_ranges = renderer.render(posed.scene, posed.poses, settings).texel_ranges;
        }
    }
    return result;
}

}  // namespace gnomon::reproduce
