// SPDX-License-Identifier: Apache-2.0
// How well two frames of the same samples agree, and whether what differs is rounding.
#include "agreement.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <sstream>

#include "math/sample.h"

namespace gnomon::test {
namespace {

using Verdict = oracle::SampleJudge::Verdict;

struct ShadowTest {
    size_t sample;
    uint32_t light;
};

// At most kMostJudged of them, drawn at random but always the same.
template <class T>
std::vector<T> drawn(std::vector<T> all) {
    std::mt19937 random(0);
    std::shuffle(all.begin(), all.end(), random);
    if (all.size() > kMostJudged) all.resize(kMostJudged);
    return all;
}

}  // namespace

oracle::SamplePoint sample_at(size_t index, uint32_t width, uint32_t spp, uint32_t seed) {
    const auto s = static_cast<uint32_t>(index % spp), pixel = static_cast<uint32_t>(index / spp);
    const uint32_t x = pixel % width, y = pixel / width;
    const glm::vec3 p = shared::sample_point(shared::pixel_hash(x, y, seed), x, y, s, shared::stratum_length(spp));
    return {p.x, p.y, p.z};
}

Agreement compare_samples(const Frame& frame, const Frame& reference, uint32_t spp, uint32_t seed,
                          const oracle::SampleJudge& judge) {
    Agreement result;
    std::vector<size_t> primaries;
    std::vector<ShadowTest> shadows;
    const auto where = [&](size_t i) { return sample_at(i, frame.width, spp, seed); };
    result.samples = frame.samples.size();
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        const SampleRecord& a = frame.samples[i];
        const SampleRecord& b = reference.samples.at(i);
        if (a.triangle != b.triangle) {
            const bool both = a.triangle != SampleRecord::kMiss && b.triangle != SampleRecord::kMiss;
            if (both && judge.coincident(a.triangle, b.triangle, where(i))) {
                ++result.coincident;
            } else {
                primaries.push_back(i);
            }
            continue;
        }
        if (a.triangle == SampleRecord::kMiss) continue;
        result.depth_error = std::max(result.depth_error, std::abs(double{a.depth} / double{b.depth} - 1.0));
        result.shadow_tests += frame.light_count;
        for (uint32_t light = 0; light < frame.light_count; ++light) {
            if (frame.lit(i, light) != reference.lit(i, light)) shadows.push_back({i, light});
        }
    }
    result.primary_differ = primaries.size();
    result.shadow_differ = shadows.size();

    std::ostringstream text;
    const auto name = [&](size_t i) {
        const oracle::SamplePoint p = where(i);
        text << "sample " << i << " (x " << p.x << ", y " << p.y << ", t " << p.t << "): ";
    };
    for (const size_t i : drawn(primaries)) {
        ++result.primary_judged;
        if (judge.primary(frame.samples[i].triangle, where(i)) != Verdict::wrong) continue;
        if (++result.primary_wrong > 3) continue;
        name(i);
        text << "triangle " << static_cast<int32_t>(frame.samples[i].triangle) << " at " << frame.samples[i].depth
             << ", reference " << static_cast<int32_t>(reference.samples[i].triangle) << " at " << reference.samples[i].depth
             << "\n";
    }
    for (const ShadowTest& test : drawn(shadows)) {
        ++result.shadow_judged;
        const bool lit = frame.lit(test.sample, test.light);
        const Verdict verdict = judge.shadow(frame.samples[test.sample].triangle, test.light, lit, where(test.sample));
        if (verdict == Verdict::tolerance) ++result.shadow_tolerance;
        if (verdict == Verdict::closer) ++result.shadow_closer;
        if (verdict != Verdict::wrong) continue;
        if (++result.shadow_wrong > 3) continue;
        name(test.sample);
        text << "triangle " << frame.samples[test.sample].triangle << ", light " << test.light << (lit ? " lit" : " dark")
             << ", the reference says otherwise\n";
    }
    result.first_wrong = text.str();
    return result;
}

std::ostream& operator<<(std::ostream& out, const Agreement& a) {
    return out << a.samples << " samples, primary differ " << a.primary_differ << " (agree " << 100.0 * a.primary_share()
               << " %; coincident " << a.coincident << "; beyond rounding " << a.primary_wrong << " of " << a.primary_judged
               << " judged), depth error " << a.depth_error << "; shadow tests " << a.shadow_tests << ", differ "
               << a.shadow_differ << " (agree " << 100.0 * a.shadow_share() << " %; tolerance " << a.shadow_tolerance
               << ", closer " << a.shadow_closer << ", beyond rounding " << a.shadow_wrong << " of " << a.shadow_judged
               << " judged)\n"
               << a.first_wrong;
}

}  // namespace gnomon::test
