// SPDX-License-Identifier: Apache-2.0
#include "pipeline/steps.hpp"

#include <algorithm>

namespace gnomon {

Steps::Steps(gpu::Device& device, const Progress& progress) : device_(device), progress_(progress) {
    if (progress_) device_.on_submission([this] { submitted(); });
}

Steps::~Steps() { device_.on_submission({}); }

void Steps::begin(double from, double to) {
    from_ = from;
    to_ = to;
    submissions_ = 0;
    tell(from);
}

void Steps::submitted() {
    constexpr double kHalf = 8.0;  // Submissions after which half of a step counts as done.
    const auto count = static_cast<double>(++submissions_);
    tell(from_ + (to_ - from_) * count / (count + kHalf));
}

void Steps::tell(double share) {
    told_ = std::max(told_, share);
    if (progress_ && !progress_(told_)) throw Stopped();
}

}  // namespace gnomon
