// SPDX-License-Identifier: Apache-2.0
// The trace stage run over a whole image, and what it should have found.
#pragma once

#include "soup.hpp"
#include "stages/sample.hpp"

namespace gnomon::test {

/// How an image is sampled and cut up.
struct Sampling {
    uint32_t spp = 4;
    uint32_t seed = 5;
    uint32_t cells = 1;              ///< Of the camera's lists; a multiple of the segments.
    uint64_t most_slots = 1u << 20;  ///< Of one batch.
    Part part = Part::whole;         ///< Or apart.
};

/// Index (y * width + x) * spp + s: a triangle, kReversed if seen in its negative orientation, or kNone. tests:
/// Sampler::test_count.
std::vector<uint32_t> trace(gpu::Device& device, Programs& programs, const Soup& soup, const Sampling& sampling,
                            uint64_t* tests = nullptr);

/// What the exact test in float finds, one triangle after the other. The same bits as trace on a device that rounds as the host
/// does.
std::vector<uint32_t> trace_in_float(const Soup& soup, const Sampling& sampling);

/// How many samples differ from the oracle's nearest triangle; the rest of the index as above.
uint64_t count_differences_from_oracle(const Soup& soup, const Sampling& sampling, const std::vector<uint32_t>& found);

}  // namespace gnomon::test
