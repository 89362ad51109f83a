// SPDX-License-Identifier: Apache-2.0
// Which reads of a stage have to wait for others: their index is computed from what these have read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// Found in a stage's SPIR-V, whatever its loops and branches do: a read that is written once counts as one, however often it
/// is made. An index that only some branch computes so counts; that a branch itself waits does not. Branches that ask a
/// constant, which the arguments of functions may be, are those of that constant.
class Dependences {
public:
    /// names: of the texel buffers, or the blocks in their place, whose reads count. Errors: ErrorKind::internal for what is no
    /// SPIR-V.
    Dependences(std::span<const uint32_t> spirv, const std::vector<std::string>& names);

    /// Indices of reads[i] are computed from what reads[j] gives, without another read between.
    bool waits_for(size_t i, size_t j) const { return waits_[i][j]; }

    /// The most reads that have to be made one after the other by a query that reads so often from each. Of those whose index
    /// leads back to themselves, as that of a linked list's node, all have to.
    uint64_t longest_chain(std::span<const uint32_t> reads) const;

private:
    std::vector<std::vector<bool>> waits_;
    std::vector<std::vector<bool>> reaches_;  ///< By way of others.
};

}  // namespace gnomon
