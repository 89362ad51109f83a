// SPDX-License-Identifier: Apache-2.0
// One row of the benchmark: a scene at a number of samples, by gnomon and by the reference in turn.
#include "bench/measure.hpp"

#include <sys/resource.h>

#include <algorithm>

#include "reference.hpp"

namespace gnomon::bench {
namespace {

// Embree is at its best with 1 where motion is slow and with 8 where it is fast.
constexpr uint32_t kTriedSegments[] = {1, 8};

double process_cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// The frames that one program timed.
class Timer {
public:
    template <class Render>
    Frame time(Render render) {
        const double before = process_cpu_seconds();
        Frame frame = render();
        cpu_.push_back(process_cpu_seconds() - before);
        wall_.push_back(frame.stats.wall_seconds);
        double rest = frame.stats.wall_seconds;
        for (const FrameStats::Stage& stage : frame.stats.stages) rest -= stage.seconds;
        rest_.push_back(rest);
        stages_.push_back(frame.stats.stages);
        return frame;
    }

    double last_wall() const { return wall_.back(); }
    double last_cpu() const { return cpu_.back(); }

    Timing timing() const {
        Timing result{summarize(wall_), summarize(cpu_), stages_.front(), summarize(rest_)};
        for (FrameStats::Stage& stage : result.stages) {
            std::vector<double> runs;
            for (const auto& run : stages_) runs.push_back(seconds_of(run, {stage.name}));
            stage.seconds = summarize(runs).median;
        }
        return result;
    }

private:
    std::vector<double> wall_, cpu_, rest_;
    std::vector<std::vector<FrameStats::Stage>> stages_;
};

RenderSettings render_settings(const Settings& settings) {
    RenderSettings result;
    result.width = settings.width;
    result.height = settings.height;
    result.spp = settings.spp;
    result.shadow_res = settings.shadow_res;
    return result;
}

ReferenceSettings reference_settings(const Settings& settings) {
    ReferenceSettings result;
    result.width = settings.width;
    result.height = settings.height;
    result.spp = settings.spp;
    result.threads = settings.threads;
    result.exact = false;
    return result;
}

}  // namespace

Row measure_row(Renderer& renderer, const std::string& name, const PosedScene& posed, const Settings& settings,
                const Notify& notify) {
    Row row;
    row.scene = name;
    row.settings = settings;
    RenderSettings render = render_settings(settings);
    ReferenceSettings reference = reference_settings(settings);
    const auto gnomon_frame = [&] { return renderer.render(posed.scene, posed.poses, render); };
    const auto embree_frame = [&] { return trace_reference(posed.scene, posed.poses, reference); };

    notify("warm-up");
    gnomon_frame();
    for (const uint32_t segments : kTriedSegments) {
        notify("Embree with " + std::to_string(segments) + (segments == 1 ? " segment" : " segments"));
        reference.embree_segments = segments;
        row.trials.push_back({segments, embree_frame().stats.wall_seconds});
    }
    row.embree_segments = std::min_element(row.trials.begin(), row.trials.end(), [](const Trial& a, const Trial& b) {
                              return a.wall_seconds < b.wall_seconds;
                          })->segments;
    reference.embree_segments = row.embree_segments;

    Timer gnomon, embree;
    std::vector<double> ratios, cpu_ratios;
    for (uint32_t i = 0; i < settings.repeat; ++i) {
        notify("pair " + std::to_string(i + 1) + " of " + std::to_string(settings.repeat));
        row.gnomon_stats = gnomon.time(gnomon_frame).stats;
        row.embree_stats = embree.time(embree_frame).stats;
        ratios.push_back(embree.last_wall() / gnomon.last_wall());
        cpu_ratios.push_back(embree.last_cpu() / gnomon.last_cpu());
    }
    row.gnomon = gnomon.timing();
    row.embree = embree.timing();
    row.ratio = summarize(ratios);
    row.cpu_ratio = summarize(cpu_ratios);

    notify("counts and agreement");
    render.count_ranges = render.keep_samples = true;
    reference.exact = reference.keep_samples = true;
    const Frame counted = gnomon_frame();
    row.gnomon_stats.counts = counted.stats.counts;
    row.effective = counted.effective;
    row.work = work_of(counted, row.gnomon.stages, renderer.device().type == "cpu" ? settings.threads : 0);
    row.agreement = agreement_of(counted, embree_frame());
    return row;
}

}  // namespace gnomon::bench
