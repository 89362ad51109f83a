// SPDX-License-Identifier: Apache-2.0
// Wall seconds, and seconds of all cores that this process used.
#pragma once

#include <sys/resource.h>

#include <chrono>

namespace gnomon::timing {

struct Seconds {
    double wall = 0.0;
    double cpu = 0.0;
};

inline Seconds operator-(Seconds a, Seconds b) { return {a.wall - b.wall, a.cpu - b.cpu}; }

/// Since some time in the past: only differences mean anything.
inline Seconds now() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
            seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

}  // namespace gnomon::timing
