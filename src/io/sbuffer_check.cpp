// SPDX-License-Identifier: Apache-2.0
#include "io/sbuffer_check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gnomon/error.hpp>
#include <span>
#include <sstream>
#include <tuple>

namespace gnomon::io {

namespace {

// By which rounding may widen a range: ARCHITECTURE.md, "An example by hand".
constexpr float kSlack = 1e-5f;

std::string text(float value) {
    std::ostringstream out;
    out.precision(9);
    out << value;
    return out.str();
}

/// What is wrong with a range that comes behind `before`, if that is not null; empty: nothing.
std::string fault(const FileRange& r, const FileRange* before) {
    for (const auto& [name, value] :
         {std::pair("Z", r.z), std::pair("ZBack", r.z_back), std::pair("time.enter", r.enter), std::pair("time.exit", r.exit),
          std::pair("triangle", r.triangle), std::pair("A", r.alpha), std::pair("depth.enter", r.enter_depth),
          std::pair("depth.exit", r.exit_depth)}) {
        if (!std::isfinite(value)) return std::string(name) + " is " + text(value);
    }
    if (r.enter > r.exit) return "it enters at " + text(r.enter) + " and leaves before, at " + text(r.exit);
    if (r.enter < -kSlack || r.exit > 1.0f + kSlack)
        return "its time, " + text(r.enter) + " to " + text(r.exit) + ", is outside of the shutter, 0 to 1";
    if (r.z > r.z_back) return "Z is " + text(r.z) + ", behind ZBack, " + text(r.z_back);
    if (std::min(r.enter_depth, r.exit_depth) != r.z || std::max(r.enter_depth, r.exit_depth) != r.z_back)
        return "depth.enter and depth.exit, " + text(r.enter_depth) + " and " + text(r.exit_depth) + ", are not Z and ZBack";
    if (r.triangle < 0.0f || r.triangle > static_cast<float>(kMostDumpedTriangles) || r.triangle != std::floor(r.triangle))
        return "triangle is " + text(r.triangle) + ", not a whole number from 0 to 16777216";
    if (r.alpha != 1.0f) return "A is " + text(r.alpha) + ", not 1";
    const auto key = [](const FileRange& range) {
        return std::tuple(range.enter, range.triangle, range.exit, range.enter_depth, range.exit_depth);
    };
    if (before != nullptr && key(r) < key(*before))
        return "it is not sorted: by time.enter, then triangle, it comes before the last";
    return {};
}

}  // namespace

SBufferSummary check_sbuffer(const SBufferFile& file) {
    SBufferSummary summary;
    summary.texels = uint64_t(file.width()) * file.height();
    summary.file_bytes = std::filesystem::file_size(file.path());
    float last_triangle = -1.0f;
    for (uint32_t y = 0; y < file.height(); ++y) {
        const SBufferFile::Row row = file.row(y);
        std::span<const FileRange> ranges = row.ranges;
        for (uint32_t x = 0; x < file.width(); ++x) {
            const uint32_t count = row.counts[x];
            for (uint32_t i = 0; i < count; ++i) {
                const FileRange& r = ranges[i];
                const std::string wrong = fault(r, i > 0 ? &ranges[i - 1] : nullptr);
                if (!wrong.empty()) {
                    throw Error(ErrorKind::input,
                                "texel " + std::to_string(x) + "," + std::to_string(y) + ", range " + std::to_string(i) +
                                    " of " + std::to_string(count) + ": " + wrong,
                                file.path().string(), "make it again: it is damaged");
                }
                const bool first = summary.ranges + i == 0;
                summary.enter = first ? r.enter : std::min(summary.enter, r.enter);
                summary.exit = first ? r.exit : std::max(summary.exit, r.exit);
                summary.nearest = first ? r.z : std::min(summary.nearest, r.z);
                summary.farthest = first ? r.z_back : std::max(summary.farthest, r.z_back);
                last_triangle = std::max(last_triangle, r.triangle);
            }
            ranges = ranges.subspan(count);
            const auto bin = static_cast<size_t>(std::bit_width(count));
            if (summary.histogram.size() <= bin) summary.histogram.resize(bin + 1);
            ++summary.histogram[bin];
            summary.ranges += count;
            summary.texels_with += count > 0 ? 1 : 0;
            if (count > summary.most) std::tie(summary.most, summary.most_x, summary.most_y) = std::tuple(count, x, y);
        }
    }
    summary.triangles = last_triangle < 0.0f ? 0 : static_cast<uint32_t>(last_triangle) + 1;
    summary.range_bytes = summary.ranges * sizeof(float) * (file.exit_depths() ? 8 : 6);
    return summary;
}

}  // namespace gnomon::io
