// SPDX-License-Identifier: Apache-2.0
// Which of the ways to trace a row with Embree is the fastest.
#include "bench/trials.hpp"

#include <algorithm>
#include <cassert>

namespace gnomon::bench {
namespace {

// Divides no usual number of tiles across: then some columns would be left out.
constexpr uint32_t kTileStep = 13;
constexpr size_t kFinalists = 3;

void try_rays(const Peer& peer, const PeerBuild& build, timing::Seconds prepared, std::vector<Trial>& trials) {
    std::vector<Channel> scratch;
    peer.trace_part({}, kTileStep, scratch);
    for (const PeerRays& rays : peer_rays()) {
        const timing::Seconds start = timing::now();
        const double share = peer.trace_part(rays, kTileStep, scratch);
        const timing::Seconds traced = timing::now() - start;
        trials.push_back({build, rays, {prepared.wall + traced.wall / share, prepared.cpu + traced.cpu / share}, false});
    }
}

bool cheaper(const Trial& a, const Trial& b) { return a.seconds.cpu < b.seconds.cpu; }

}  // namespace

std::vector<Trial> try_variants(const PeerScene& scene, const std::vector<Pose>& poses, const PeerSettings& settings) {
    std::vector<Trial> trials;
    for (const PeerBuild& build : peer_builds()) {
        const timing::Seconds start = timing::now();
        const Peer peer(scene, poses, settings, build);
        try_rays(peer, build, timing::now() - start, trials);
    }
    std::vector<Trial> finalists = trials;
    std::sort(finalists.begin(), finalists.end(), cheaper);
    finalists.resize(std::min(kFinalists, finalists.size()));
    Frame frame;
    for (const Trial& trial : finalists) {
        const timing::Seconds start = timing::now();
        trace_peer(scene, poses, settings, trial.build, trial.rays, frame);
        trials.push_back({trial.build, trial.rays, timing::now() - start, true});
    }
    return trials;
}

const Trial& fastest(const std::vector<Trial>& trials) {
    const Trial* best = nullptr;
    for (const Trial& trial : trials) {
        if (trial.whole && (!best || cheaper(trial, *best))) best = &trial;
    }
    assert(best);
    return *best;
}

}  // namespace gnomon::bench
