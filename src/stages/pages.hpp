// SPDX-License-Identifier: Apache-2.0
// The pages of a light's view that receivers ask for: 8 x 8 texels in one cell of time.
#pragma once

#include "stages/bin.hpp"

namespace gnomon {

/// Of the window that the bins hold. Receivers first ask (sample/ask), then the pages are listed.
class Pages {
public:
    /// Nobody has asked. The bins outlive it.
    Pages(gpu::Device& device, Programs& programs, const Bins& bins);

    /// Per item, two uint32_t: what sample/ask leaves.
    const gpu::Buffer& receivers() const { return receivers_; }
    /// List the pages. The host waits.
    void list();

    uint32_t count() const { return count_; }
    /// Per page, as pages/list leaves it.
    const gpu::Buffer& pages() const { return pages_; }
    /// The page of an item that has one: where the next item's differs. Items and one.
    const gpu::Buffer& page_of() const { return page_of_; }

private:
    gpu::Device& device_;
    Programs& programs_;
    const Bins& bins_;
    uint32_t count_ = 0;
    gpu::Buffer receivers_, page_of_, pages_;
};

}  // namespace gnomon
