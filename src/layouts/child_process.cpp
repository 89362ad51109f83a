// SPDX-License-Identifier: Apache-2.0
#include "layouts/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <gnomon/error.hpp>
#include <new>

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kNoMemory = 3;  // Exit codes of the child.
constexpr int kThrew = 4;

uint64_t address_space() {
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit(int resource, uint64_t value) {
    rlimit both{};
    getrlimit(resource, &both);
    both.rlim_cur = std::min<rlim_t>(value, both.rlim_max);
    setrlimit(resource, &both);
}

[[noreturn]] void work_in_child(const std::function<std::string()>& work, const ChildLimits& limits, int out, uint64_t bytes) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, static_cast<uint64_t>(limits.seconds.count()));
    if (bytes > 0) limit(RLIMIT_AS, bytes);
    try {
        const std::string result = work();
        for (size_t at = 0; at < result.size();) {
            const ssize_t written = write(out, result.data() + at, result.size() - at);
            if (written < 0 && errno != EINTR) _exit(kThrew);
            at += written > 0 ? static_cast<size_t>(written) : 0;
        }
        _exit(0);
    } catch (const std::bad_alloc&) {
        _exit(kNoMemory);
    } catch (...) {
        _exit(kThrew);
    }
}

// All that the child writes; false where it takes too long or writes too much.
bool read_all(int in, Clock::time_point deadline, uint64_t most, std::string& result) {
    char block[65536];
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) return false;
        pollfd waited{in, POLLIN, 0};
        if (poll(&waited, 1, static_cast<int>(left)) <= 0) continue;
        const ssize_t got = read(in, block, sizeof(block));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return true;
        result.append(block, static_cast<size_t>(got));
        if (result.size() > most) return false;
    }
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits, std::string& reason) {
    int ends[2];
    const auto fail = [] {
        throw Error(ErrorKind::out_of_memory, std::string("no process can be made: ") + std::strerror(errno),
                    "compiling a layout", "end other processes, or raise the limits of this one");
    };
    if (pipe2(ends, O_CLOEXEC) != 0) fail();
    const uint64_t space = address_space();
    const pid_t child = fork();
    if (child < 0) {
        close(ends[0]);
        close(ends[1]);
        fail();
    }
    if (child == 0) work_in_child(work, limits, ends[1], space > 0 ? space + limits.more_bytes : 0);
    close(ends[1]);
    std::string result;
    const bool whole = read_all(ends[0], Clock::now() + 2 * limits.seconds, limits.output_bytes, result);
    close(ends[0]);
    if (!whole) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (whole && WIFEXITED(status) && WEXITSTATUS(status) == 0) return result;
    if (result.size() > limits.output_bytes) {
        reason = "made more than " + std::to_string(limits.output_bytes >> 20) + " MiB";
    } else if (!whole || signal == SIGXCPU) {
        reason = "took more than " + std::to_string(limits.seconds.count()) + " s";
    } else if (WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory) {
        reason = "took more than " + std::to_string(limits.more_bytes >> 20) + " MiB";
    } else {
        reason = signal != 0 ? "crashed (signal " + std::to_string(signal) + ")" : "failed";
    }
    return {};
}

}  // namespace gnomon
