// SPDX-License-Identifier: Apache-2.0
// One row of the benchmark: a scene at a number of samples, by gnomon and by Embree in turn.
#include "bench/measure.hpp"

#include <gnomon/error.hpp>

#include "reference.hpp"

namespace gnomon::bench {
namespace {

// The frames that one program timed.
class Timer {
public:
    template <class Render>
    Frame time(Render render) {
        const Seconds start = now();
        Frame frame = render();
        cpu_.push_back((now() - start).cpu);
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

PeerSettings peer_settings(const Settings& settings) {
    PeerSettings result;
    result.width = settings.width;
    result.height = settings.height;
    result.spp = settings.spp;
    result.threads = settings.threads;
    return result;
}

Frame exact_frame(const PosedScene& posed, const Settings& settings) {
    ReferenceSettings reference;
    reference.width = settings.width;
    reference.height = settings.height;
    reference.spp = settings.spp;
    reference.threads = settings.threads;
    reference.keep_samples = true;
    return trace_reference(posed.scene, posed.poses, reference);
}

// Why it made none; empty where it did.
template <class Render>
std::string refusal_of(Render render) {
    try {
        render();
        return {};
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::out_of_memory) throw;
        return error.what();
    }
}

}  // namespace

Row measure_row(Renderer& renderer, const BenchScene& scene, const PosedScene& posed, const Settings& settings,
                const Notify& notify) {
    Row row;
    row.scene = scene.name;
    row.group = scene.group;
    row.value = scene.value;
    row.settings = settings;
    RenderSettings render = render_settings(settings);
    const PeerSettings peer = peer_settings(settings);
    const auto gnomon_frame = [&] { return renderer.render(posed.scene, posed.poses, render); };
    const auto embree_frame = [&] { return trace_peer(posed.scene, posed.poses, peer, row.build, row.rays); };

    notify("warm-up");
    row.refusal = refusal_of(gnomon_frame);
    if (!row.refusal.empty()) notify("refused: " + row.refusal);
    notify("trials");
    row.trials = try_variants(posed, peer);
    row.build = fastest(row.trials).build;
    row.rays = fastest(row.trials).rays;

    Timer gnomon, embree;
    std::vector<double> ratios, cpu_ratios;
    Frame picture;
    for (uint32_t i = 0; i < settings.repeat; ++i) {
        notify("pair " + std::to_string(i + 1) + " of " + std::to_string(settings.repeat));
        if (row.refusal.empty()) row.gnomon_stats = gnomon.time(gnomon_frame).stats;
        picture = embree.time(embree_frame);
        if (!row.refusal.empty()) continue;
        ratios.push_back(embree.last_wall() / gnomon.last_wall());
        cpu_ratios.push_back(embree.last_cpu() / gnomon.last_cpu());
    }
    row.embree = embree.timing();
    row.embree_stats = picture.stats;

    notify("counts and agreement");
    const Frame exact = exact_frame(posed, settings);
    row.peer_errors = errors_of(picture, exact);
    if (!row.refusal.empty()) return row;
    row.gnomon = gnomon.timing();
    row.ratio = summarize(ratios);
    row.cpu_ratio = summarize(cpu_ratios);
    render.count_ranges = render.keep_samples = true;
    const Frame counted = gnomon_frame();
    row.gnomon_stats.counts = counted.stats.counts;
    row.effective = counted.effective;
    row.work = work_of(counted, row.gnomon.stages, renderer.device().type == "cpu" ? settings.threads : 0);
    row.agreement = agreement_of(counted, exact);
    return row;
}

}  // namespace gnomon::bench
