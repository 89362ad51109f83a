// SPDX-License-Identifier: Apache-2.0
#include "stages/layout_watch.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "layouts/accesses.hpp"
#include "shared/params.h"

namespace gnomon {
namespace {

constexpr uint32_t kMostReads = 1u << 20;  // Records of one dispatch.

}  // namespace

LayoutWatch::LayoutWatch(gpu::Device& device, const Layout& layout, uint32_t groups, std::span<const uint32_t> test)
    : device_(device), layout_(layout), element_bytes_(element_bytes(layout)) {
    if (layout.watch == Layout::Watch::faults)
        faults_ = gpu::upload_new(device, "layout_faults", std::vector<glm::uvec2>(layout.buffers.size() + 1));
    if (layout.watch != Layout::Watch::accesses) return;
    accesses_.emplace();
    dependences_.emplace(test, names_of_reads(layout));
    const shared::ReadsHead head{0, kMostReads, ~0u / groups};
    reads_ = device.allocate("layout_reads", sizeof(head) + uint64_t{kMostReads} * sizeof(shared::LayoutRead));
    gpu::upload(device, reads_, std::as_bytes(std::span(&head, 1)));
    atomics_ = device.allocate("layout_atomics", 4);
}

std::vector<gpu::Binding> LayoutWatch::read_bindings() const {
    if (faults_) return {{"LayoutFaults", &faults_}};
    return {{"LayoutReads", &reads_}};
}

std::vector<gpu::Binding> LayoutWatch::write_bindings() const {
    if (faults_) return {{"LayoutFaults", &faults_}};
    return {{"LayoutAtomics", &atomics_}};
}

void LayoutWatch::begin_fill(std::vector<uint64_t> counts) {
    if (!accesses_) return;
    std::vector<uint32_t> places;
    uint64_t words = counts.size();
    for (const uint64_t count : counts) {
        places.push_back(static_cast<uint32_t>(words));
        words += count;
    }
    if (words * 4 > device_.limits().max_storage_range) {
        throw Error(ErrorKind::out_of_memory, "counts of the accesses to " + std::to_string(words) + " elements", "S-buffer",
                    "use a smaller --shadow-res");
    }
    atomics_ = gpu::Buffer();
    atomics_ = device_.allocate("layout_atomics", words * 4);
    atomics_count_ = words - counts.size();
    device_.recorder().fill("sbuffer/clear", atomics_, 0);
    device_.recorder().upload(atomics_, std::as_bytes(std::span(places)));
}

void LayoutWatch::end_fill() {
    if (!accesses_) return;
    const uint64_t first = atomics_.bytes() / 4 - atomics_count_;
    for (const uint32_t count : gpu::download_vector<uint32_t>(device_, atomics_, atomics_count_, first * 4)) {
        accesses_->atomics += count;
        accesses_->most_atomics = std::max<uint64_t>(accesses_->most_atomics, count);
    }
}

void LayoutWatch::count_words(const gpu::Buffer& buffer, uint64_t bytes, uint32_t initial) {
    if (!accesses_) return;
    const std::vector<uint32_t> words = gpu::download_vector<uint32_t>(device_, buffer, bytes / 4);
    const auto unused = static_cast<uint64_t>(std::count(words.begin(), words.end(), initial));
    accesses_->held_bytes += words.size() * 4;
    accesses_->used_bytes += (words.size() - unused) * 4;
}

void LayoutWatch::count_reads() {
    if (!accesses_) return;
    const uint32_t count = gpu::download_vector<uint32_t>(device_, reads_, 1)[0];
    const std::vector<shared::LayoutRead> reads =
        gpu::download_vector<shared::LayoutRead>(device_, reads_, std::min(count, kMostReads), sizeof(shared::ReadsHead));
    device_.recorder().fill("sample/shadow", reads_, 0, 0, 4);
    if (count > kMostReads) accesses_->complete = false;
    if (accesses_->complete) add_reads(reads, element_bytes_, *dependences_, *accesses_);
}

std::vector<LayoutFault> LayoutWatch::faults() const {
    std::vector<LayoutFault> result;
    if (!faults_) return result;
    const size_t count = layout_.buffers.size();
    const std::vector<glm::uvec2> found = gpu::download_vector<glm::uvec2>(device_, faults_, count + 1);
    for (size_t i = 0; i <= count; ++i) {
        if (found[i].x > 0) result.push_back({i < count ? layout_.buffers[i].name : "", found[i].x, found[i].y});
    }
    return result;
}

}  // namespace gnomon
