// SPDX-License-Identifier: Apache-2.0
// The ranges of an S-buffer, read back to the host through its layout's own GLSL.
#pragma once

#include <functional>
#include <span>

#include "stages/programs.hpp"
#include "stages/s_buffer.hpp"

namespace gnomon {

/// A run of lists: the number of the first, how many ranges each has, and these, one list behind the other.
using OnLists =
    std::function<void(uint64_t list_first, std::span<const uint32_t> counts, std::span<const shared::ListRange> ranges)>;

struct ReadLists {
    bool exits = false;        ///< The layout's ranges have a depth at their exit.
    bool only_counts = false;  ///< Leave the ranges on the device: there are none in what is called.
};

/// The stage that reads, without its layout: "sbuffer/read".
std::string read_lists_stage(bool exits);

/// Call `on_lists` with the lists of a band that is filled, in order, a run at a time. Takes some MiB of device memory, or the
/// longest list. Errors: ErrorKind::internal, where the layout gives far more ranges than it was given.
void read_lists(gpu::Device& device, Programs& programs, const SBuffer& s_buffer, const Band& band, const ReadLists& what,
                const OnLists& on_lists);

}  // namespace gnomon
