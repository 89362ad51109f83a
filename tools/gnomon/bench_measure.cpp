// SPDX-License-Identifier: Apache-2.0
#include "bench_measure.hpp"

#include <spdlog/fmt/fmt.h>

#include <cstring>
#include <gnomon/error.hpp>

#include "bench_counts.hpp"
#include "timing/clocks.hpp"

namespace gnomon::cli {

namespace {

bool same_bits(const std::vector<Channel>& a, const std::vector<Channel>& b) {
    if (a.size() != b.size()) return false;
    for (size_t c = 0; c < a.size(); ++c) {
        const std::vector<float>&x = a[c].values, &y = b[c].values;
        if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) != 0) return false;
    }
    return true;
}

class Measurement {
public:
    Measurement(Renderer& renderer, const BenchScene& scene, const LoadedScene& loaded, const BenchLimits& limits,
                BenchGroup& group, const BenchWatch& watch)
        : renderer_(renderer),
          loaded_(loaded),
          limits_(limits),
          group_(group),
          watch_(watch),
          poses_(scene.poses(scene.scene, group.speed, group.time_steps)),
          frames_(group.cases.size()) {}

    void run() {
        for (size_t i = 0; i < group_.cases.size(); ++i) warm_up(i);
        for (uint32_t repetition = 0; repetition < limits_.repetitions; ++repetition) {
            for (size_t i = 0; i < group_.cases.size(); ++i) measure(i);
        }
        for (size_t i = 0; i < group_.cases.size(); ++i) count(i);
    }

private:
    RenderSettings settings_of(const BenchCase& measured) const {
        RenderSettings settings = group_.settings;
        settings.layout = measured.layout.asked;
        return settings;
    }

    void skip(BenchCase& measured, const std::string& reason, ErrorKind kind) {
        measured.skipped = reason;
        measured.skipped_as = kind;
        measured.samples.clear();
        watch_.warn(measured.name + " is left out: " + reason);
    }

    // Nothing, where the case is left out from now on.
    bool render(size_t i) {
        BenchCase& measured = group_.cases[i];
        const timing::Seconds start = timing::now();
        bool stopped = false;
        const auto spent = [&] { return measured.seconds + (timing::now() - start).wall; };
        try {
            renderer_.render(loaded_, poses_, settings_of(measured), frames_[i], [&](double share) {
                watch_.progress(done_ + share);
                stopped = limits_.timeout > 0.0 && spent() > limits_.timeout;
                return !stopped;
            });
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::out_of_memory && error.kind() != ErrorKind::usage) throw;
            skip(measured, error.what(), error.kind());
            return false;
        }
        measured.seconds = spent();
        if (stopped)
            skip(measured, fmt::format("its frames took more than the {:g} s of --timeout", limits_.timeout), ErrorKind::usage);
        return !stopped;
    }

    void warm_up(size_t i) {
        BenchCase& measured = group_.cases[i];
        if (render(i) && measured.layout.lossless) {
            if (picture_.empty()) picture_ = frames_[i].channels;
            measured.same_picture = same_bits(picture_, frames_[i].channels);
            if (!*measured.same_picture)
                watch_.warn(
                    measured.name +
                    ": not the picture of the first lossless layout, though it is said to be lossless; see 'gnomon layouts "
                    "check'");
        }
        ++done_;
    }

    void measure(size_t i) {
        BenchCase& measured = group_.cases[i];
        const double before = timing::now().cpu;
        if (measured.skipped.empty() && render(i)) {
            for (const auto& [metric, milliseconds] : metrics_of(frames_[i].stats, timing::now().cpu - before))
                measured.samples[metric].push_back(milliseconds);
        }
        ++done_;
    }

    void count(size_t i) {
        BenchCase& measured = group_.cases[i];
        if (measured.skipped.empty() && measured.layout.again) {
            measured.counts = group_.cases.front().counts;
        } else if (measured.skipped.empty()) {
            try {
                count_case(renderer_, loaded_, poses_, settings_of(measured), frames_[i], i == 0, measured);
            } catch (const Error& error) {
                if (error.kind() != ErrorKind::out_of_memory) throw;
                watch_.warn(measured.name + ": not everything is counted: " + error.what());
            }
        }
        watch_.progress(++done_);
    }

    Renderer& renderer_;
    const LoadedScene& loaded_;
    const BenchLimits& limits_;
    BenchGroup& group_;
    const BenchWatch& watch_;
    std::vector<Pose> poses_;
    std::vector<Frame> frames_;     ///< Of each case the last one, in whose memory the next is made.
    std::vector<Channel> picture_;  ///< Of the first lossless layout.
    double done_ = 0.0;
};

}  // namespace

uint32_t frames_of(const BenchGroup& group, const BenchLimits& limits) {
    return static_cast<uint32_t>(group.cases.size()) * (limits.repetitions + 2);
}

void measure_group(Renderer& renderer, const BenchScene& scene, const LoadedScene& loaded, const BenchLimits& limits,
                   BenchGroup& group, const BenchWatch& watch) {
    Measurement(renderer, scene, loaded, limits, group, watch).run();
}

}  // namespace gnomon::cli
