// SPDX-License-Identifier: Apache-2.0
#include "pipeline/light_records.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "shared/light.h"

namespace gnomon {

std::vector<glm::vec4> light_records(const Scene& scene, const std::vector<Pose>& poses) {
    std::vector<glm::vec4> records;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const bool point = light.kind == LightKind::point;
        const uint32_t kind = light.kind == LightKind::directional ? shared::kLightDirectional : shared::kLightSpot;
        records.emplace_back(light.color * light.intensity, std::bit_cast<float>(kind));
        double inner = std::cos(static_cast<double>(light.inner_cone)), outer = std::cos(static_cast<double>(light.outer_cone));
        double scale = 1.0 / std::max(1e-3, inner - outer);
        const glm::vec2 cone = point ? glm::vec2(0.0f, 1.0f) : glm::vec2(scale, -outer * scale);
        records.emplace_back(cone, light.range, 0.0f);
        std::vector<glm::dquat> turns;
        for (const Pose& pose : poses) {
            const glm::dquat turn = point ? glm::dquat(1.0, 0.0, 0.0, 0.0) : pose.lights[i].rotation;
            // Of the two quaternions of a rotation that which is nearer the one before.
            turns.push_back(!turns.empty() && glm::dot(turns.back(), turn) < 0.0 ? -turn : turn);
        }
        for (size_t k = 0; k < poses.size(); ++k) {
            const glm::dquat &turn = turns[k], &next = turns[std::min(k + 1, poses.size() - 1)];
            const double angle = 2.0 * std::atan2(glm::length(next - turn), glm::length(next + turn));
            records.emplace_back(glm::vec3(poses[k].lights[i].translation), static_cast<float>(angle));
            records.emplace_back(turn.x, turn.y, turn.z, turn.w);
        }
    }
    if (records.empty()) records.emplace_back(0.0f);
    return records;
}

}  // namespace gnomon
