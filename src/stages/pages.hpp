// SPDX-License-Identifier: Apache-2.0
// The pages of a light's view that receivers ask for: 8 x 8 texels in one cell of time (comp_shaders/common/page.glsl).
#pragma once

#include <functional>

#include "stages/bin.hpp"

namespace gnomon {

/// Of the window that the bins hold. Receivers first ask (sample/ask), then the pages are listed; then those with long lists
/// may be split, whose receivers ask again (sample/descend) for the parts.
class Pages {
public:
    /// What receivers of split pages need to know.
    struct Parts {
        uint32_t page_first = 0;       ///< Pages from here on are new: split, or not.
        uint32_t node_first = 0;       ///< Four nodes for each unit: of the page's first unit, its parts.
        const gpu::Buffer& units;      ///< Per new page: its first unit.
        const gpu::Buffer& receivers;  ///< Per node from node_first on, two uint32_t: what sample/descend leaves.
    };

    /// Nobody has asked. Geometry and bins outlive it.
    Pages(gpu::Device& device, Programs& programs, const Geometry& geometry, const Bins& bins);

    /// Per item, two uint32_t: what sample/ask leaves.
    const gpu::Buffer& receivers() const { return receivers_; }
    /// List the pages. The host waits.
    void list();
    /// Split pages, and the parts of pages, while that makes their lists shorter; ask: sample/descend. The host waits twice for
    /// each level. Errors: ErrorKind::out_of_memory.
    void refine(bool orthographic, const std::function<void(const Parts&)>& ask);

    /// Of all pages; those that are split among them, whose lists are empty.
    uint32_t count() const { return count_; }
    /// Per page, two uvec4.
    const gpu::Buffer& pages() const { return pages_; }
    /// Per node, first the window's items: where its page is, and of which level.
    const gpu::Buffer& leaves() const { return leaves_; }
    /// Of the pages' lists the entries from the bins' last on.
    const gpu::Buffer& entries() const { return entries_; }
    uint32_t entry_first() const { return bins_.entry_count; }
    /// Entries of the longest list.
    uint32_t longest() const { return longest_; }

private:
    uint32_t split(uint32_t page_first, const gpu::Buffer& longest, const gpu::Buffer& units);
    void sift(bool orthographic, const shared::PageParams& params, const Parts& parts, const gpu::Buffer& sieves,
              const gpu::Buffer& counts);
    void hand_down(const shared::PageParams& params, const Parts& parts, const gpu::Buffer& sieves, const gpu::Buffer& places,
                   const gpu::Buffer& entries);
    void adopt(bool write, const shared::PageParams& params, const Parts& parts, const gpu::Buffer& places,
               const gpu::Buffer& ranks, const gpu::Buffer& target);
    shared::PageParams params(uint32_t page_first) const;
    /// A copy of the `held` bytes of the buffer, with room for `bytes` more.
    gpu::Buffer longer(const gpu::Buffer& buffer, const char* name, uint64_t held, uint64_t bytes);
    gpu::Buffer allocate(const char* name, uint64_t bytes);  ///< What the device can bind.

    gpu::Device& device_;
    Programs& programs_;
    const Geometry& geometry_;
    const Bins& bins_;
    uint32_t count_ = 0, node_count_ = 0, entry_count_ = 0, longest_ = 0;
    gpu::Buffer receivers_, leaves_, pages_, entries_;
};

}  // namespace gnomon
