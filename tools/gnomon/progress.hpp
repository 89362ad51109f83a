// SPDX-License-Identifier: Apache-2.0
// A progress bar on stderr.
#pragma once

#include <chrono>
#include <string>

namespace gnomon::cli {

/// The text of the bar: share done (0 to 1), samples per second, time left.
std::string progress_text(double share, double seconds, double total_samples);

/// Draws on a terminal only, at most ten times a second, and leaves nothing behind.
class ProgressBar {
public:
    ProgressBar(double total_samples, bool quiet);
    ~ProgressBar() { erase(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void update(double share);

    /// To be called before anything else is written to stderr.
    void erase();

private:
    using Clock = std::chrono::steady_clock;

    double total_samples_;
    bool enabled_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_draw_ = start_;
};

}  // namespace gnomon::cli
