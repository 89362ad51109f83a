// SPDX-License-Identifier: Apache-2.0
// Animations of a glTF document.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_build.hpp"

namespace gnomon::gltf {

namespace {

constexpr uint64_t kMaxTrackBytes = uint64_t{1} << 29;

class Builder {
public:
    Builder(const Document& document, Scene& scene, Rig& rig) : document_(document), scene_(scene), rig_(rig) {}

    void build() {
        for (size_t i = 0; i < document_.model.animations.size(); ++i) add(i);
    }

private:
    [[noreturn]] void fail(const std::string& what, size_t animation) const {
        throw Error(ErrorKind::input, what, "in " + document_.name + ": /animations/" + std::to_string(animation),
                    "repair or export the file again");
    }

    // The numbers of an accessor, shared by all samplers that use it.
    uint32_t track(int accessor, size_t animation) {
        const auto [it, is_new] = tracks_.try_emplace(accessor, static_cast<uint32_t>(rig_.tracks.size()));
        if (is_new) {
            bytes_ += float_bytes(document_.model.accessors[static_cast<size_t>(accessor)]);
            if (bytes_ > kMaxTrackBytes) fail("the animations have more than 512 MiB of key frames", animation);
            rig_.tracks.push_back(read_floats(document_, accessor));
        }
        return it->second;
    }

    // Equal times are let pass: rounding to float makes them of close ones.
    void check_times(uint32_t number, size_t animation) {
        if (!checked_times_.insert(number).second) return;
        const std::vector<float>& times = rig_.tracks[number];
        for (size_t i = 0; i < times.size(); ++i) {
            if (!std::isfinite(times[i])) fail("key frame " + std::to_string(i) + " has a time that is not finite", animation);
            if (i > 0 && times[i] < times[i - 1]) {
                fail("the times of the key frames do not ascend at key frame " + std::to_string(i), animation);
            }
        }
    }

    Rig::Sampler sampler_of(const tinygltf::AnimationSampler& from, size_t animation) {
        Rig::Sampler sampler;
        if (from.interpolation == "STEP") sampler.interpolation = Rig::Interpolation::step;
        if (from.interpolation == "CUBICSPLINE") sampler.interpolation = Rig::Interpolation::cubic_spline;
        sampler.times = track(from.input, animation);
        check_times(sampler.times, animation);
        sampler.values = track(from.output, animation);
        const size_t groups = rig_.tracks[sampler.times].size() * (from.interpolation == "CUBICSPLINE" ? 3 : 1);
        sampler.width = static_cast<uint32_t>(rig_.tracks[sampler.values].size() / groups);
        return sampler;
    }

    void add(size_t number) {
        const tinygltf::Animation& from = document_.model.animations[number];
        Rig::Animation animation;
        animation.name = "animation " + std::to_string(number) + (from.name.empty() ? "" : " '" + from.name + "'");
        for (const tinygltf::AnimationSampler& sampler : from.samplers)
            animation.samplers.push_back(sampler_of(sampler, number));

        AnimationInfo info{from.name, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0};
        std::set<std::pair<int, Rig::Path>> targets;
        for (const tinygltf::AnimationChannel& channel : from.channels) {
            const std::optional<Rig::Path> path = path_of(channel.target_path);
            // tinygltf leaves out channels without a node up to 2.8 and gives them node -1 from 2.9 on.
            if (!path || channel.target_node < 0 || !targets.insert({channel.target_node, *path}).second) continue;
            animation.channels.push_back({static_cast<uint32_t>(channel.sampler), channel.target_node, *path});
            const std::vector<float>& times = rig_.tracks[animation.samplers[static_cast<size_t>(channel.sampler)].times];
            info.start = std::min(info.start, double{times.front()});
            info.end = std::max(info.end, double{times.back()});
        }
        info.channels = static_cast<uint32_t>(animation.channels.size());
        if (info.channels == 0) info.start = info.end = 0.0;
        const size_t in_file = Cursor(document_.json["animations"][number], document_.name).count("channels");
        if (info.channels < in_file) {
            scene_.warnings.push_back(animation.name + ": " + std::to_string(in_file - info.channels) +
                                      " channels without a node, for something else than it, or for a second time are ignored");
        }
        rig_.animations.push_back(std::move(animation));
        scene_.animations.push_back(std::move(info));
    }

    static std::optional<Rig::Path> path_of(const std::string& name) {
        if (name == "translation") return Rig::Path::translation;
        if (name == "rotation") return Rig::Path::rotation;
        if (name == "scale") return Rig::Path::scale;
        if (name == "weights") return Rig::Path::weights;
        return std::nullopt;
    }

    const Document& document_;
    Scene& scene_;
    Rig& rig_;
    std::map<int, uint32_t> tracks_;
    std::set<uint32_t> checked_times_;
    uint64_t bytes_ = 0;
};

}  // namespace

void build_animations(const Document& document, Scene& scene, Rig& rig) { Builder(document, scene, rig).build(); }

}  // namespace gnomon::gltf
