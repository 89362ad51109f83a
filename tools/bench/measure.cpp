// SPDX-License-Identifier: Apache-2.0
// One row of the benchmark: a scene at a number of samples, by gnomon and by Embree in turn.
#include "bench/measure.hpp"

#include <gnomon/error.hpp>

#include "reference.hpp"

namespace gnomon::bench {
namespace {

// The frames that one program timed, each in the memory of the one before.
class Timer {
public:
    template <class Render>
    const Frame& time(Render render) {
        const timing::Seconds start = timing::now();
        render(frame_);
        const Frame& frame = frame_;
        cpu_.push_back((timing::now() - start).cpu);
        wall_.push_back(frame.stats.wall_seconds);
        double rest = frame.stats.wall_seconds;
        for (const FrameStats::Stage& stage : frame.stats.stages) rest -= stage.seconds;
        rest_.push_back(rest);
        stages_.push_back(frame.stats.stages);
        return frame;
    }

    const Frame& last() const { return frame_; }
    double last_wall() const { return wall_.back(); }
    double last_cpu() const { return cpu_.back(); }

    Timing timing() const {
        Timing result{timing::summarize(wall_), timing::summarize(cpu_), stages_.front(), timing::summarize(rest_)};
        for (FrameStats::Stage& stage : result.stages) {
            std::vector<double> runs;
            for (const auto& run : stages_) runs.push_back(seconds_of(run, {stage.name}));
            stage.seconds = timing::summarize(runs).median;
        }
        return result;
    }

private:
    Frame frame_;
    std::vector<double> wall_, cpu_, rest_;
    std::vector<std::vector<FrameStats::Stage>> stages_;
};

RenderSettings render_settings(const Settings& settings) {
    RenderSettings result;
    result.width = settings.width;
    result.height = settings.height;
    result.spp = settings.spp;
    result.shadow_res = settings.shadow_res;
    result.pages = settings.pages;
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
    LoadedScene loaded;
    const PeerScene peer_scene(posed.scene, peer.threads);
    const auto gnomon_frame = [&](Frame& frame) { renderer.render(loaded, posed.poses, render, frame); };
    const auto embree_frame = [&](Frame& frame) { trace_peer(peer_scene, posed.poses, peer, row.build, row.rays, frame); };

    notify("load and warm-up");
    row.refusal = refusal_of([&] {
        const timing::Seconds start = timing::now();
        loaded = renderer.load(posed.scene);
        row.load_seconds = (timing::now() - start).wall;
        Frame frame;
        gnomon_frame(frame);
        row.first_seconds = frame.stats.wall_seconds;
    });
    if (!row.refusal.empty()) notify("refused: " + row.refusal);
    notify("trials");
    row.trials = try_variants(peer_scene, posed.poses, peer);
    row.build = fastest(row.trials).build;
    row.rays = fastest(row.trials).rays;

    Timer gnomon, embree;
    std::vector<double> ratios, cpu_ratios;
    for (uint32_t i = 0; i < settings.repeat; ++i) {
        notify("pair " + std::to_string(i + 1) + " of " + std::to_string(settings.repeat));
        if (row.refusal.empty()) row.gnomon_stats = gnomon.time(gnomon_frame).stats;
        embree.time(embree_frame);
        if (!row.refusal.empty()) continue;
        ratios.push_back(embree.last_wall() / gnomon.last_wall());
        cpu_ratios.push_back(embree.last_cpu() / gnomon.last_cpu());
    }
    row.embree = embree.timing();
    row.embree_stats = embree.last().stats;

    notify("counts and agreement");
    const Frame exact = exact_frame(posed, settings);
    row.peer_errors = errors_of(embree.last(), exact);
    if (!row.refusal.empty()) return row;
    row.gnomon = gnomon.timing();
    row.ratio = timing::summarize(ratios);
    row.cpu_ratio = timing::summarize(cpu_ratios);
    render.count_ranges = render.keep_samples = true;
    Frame counted;
    gnomon_frame(counted);
    row.gnomon_stats.counts = counted.stats.counts;
    row.effective = counted.effective;
    row.work = work_of(counted, row.gnomon.stages, renderer.device().type == "cpu" ? settings.threads : 0);
    row.agreement = agreement_of(counted, exact);
    return row;
}

}  // namespace gnomon::bench
