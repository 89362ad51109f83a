// SPDX-License-Identifier: Apache-2.0
// What workgroups took, and what they are expected to take.
#include "gpu/pace.hpp"

#include <algorithm>

namespace gnomon::gpu {
namespace {

constexpr uint64_t kFirstProbe = 256;  // workgroups; about what a large device runs at one time
constexpr uint64_t kGrowth = 4;  // at most, from one piece to a larger one: the same number of workgroups may hold more work
constexpr double kDecay =
    0.98;  // of a maximum, with each measurement: dear and cheap work take turns, and small pieces cost little
constexpr uint64_t kProbeRow = 64;
constexpr uint64_t kRow = 1024;

}  // namespace

Grid spread_groups(uint64_t groups, uint64_t max_groups, uint64_t longest_row) {
    const uint64_t row = std::clamp<uint64_t>(longest_row, 1, max_groups);
    const uint64_t y = std::min((groups - 1) / row + 1, max_groups);
    return {(groups - 1) / y + 1, y};
}

const Pace::Known* Pace::find(const std::string& key) const {
    const auto found = known_.find(key);
    return found == known_.end() ? nullptr : &found->second;
}

Pace::Piece Pace::next(const std::string& key, uint64_t left) const {
    const Known* known = find(key);
    if (!known) return {std::min(left, kFirstProbe), piece_seconds_ / kGrowth, left > kFirstProbe};
    const uint64_t safe = std::max(kGrowth * known->most_groups, kFirstProbe);
    uint64_t groups = std::min(left, safe);
    if (static_cast<double>(groups) * known->seconds_per_group > piece_seconds_) {
        groups = std::max<uint64_t>(1, static_cast<uint64_t>(piece_seconds_ / known->seconds_per_group));
    }
    return {groups, static_cast<double>(groups) * known->seconds_per_group, groups == safe && groups < left};
}

bool Pace::fits(const std::string& key, uint64_t groups) const {
    const Known* known = find(key);
    return known ? static_cast<double>(groups) * known->seconds_per_group <= piece_seconds_ : groups <= kFirstProbe;
}

uint64_t Pace::longest_row(const std::string& key) const {
    const Known* known = find(key);
    if (!known) return kProbeRow;
    if (known->seconds_per_group * kRow < piece_seconds_ / kGrowth) return kRow;
    return std::max<uint64_t>(1, static_cast<uint64_t>(piece_seconds_ / kGrowth / known->seconds_per_group));
}

void Pace::measured(const std::string& key, uint64_t groups, double seconds) {
    const double now = seconds / static_cast<double>(groups);
    Known& known = known_[key];
    known.most_groups = std::max(known.most_groups, groups);
    // A few workgroups take as long as one, and say little about many, unless it was time by which they were so few.
    const double half = 0.5 * piece_seconds_;
    if (groups >= 2 * known.groups) {
        known.seconds_per_group = now;
        known.groups = groups;
    } else if (2 * groups >= known.groups || seconds > half || static_cast<double>(groups) * known.seconds_per_group > half) {
        known.seconds_per_group = std::max(now, kDecay * known.seconds_per_group);
    }
}

}  // namespace gnomon::gpu
