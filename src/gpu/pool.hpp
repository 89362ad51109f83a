// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: device memory in blocks that stay when the buffers in them go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/owned.hpp"

namespace gnomon::gpu {

/// Memory of one type. Pieces of less than kLargeBytes share blocks of kBlockBytes, larger ones have a block of their own.
/// Blocks without pieces are kept for later ones; release() gives them back.
class MemoryPool {
    struct Block;

public:
    static constexpr uint64_t kBlockBytes = uint64_t{64} << 20;
    static constexpr uint64_t kLargeBytes = uint64_t{16} << 20;

    /// `mapped`: the host sees all blocks. None is larger than `max_bytes`, which is Vulkan's maxMemoryAllocationSize.
    MemoryPool(VkDevice device, uint32_t memory_type, bool mapped, uint64_t max_bytes)
        : device_(device), memory_type_(memory_type), mapped_(mapped), max_bytes_(max_bytes) {}

    /// Goes back to its pool, which must live longer.
    class Piece {
    public:
        Piece() = default;
        Piece(MemoryPool& pool, Block& block, uint64_t offset, uint64_t bytes)
            : pool_(&pool), block_(&block), offset_(offset), bytes_(bytes) {}
        Piece(Piece&& other) noexcept { *this = std::move(other); }
        Piece& operator=(Piece&& other) noexcept;
        ~Piece();
        VkDeviceMemory memory() const;
        uint64_t offset() const { return offset_; }
        std::byte* mapped() const;  ///< nullptr where the host does not see it.

    private:
        MemoryPool* pool_ = nullptr;
        Block* block_ = nullptr;
        uint64_t offset_ = 0;
        uint64_t bytes_ = 0;
    };

    /// Empty blocks are released where the pool would hold more than `keep_within` otherwise. Errors: VK_ERROR_OUT_OF_... of
    /// vkAllocateMemory, after all empty blocks were released.
    VkResult take(uint64_t bytes, uint64_t alignment, uint64_t keep_within, Piece& piece);
    /// Gives empty blocks back until the pool holds at most this, or there are none.
    void release(uint64_t down_to);
    uint64_t held_bytes() const { return held_bytes_; }

private:
    struct Gap {
        uint64_t offset = 0;
        uint64_t bytes = 0;
        uint64_t end() const { return offset + bytes; }
    };
    struct Block {
        OwnedMemory memory;
        uint64_t bytes = 0;
        std::byte* mapped = nullptr;
        bool alone = false;  // for one piece
        std::vector<Gap>
            gaps;  // by offset; with room for one more than there are pieces, so that to put one back needs no memory
        size_t pieces = 0;
        bool empty() const { return pieces == 0; }
    };
    struct Place {
        Block* block = nullptr;
        size_t gap = 0;  // Its number.
        uint64_t offset = 0;
        uint64_t spare = 0;
    };

    Place find(uint64_t bytes, uint64_t alignment) const;
    VkResult add_block(uint64_t bytes, bool alone, uint64_t keep_within);
    Piece cut(const Place& place, uint64_t bytes);
    void put_back(Block& block, uint64_t offset, uint64_t bytes) noexcept;

    VkDevice device_;
    uint32_t memory_type_;
    bool mapped_;
    uint64_t max_bytes_;
    uint64_t held_bytes_ = 0;
    std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace gnomon::gpu
