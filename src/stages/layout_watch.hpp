// SPDX-License-Identifier: Apache-2.0
// What is watched of a layout while a frame is made (Layout::Watch).
#pragma once

#include <gnomon/render.hpp>
#include <optional>
#include <span>

#include "layouts/dependences.hpp"
#include "layouts/layout.hpp"
#include "stages/grid.hpp"

namespace gnomon {

class LayoutWatch {
public:
    /// Of accesses: reads of one in so many groups of shadow tests. test: SPIR-V of these.
    LayoutWatch(gpu::Device& device, const Layout& layout, uint32_t groups, std::span<const uint32_t> test);

    /// What stages bind that read the layout, and that write to it between begin_fill and end_fill; or what stands in for it.
    std::vector<gpu::Binding> read_bindings() const;
    std::vector<gpu::Binding> write_bindings() const;

    /// A band is filled. counts: how many places atomics may go to, of each buffer, size and counter.
    /// Errors: ErrorKind::out_of_memory.
    void begin_fill(std::vector<uint64_t> counts);
    /// Count the atomics of the fill.
    void end_fill();
    /// Count the words of a buffer that was filled with `initial` before.
    void count_words(const gpu::Buffer& buffer, uint64_t bytes, uint32_t initial);
    /// Count what the dispatch of shadow tests before has read.
    void count_reads();

    std::vector<LayoutFault> faults() const;
    /// None, where they are not watched.
    const std::optional<LayoutAccesses>& accesses() const { return accesses_; }

private:
    gpu::Device& device_;
    Layout layout_;
    std::vector<uint32_t> element_bytes_;
    std::optional<Dependences> dependences_;
    gpu::Buffer faults_;   ///< A uvec2 for each buffer of the layout, and one more.
    gpu::Buffer reads_;    ///< shared::ReadsHead, then shared::LayoutRead.
    gpu::Buffer atomics_;  ///< Where the counts of each buffer, size and counter begin, then these, one for each element.
    uint64_t atomics_count_ = 0;
    std::optional<LayoutAccesses> accesses_;
};

}  // namespace gnomon
