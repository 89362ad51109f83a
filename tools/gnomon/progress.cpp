// SPDX-License-Identifier: Apache-2.0
// A progress bar on stderr.
#include "progress.hpp"

#include <spdlog/fmt/fmt.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::cli {

std::string progress_text(double share, double seconds, double total_samples) {
    constexpr int kCells = 24;
    share = std::clamp(share, 0.0, 1.0);
    const int full = static_cast<int>(share * kCells);
    std::string text = fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %", "", full, "", kCells - full, std::floor(share * 100.0));
    if (share > 0.0 && seconds > 0.0) {
        const auto left = static_cast<long>(std::ceil(seconds * (1.0 - share) / share));
        text += fmt::format("  {:.3g} Msamples/s", share * total_samples / seconds * 1e-6);
        text += left < 3600 ? fmt::format("  {}:{:02} left", left / 60, left % 60)
                            : fmt::format("  {}:{:02}:{:02} left", left / 3600, left / 60 % 60, left % 60);
    }
    return text;
}

ProgressBar::ProgressBar(double total_samples, bool quiet)
    : total_samples_(total_samples), enabled_(!quiet && ::isatty(STDERR_FILENO) != 0) {}

void ProgressBar::update(double share) {
    const Clock::time_point now = Clock::now();
    if (!enabled_ || now - last_draw_ < std::chrono::milliseconds(100)) return;
    last_draw_ = now;
    drawn_ = true;
    std::string text = progress_text(share, std::chrono::duration<double>(now - start_).count(), total_samples_);
    // A line that wraps could not be overwritten.
    winsize window{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0)
        text.resize(std::min<size_t>(text.size(), window.ws_col - 1u));
    std::fprintf(stderr, "\r%s\x1b[K", text.c_str());
}

void ProgressBar::erase() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
    drawn_ = false;
}

}  // namespace gnomon::cli
