// SPDX-License-Identifier: Apache-2.0
#include "stages/pose.hpp"

#include <bit>
#include <numeric>

#include "math/order.h"
#include "scene/shells.hpp"
#include "shared/params.h"
#include "stages/grid.hpp"

namespace gnomon {
namespace {

uint32_t bits(float value) { return std::bit_cast<uint32_t>(value); }

std::vector<glm::uvec4> rest_vertices(const Scene& scene) {
    std::vector<glm::uvec4> rest;
    rest.reserve(scene.vertices.size() * 3);
    for (const Vertex& v : scene.vertices) {
        const Morph& morph = scene.morphs[v.morph];
        rest.emplace_back(bits(v.position.x), bits(v.position.y), bits(v.position.z), v.influence_first);
        rest.emplace_back(bits(v.normal.x), bits(v.normal.y), bits(v.normal.z), v.influence_count);
        rest.emplace_back(morph.target_count, morph.delta_first + v.morph_vertex, morph.vertex_count, morph.weight_first);
    }
    return rest;
}

std::vector<glm::vec4> padded(const std::vector<glm::vec3>& values) {
    std::vector<glm::vec4> result;
    result.reserve(values.size());
    for (const glm::vec3& v : values) result.emplace_back(v, 0.0f);
    return result;
}

void upload_surfaces(gpu::Device& device, const Scene& scene, SceneData& data) {
    std::vector<glm::uvec4> triangles;
    for (const Triangle& t : scene.triangles) triangles.emplace_back(t.vertex[0], t.vertex[1], t.vertex[2], t.material);
    triangles.emplace_back(0u, 0u, 0u, 0u);
    data.triangles = gpu::upload_new(device, "triangles", triangles);
    const Shells shells = find_shells(scene);
    data.shells = gpu::upload_new(device, "shells", shells.of_triangle);
    data.shell_triangles.assign(shells.count + 1, 0);
    for (const uint32_t shell : shells.of_triangle) ++data.shell_triangles[shell];

    std::vector<glm::vec4> attributes;
    for (const Vertex& v : scene.vertices) {
        attributes.emplace_back(v.uv, 0.0f, 0.0f);
        attributes.push_back(v.color);
        data.smooth = data.smooth || v.normal != glm::vec3(0.0f);
    }
    data.attributes = gpu::upload_new(device, "attributes", attributes);

    std::vector<uint32_t> texels;
    std::vector<uint32_t> first_texel;
    for (const Image& image : scene.images) {
        first_texel.push_back(static_cast<uint32_t>(texels.size()));
        for (size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
            texels.push_back(static_cast<uint32_t>(image.rgba[i]) | static_cast<uint32_t>(image.rgba[i + 1]) << 8 |
                             static_cast<uint32_t>(image.rgba[i + 2]) << 16 | static_cast<uint32_t>(image.rgba[i + 3]) << 24);
        }
    }
    data.texels = gpu::upload_new(device, "texels", texels);

    std::vector<glm::uvec4> materials;
    for (const Material& m : scene.materials) {
        materials.emplace_back(bits(m.base_color.x), bits(m.base_color.y), bits(m.base_color.z), bits(m.base_color.w));
        if (m.image < 0) {
            materials.emplace_back(shared::kNone, 1u, 1u, 0u);
        } else {
            const Image& image = scene.images[static_cast<size_t>(m.image)];
            uint32_t wrap = static_cast<uint32_t>(m.wrap_u) | static_cast<uint32_t>(m.wrap_v) << 2;
            materials.emplace_back(first_texel[static_cast<size_t>(m.image)], image.width, image.height, wrap);
            data.textured = true;
        }
    }
    data.materials = gpu::upload_new(device, "materials", materials);
}

}  // namespace

SceneData upload_scene(gpu::Device& device, const Scene& scene) {
    SceneData data;
    data.triangle_count = static_cast<uint32_t>(scene.triangles.size());
    data.vertex_count = static_cast<uint32_t>(scene.vertices.size());
    upload_surfaces(device, scene, data);
    std::vector<glm::uvec2> influences;
    for (const Influence& i : scene.influences) influences.emplace_back(i.matrix, bits(i.weight));
    data.rest = gpu::upload_new(device, "rest", rest_vertices(scene));
    data.influences = gpu::upload_new(device, "influences", influences);
    data.morph_positions = gpu::upload_new(device, "morph_positions", padded(scene.morph_positions));
    data.morph_normals = gpu::upload_new(device, "morph_normals", padded(scene.morph_normals));
    return data;
}

std::vector<VertexRun> vertex_runs(const gpu::Device& device, const Geometry& geometry) {
    constexpr uint64_t kAlign = 64;  // 1024 bytes, which any device can bind from.
    const uint64_t most = std::max(kAlign, device.limits().max_storage_range / sizeof(glm::vec4) / kAlign * kAlign);
    std::vector<VertexRun> runs;
    for (uint64_t first = 0; first < geometry.scene->vertex_count; first += most) {
        runs.push_back(
            {static_cast<uint32_t>(first), static_cast<uint32_t>(std::min(most, geometry.scene->vertex_count - first))});
    }
    return runs;
}

Geometry pose_geometry(gpu::Device& device, Programs& programs, const Scene& scene, const std::vector<Pose>& poses) {
    return pose_geometry(device, programs, std::make_shared<SceneData>(upload_scene(device, scene)), poses);
}

Geometry pose_geometry(gpu::Device& device, Programs& programs, std::shared_ptr<const SceneData> scene,
                       const std::vector<Pose>& poses) {
    using gpu::Texel;
    // Each key is bound on its own, so its first byte must lie on the device's alignments.
    uint64_t alignment = std::lcm(device.limits().storage_alignment, device.limits().texel_alignment);
    uint32_t step = static_cast<uint32_t>(std::max<uint64_t>(1, alignment / sizeof(glm::vec4)));
    const SceneData& data = *scene;
    Geometry geometry;
    geometry.scene = std::move(scene);
    geometry.vertex_stride = (data.vertex_count + step - 1) / step * step;
    geometry.segment_count = static_cast<uint32_t>(poses.size()) - 1;

    uint64_t key_bytes = uint64_t(geometry.vertex_stride) * sizeof(glm::vec4);
    geometry.positions = device.allocate("positions", key_bytes * poses.size());
    geometry.normals = device.allocate("normals", key_bytes * poses.size());
    geometry.closed = gpu::upload_new(device, "closed", std::vector<uint32_t>(data.shell_triangles.size()));
    std::vector<gpu::Buffer> palettes, weights;
    gpu::Recorder& recorder = device.recorder();
    const std::vector<VertexRun> runs = vertex_runs(device, geometry);
    for (size_t k = 0; k < poses.size(); ++k) {
        palettes.push_back(gpu::upload_new(device, "palette", poses[k].palette));
        weights.push_back(gpu::upload_new(device, "morph_weights", poses[k].morph_weights));
        for (const VertexRun& run : runs) {
            const uint64_t offset = k * key_bytes + run.first * sizeof(glm::vec4), bytes = run.count * sizeof(glm::vec4);
            recorder.dispatch("pose", programs.get("pose/pose"),
                              bindings({{"rest", &data.rest, Texel::rgba32_uint},
                                        {"influences", &data.influences, Texel::rg32_uint},
                                        {"palette", &palettes.back(), Texel::rgba32_float},
                                        {"morph_positions", &data.morph_positions, Texel::rgba32_float},
                                        {"morph_normals", &data.morph_normals, Texel::rgba32_float},
                                        {"morph_weights", &weights.back(), Texel::r32_float},
                                        {"Positions", &geometry.positions, {}, offset, bytes},
                                        {"Normals", &geometry.normals, {}, offset, bytes}}),
                              shared::PoseParams{run.first, run.count}, groups_of(run.count, 64));
        }
    }
    const uint64_t words = groups_of(data.triangle_count, 32);
    geometry.still = device.allocate("still", (words + 1) * 4);
    recorder.fill("pose", geometry.still, 0);
    recorder.dispatch("pose", programs.get("pose/still"),
                      bindings({{"triangles", &data.triangles, Texel::rgba32_uint},
                                {"positions", &geometry.positions, Texel::rgba32_float},
                                {"Still", &geometry.still}}),
                      shared::BoundsParams{data.triangle_count, geometry.vertex_stride, geometry.segment_count + 1},
                      groups_of(data.triangle_count, 64));
    geometry.still_triangles = recorder.download(geometry.still, words * 4, 4);
    return geometry;
}

GeometryBounds geometry_bounds(gpu::Device& device, Programs& programs, const Geometry& geometry, const Scene& scene,
                               const std::vector<Pose>& poses) {
    struct Box {
        glm::uvec3 lower{0xffffffffu};
        glm::uvec3 upper{0};
        uint32_t not_finite = 0;
    };
    const SceneData& data = *geometry.scene;
    const gpu::Buffer buffer = gpu::upload_new(device, "bounds", std::vector<Box>(data.shell_triangles.size()));
    gpu::Recorder& recorder = device.recorder();
    recorder.dispatch("pose/bounds", programs.get("pose/bounds"),
                      bindings({{"triangles", &data.triangles, gpu::Texel::rgba32_uint},
                                {"shells", &data.shells, gpu::Texel::r32_uint},
                                {"positions", &geometry.positions, gpu::Texel::rgba32_float},
                                {"Boxes", &buffer}}),
                      shared::BoundsParams{data.triangle_count, geometry.vertex_stride, geometry.segment_count + 1},
                      groups_of(data.triangle_count, 64 * shared::kBoundsRun));
    const std::vector<Box> boxes = gpu::download_vector<Box>(device, buffer, data.shell_triangles.size());
    const auto place = [](const glm::uvec3& ordered) {
        return glm::vec3(shared::from_ordered_bits(ordered.x), shared::from_ordered_bits(ordered.y),
                         shared::from_ordered_bits(ordered.z));
    };
    GeometryBounds bounds;
    Box all;
    for (const Box& box : boxes) {
        all.lower = glm::min(all.lower, box.lower);
        all.upper = glm::max(all.upper, box.upper);
        all.not_finite |= box.not_finite;
        if (bounds.shells.size() < data.shell_count()) bounds.shells.push_back({place(box.lower), place(box.upper)});
    }
    if (all.not_finite != 0) bounds_of(scene, poses);  // Which says where.
    bounds.all = {place(all.lower), place(all.upper)};
    return bounds;
}

}  // namespace gnomon
