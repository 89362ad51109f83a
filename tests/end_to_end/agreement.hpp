// SPDX-License-Identifier: Apache-2.0
// How well two frames of the same samples agree, and whether what differs is rounding.
#pragma once

#include <iosfwd>

#include "oracle/sample_judge.hpp"

namespace gnomon::test {

/// Of a frame against the reference.
struct Agreement {
    uint64_t samples = 0;
    uint64_t primary_differ = 0;  ///< Another triangle, or a miss on one side only. Coincident surfaces count as agreement.
    uint64_t coincident = 0;      ///< Another triangle of the same depth that covers the sample too.
    uint64_t primary_judged = 0;
    uint64_t primary_wrong = 0;  ///< Of those judged: wrong by more than rounding.
    uint64_t shadow_tests = 0;   ///< Samples times lights where both hit the same triangle.
    uint64_t shadow_differ = 0;
    uint64_t shadow_judged = 0;
    uint64_t shadow_tolerance =
        0;  ///< Of those judged: exactly right by gnomon's least tolerance near the hit, where that is more than the hit's own.
    uint64_t shadow_closer = 0;  ///< Of those judged: dark by what the reference's tolerance near the hit leaves out.
    uint64_t shadow_wrong = 0;
    double depth_error = 0.0;  ///< Largest relative difference of depth where both hit the same triangle.
    std::string first_wrong;   ///< What and where, for a person.

    double primary_share() const {
        return samples > 0 ? 1.0 - static_cast<double>(primary_differ) / static_cast<double>(samples) : 1.0;
    }
    double shadow_share() const {
        return shadow_tests > 0 ? 1.0 - static_cast<double>(shadow_differ) / static_cast<double>(shadow_tests) : 1.0;
    }
    /// As if both had gnomon's least tolerance, and none where that is what gnomon does.
    double shadow_share_of_one_tolerance() const {
        const double same =
            shadow_judged > 0 ? 1.0 - static_cast<double>(shadow_tolerance + shadow_closer) / static_cast<double>(shadow_judged)
                              : 1.0;
        return 1.0 - (1.0 - shadow_share()) * same;
    }
};

std::ostream& operator<<(std::ostream& out, const Agreement& agreement);

/// How many differing samples of either kind are judged: all, or as many drawn at random.
inline constexpr size_t kMostJudged = 200;

/// Compare gnomon's samples with the reference's and judge gnomon's where they differ (SampleJudge says what rounding is).
/// Both frames hold spp samples per pixel, made with `seed`.
Agreement compare_samples(const Frame& frame, const Frame& reference, uint32_t spp, uint32_t seed,
                          const oracle::SampleJudge& judge);

/// Where a sample lies, from its index in Frame::samples.
oracle::SamplePoint sample_at(size_t index, uint32_t width, uint32_t spp, uint32_t seed);

}  // namespace gnomon::test
