// SPDX-License-Identifier: Apache-2.0
#include "layouts/accesses.hpp"

#include <algorithm>

#include "layouts/interface.hpp"

namespace gnomon {
namespace {

using shared::LayoutRead;

constexpr uint64_t kSectorBytes = 32, kLineBytes = 128;

// A read of a group: at one time all k-th ones of a buffer are one request.
struct Access {
    uint32_t when, what, k, element;

    auto operator<=>(const Access&) const = default;
};

// Distinct blocks of so many bytes that elements lie in; these are in order.
class Blocks {
public:
    explicit Blocks(uint64_t bytes) : bytes_(bytes) {}

    void begin() { next_ = 0; }
    void add(uint64_t first_byte, uint64_t end_byte) {
        const uint64_t first = std::max(first_byte / bytes_, next_), end = (end_byte - 1) / bytes_ + 1;
        count_ += end > first ? end - first : 0;
        next_ = std::max(next_, end);
    }
    uint64_t count() const { return count_; }

private:
    uint64_t bytes_, next_ = 0, count_ = 0;
};

// Records of one group, hit by hit.
class Group {
public:
    Group(const std::vector<uint32_t>& element_bytes, const Dependences& dependences, LayoutAccesses& sum)
        : element_bytes_(element_bytes), dependences_(dependences), sum_(sum) {}

    void add(std::span<const LayoutRead> reads) {
        accesses_.clear();
        turns_.clear();
        for (size_t first = 0, end = 0; first < reads.size(); first = end) {
            while (end < reads.size() && reads[end].hit == reads[first].hit) ++end;
            add_query(reads.subspan(first, end - first));
        }
        const auto begins = [](const LayoutRead& read) { return read.what == shared::kQueryBegins; };
        sum_.groups += std::any_of(reads.begin(), reads.end(), begins) ? 1 : 0;  // Else it walks on.
        std::sort(turns_.begin(), turns_.end());
        sum_.visits += turns_.size();
        sum_.turns += static_cast<uint64_t>(std::unique(turns_.begin(), turns_.end()) - turns_.begin());
        add_requests();
        add_distinct();
    }

private:
    void add_query(std::span<const LayoutRead> reads) {
        uint64_t count = 0;
        std::vector<uint32_t> of_all(element_bytes_.size());
        std::vector<uint32_t> of_each(element_bytes_.size());  // At this time.
        uint32_t when = ~0u;
        for (const LayoutRead& read : reads) {
            if (read.what == shared::kQueryBegins) ++sum_.queries;
            if (read.what == shared::kTurnBegins) turns_.push_back(read.when);
            if (read.what >= element_bytes_.size()) continue;
            if (read.when != when) std::fill(of_each.begin(), of_each.end(), 0u);
            when = read.when;
            accesses_.push_back({read.when, read.what, of_each[read.what]++, read.element});
            sum_.bytes += element_bytes_[read.what];
            ++of_all[read.what];
            ++count;
        }
        sum_.reads += count;
        sum_.most_reads = std::max(sum_.most_reads, count);
        const uint64_t chain = dependences_.longest_chain(of_all);
        sum_.chained_reads += chain;
        sum_.longest_chain = std::max(sum_.longest_chain, chain);
    }

    void add_requests() {
        std::sort(accesses_.begin(), accesses_.end());
        Blocks sectors(kSectorBytes);
        const Access* before = nullptr;
        for (const Access& access : accesses_) {
            if (before == nullptr || before->when != access.when || before->what != access.what || before->k != access.k) {
                ++sum_.requests;
                sectors.begin();
            }
            before = &access;
            sectors.add(first_byte(access), end_byte(access));
        }
        sum_.request_sectors += sectors.count();
    }

    void add_distinct() {
        std::sort(accesses_.begin(), accesses_.end(),
                  [](const Access& a, const Access& b) { return a.what != b.what ? a.what < b.what : a.element < b.element; });
        Blocks bytes(1), sectors(kSectorBytes), lines(kLineBytes);
        uint32_t what = ~0u;
        for (const Access& access : accesses_) {
            for (Blocks* blocks : {&bytes, &sectors, &lines}) {
                if (access.what != what) blocks->begin();
                blocks->add(first_byte(access), end_byte(access));
            }
            what = access.what;
        }
        sum_.distinct_bytes += bytes.count();
        sum_.sectors += sectors.count();
        sum_.lines += lines.count();
    }

    uint64_t first_byte(const Access& access) const { return uint64_t{access.element} * element_bytes_[access.what]; }
    uint64_t end_byte(const Access& access) const { return first_byte(access) + element_bytes_[access.what]; }

    const std::vector<uint32_t>& element_bytes_;
    const Dependences& dependences_;
    LayoutAccesses& sum_;
    std::vector<Access> accesses_;
    std::vector<uint32_t> turns_;
};

}  // namespace

std::vector<uint32_t> element_bytes(const Layout& layout) {
    std::vector<uint32_t> bytes;
    for (const LayoutBuffer& buffer : layout.buffers) bytes.push_back(buffer.element_bytes);
    bytes.insert(bytes.end(), layout.sizes.size(), sizeof(uint32_t));
    return bytes;
}

std::vector<std::string> names_of_reads(const Layout& layout) {
    std::vector<std::string> names;
    for (const LayoutBuffer& buffer : layout.buffers) names.push_back(buffer.name);
    for (const LayoutSize& size : layout.sizes) names.push_back(read_name(size));
    return names;
}

void add_reads(std::span<const LayoutRead> reads, const std::vector<uint32_t>& element_bytes, const Dependences& dependences,
               LayoutAccesses& sum) {
    std::vector<LayoutRead> sorted(reads.begin(), reads.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const LayoutRead& a, const LayoutRead& b) { return a.hit < b.hit; });
    Group group(element_bytes, dependences, sum);
    for (size_t first = 0, end = 0; first < sorted.size(); first = end) {
        const auto group_of = [&](size_t i) { return sorted[i].hit / shared::kReadGroup; };
        while (end < sorted.size() && group_of(end) == group_of(first)) ++end;
        group.add(std::span(sorted).subspan(first, end - first));
    }
}

}  // namespace gnomon
