// SPDX-License-Identifier: Apache-2.0
// Blocks of device memory, and the gaps in them.
#include "gpu/pool.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

namespace gnomon::gpu {

MemoryPool::Piece& MemoryPool::Piece::operator=(Piece&& other) noexcept {
    std::swap(pool_, other.pool_);
    std::swap(block_, other.block_);
    std::swap(offset_, other.offset_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

MemoryPool::Piece::~Piece() {
    if (pool_) pool_->put_back(*block_, offset_, bytes_);
}

VkDeviceMemory MemoryPool::Piece::memory() const { return block_->memory.get(); }

std::byte* MemoryPool::Piece::mapped() const { return block_->mapped ? block_->mapped + offset_ : nullptr; }

// The gap that has least to spare. A piece with a block of its own leaves at most half of it unused.
MemoryPool::Place MemoryPool::find(uint64_t bytes, uint64_t alignment) const {
    const bool alone = bytes >= kLargeBytes;
    Place best;
    for (const auto& block : blocks_) {
        if (block->alone != alone || (alone && block->bytes / 2 > bytes)) continue;
        for (size_t i = 0; i < block->gaps.size(); ++i) {
            const Gap& gap = block->gaps[i];
            const uint64_t aligned = (gap.offset + alignment - 1) / alignment * alignment;
            if ((alone && !block->empty()) || aligned - gap.offset + bytes > gap.bytes) continue;
            if (!best.block || gap.bytes - bytes < best.spare) best = {block.get(), i, aligned, gap.bytes - bytes};
        }
    }
    return best;
}

VkResult MemoryPool::add_block(uint64_t bytes, bool alone, uint64_t keep_within) {
    release(keep_within - std::min(keep_within, bytes));
    const VkMemoryAllocateInfo info{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = bytes, .memoryTypeIndex = memory_type_};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory);
    if (result != VK_SUCCESS) return result;
    auto block = std::make_unique<Block>();
    block->memory = OwnedMemory(device_, memory);
    block->bytes = bytes;
    block->alone = alone;
    block->gaps = {{0, bytes}};
    if (mapped_) {
        void* mapped = nullptr;
        const VkResult map_result = vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (map_result != VK_SUCCESS) return map_result;
        block->mapped = static_cast<std::byte*>(mapped);
    }
    blocks_.push_back(std::move(block));
    held_bytes_ += bytes;
    return VK_SUCCESS;
}

MemoryPool::Piece MemoryPool::cut(const Place& place, uint64_t bytes) {
    Block& block = *place.block;
    if (block.gaps.capacity() < block.pieces + 2) block.gaps.reserve(2 * (block.pieces + 2));
    ++block.pieces;
    const auto gap = block.gaps.begin() + static_cast<std::ptrdiff_t>(place.gap);
    const Gap before{gap->offset, place.offset - gap->offset}, after{place.offset + bytes, gap->end() - place.offset - bytes};
    if (before.bytes > 0 && after.bytes > 0) {
        *gap = after;
        block.gaps.insert(gap, before);
    } else if (before.bytes + after.bytes > 0) {
        *gap = before.bytes > 0 ? before : after;
    } else {
        block.gaps.erase(gap);
    }
    return Piece(*this, block, place.offset, bytes);
}

VkResult MemoryPool::take(uint64_t bytes, uint64_t alignment, uint64_t keep_within, Piece& piece) {
    Place place = find(bytes, alignment);
    if (!place.block) {
        const bool alone = bytes >= kLargeBytes;
        // An eighth more, so that one that is a little larger fits in later.
        const uint64_t step = std::bit_floor(bytes) / 8;
        const uint64_t wanted = alone ? (bytes + step - 1) / step * step : kBlockBytes;
        VkResult result = add_block(std::max(bytes, std::min(wanted, max_bytes_)), alone, keep_within);
        if (result != VK_SUCCESS) {
            release(0);
            result = add_block(bytes, alone, keep_within);
        }
        if (result != VK_SUCCESS) return result;
        place = find(bytes, alignment);
    }
    piece = cut(place, bytes);
    return VK_SUCCESS;
}

void MemoryPool::put_back(Block& block, uint64_t offset, uint64_t bytes) noexcept {
    --block.pieces;
    const auto after = std::ranges::lower_bound(block.gaps, offset, {}, &Gap::offset);
    const bool joins_after = after != block.gaps.end() && offset + bytes == after->offset;
    const bool joins_before = after != block.gaps.begin() && std::prev(after)->end() == offset;
    if (joins_before) {
        std::prev(after)->bytes += bytes + (joins_after ? after->bytes : 0);
        if (joins_after) block.gaps.erase(after);
    } else if (joins_after) {
        *after = {offset, bytes + after->bytes};
    } else {
        block.gaps.insert(after, {offset, bytes});
    }
}

void MemoryPool::release(uint64_t down_to) {
    std::erase_if(blocks_, [&](const std::unique_ptr<Block>& block) {
        if (held_bytes_ <= down_to || !block->empty()) return false;
        held_bytes_ -= block->bytes;
        return true;
    });
}

}  // namespace gnomon::gpu
