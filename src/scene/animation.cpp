// SPDX-License-Identifier: Apache-2.0
// Choosing animations, and sampling their key frames: glTF 2.0, 3.11 and appendix C.
#include <algorithm>
#include <charconv>
#include <gnomon/error.hpp>

#include "scene/rig.hpp"

namespace gnomon {

namespace {

glm::dquat quaternion_of(const double* q) { return glm::dquat(q[3], q[0], q[1], q[2]); }

void store(const glm::dquat& q, double* out) {
    out[0] = q.x;
    out[1] = q.y;
    out[2] = q.z;
    out[3] = q.w;
}

// Value v of the key's group: 0 alone, or in-tangent 0, value 1, out-tangent 2.
const float* group(const Rig& rig, const Rig::Sampler& sampler, size_t key, size_t v) {
    const size_t groups = sampler.interpolation == Rig::Interpolation::cubic_spline ? 3 : 1;
    return rig.tracks[sampler.values].data() + (key * groups + (groups == 3 ? v : 0)) * sampler.width;
}

void cubic(const Rig& rig, const Rig::Sampler& sampler, size_t key, double s, double seconds, double* out) {
    const float* value0 = group(rig, sampler, key, 1);
    const float* tangent0 = group(rig, sampler, key, 2);
    const float* tangent1 = group(rig, sampler, key + 1, 0);
    const float* value1 = group(rig, sampler, key + 1, 1);
    const double s2 = s * s;
    const double s3 = s2 * s;
    for (uint32_t i = 0; i < sampler.width; ++i) {
        out[i] = (2.0 * s3 - 3.0 * s2 + 1.0) * value0[i] + seconds * (s3 - 2.0 * s2 + s) * tangent0[i] +
                 (3.0 * s2 - 2.0 * s3) * value1[i] + seconds * (s3 - s2) * tangent1[i];
    }
}

void linear(const Rig& rig, const Rig::Sampler& sampler, Rig::Path path, size_t key, double s, double* out) {
    const float* a = group(rig, sampler, key, 1);
    const float* b = group(rig, sampler, key + 1, 1);
    if (path == Rig::Path::rotation) {
        const glm::dquat from = glm::normalize(glm::dquat(a[3], a[0], a[1], a[2]));
        const glm::dquat to = glm::normalize(glm::dquat(b[3], b[0], b[1], b[2]));
        store(glm::slerp(from, to, s), out);
        return;
    }
    for (uint32_t i = 0; i < sampler.width; ++i) out[i] = (1.0 - s) * a[i] + s * b[i];
}

std::string names_of(const Scene& scene) {
    if (scene.animations.empty()) return "the scene has no animations";
    std::string text = "choose all, none or one of:";
    for (size_t i = 0; i < scene.animations.size(); ++i) {
        text += (i == 0 ? " " : ", ") + std::to_string(i);
        if (!scene.animations[i].name.empty()) text += " '" + scene.animations[i].name + "'";
    }
    return text;
}

}  // namespace

void sample_track(const Rig& rig, const Rig::Sampler& sampler, Rig::Path path, double t, double* out) {
    const std::vector<float>& times = rig.tracks[sampler.times];
    // The first key later than t; the one before it holds at t.
    const size_t next = static_cast<size_t>(
        std::upper_bound(times.begin(), times.end(), t, [](double at, float key) { return at < double{key}; }) - times.begin());
    const size_t key = next == 0 ? 0 : next - 1;
    const bool between = next > 0 && next < times.size();
    if (!between || sampler.interpolation == Rig::Interpolation::step) {
        const float* value = group(rig, sampler, key, 1);
        for (uint32_t i = 0; i < sampler.width; ++i) out[i] = value[i];
    } else {
        const double seconds = double{times[next]} - double{times[key]};
        const double s = (t - double{times[key]}) / seconds;
        if (sampler.interpolation == Rig::Interpolation::cubic_spline) {
            cubic(rig, sampler, key, s, seconds, out);
        } else {
            linear(rig, sampler, path, key, s, out);
        }
    }
    if (path == Rig::Path::rotation) store(glm::normalize(quaternion_of(out)), out);
}

AnimationChoice choose_animation(const Scene& scene, const std::string& option) {
    if (option == "none") return {AnimationChoice::Kind::none, 0};
    if (option == "all") return {AnimationChoice::Kind::all, 0};
    if (option.empty()) return {AnimationChoice::Kind::one, 0};
    const auto fail = [&](const std::string& what) {
        return Error(ErrorKind::usage, what, "option --animation", names_of(scene));
    };

    std::vector<uint32_t> matches;
    for (size_t i = 0; i < scene.animations.size(); ++i) {
        if (scene.animations[i].name == option) matches.push_back(static_cast<uint32_t>(i));
    }
    if (matches.size() > 1)
        throw fail(std::to_string(matches.size()) + " animations are named '" + option + "': give an index");
    if (matches.size() == 1) return {AnimationChoice::Kind::one, matches[0]};

    uint32_t index = 0;
    const auto [end, code] = std::from_chars(option.data(), option.data() + option.size(), index);
    // Index 0 is the default, which a scene without animations has, too.
    const size_t count = std::max<size_t>(scene.animations.size(), 1);
    if (code != std::errc{} || end != option.data() + option.size() || index >= count) {
        throw fail("there is no animation '" + option + "'");
    }
    return {AnimationChoice::Kind::one, index};
}

}  // namespace gnomon
