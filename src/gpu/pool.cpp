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
        for (const auto& [offset, size] : block->gaps) {
            const uint64_t aligned = (offset + alignment - 1) / alignment * alignment;
            const uint64_t lost = aligned - offset;
            if ((alone && !block->empty()) || lost + bytes > size) continue;
            if (!best.block || size - bytes < best.spare) best = {block.get(), offset, aligned, size - bytes};
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
    const auto gap = place.block->gaps.find(place.gap);
    const uint64_t end = gap->first + gap->second;
    if (place.offset > gap->first) {
        gap->second = place.offset - gap->first;
    } else {
        place.block->gaps.erase(gap);
    }
    if (place.offset + bytes < end) place.block->gaps[place.offset + bytes] = end - place.offset - bytes;
    return Piece(*this, *place.block, place.offset, bytes);
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

void MemoryPool::put_back(Block& block, uint64_t offset, uint64_t bytes) {
    auto gap = block.gaps.emplace(offset, bytes).first;
    const auto after = std::next(gap);
    if (after != block.gaps.end() && offset + bytes == after->first) {
        gap->second += after->second;
        block.gaps.erase(after);
    }
    if (gap == block.gaps.begin()) return;
    const auto before = std::prev(gap);
    if (before->first + before->second == offset) {
        before->second += gap->second;
        block.gaps.erase(gap);
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
