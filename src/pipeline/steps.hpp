// SPDX-License-Identifier: Apache-2.0
// How much of a frame is done.
#pragma once

#include <gnomon/render.hpp>

#include "gpu/gpu.hpp"

namespace gnomon {

/// Tells whoever waits for a frame, after each submission to the device, what share of it is done, and throws Stopped out of
/// the submission where that is enough. What is told never goes back. `progress` may be empty, and must not go before this.
class Steps {
public:
    struct Stopped {};

    Steps(gpu::Device& device, const Progress& progress);
    ~Steps();
    Steps(const Steps&) = delete;
    Steps& operator=(const Steps&) = delete;

    /// What is submitted from now on leads from one share of the frame to the other. How many submissions that takes is not
    /// known before: each goes a part of what is left. Errors: Stopped.
    void begin(double from, double to);

private:
    void submitted();
    void tell(double share);

    gpu::Device& device_;
    const Progress& progress_;
    double from_ = 0.0;
    double to_ = 0.0;
    double told_ = 0.0;
    uint64_t submissions_ = 0;  // Of this step.
};

}  // namespace gnomon
