// SPDX-License-Identifier: Apache-2.0
// Ctrl-C.
#include "interrupt.hpp"

#include <atomic>
#include <csignal>

namespace gnomon::cli {

namespace {

std::atomic<bool> was_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "written by a signal handler");

// What the signals did before, and do again from the second on.
struct sigaction before_int, before_term;

void interrupt(int signal) {
    was_interrupted = true;
    sigaction(signal, signal == SIGINT ? &before_int : &before_term, nullptr);
}

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = interrupt;
    sigaction(SIGINT, &action, &before_int);
    sigaction(SIGTERM, &action, &before_term);
}

bool interrupted() { return was_interrupted; }

}  // namespace gnomon::cli
