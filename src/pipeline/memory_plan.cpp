// SPDX-License-Identifier: Apache-2.0
#include "pipeline/memory_plan.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

namespace gnomon {
namespace {

// Enough samples to keep any device busy. On a CPU the buffers of a batch stay small; elsewhere each batch is a submission that
// is waited for.
constexpr uint64_t kBatchSlots = 1u << 20;
constexpr uint64_t kGpuBatchSlots = 16u << 20;
constexpr uint64_t kSlotBytes = 24;
constexpr uint64_t kAskBytes = 24;

// A window of a tile, a batch of a few samples, and what is binned with them; more for larger scenes, which would take hours in
// so little.
constexpr uint64_t kLeastWorkBytes = 4u << 20;
constexpr uint64_t kLeastWorkShare = 16;

bool same(const Rigid& a, const Rigid& b) { return a.translation == b.translation && a.rotation == b.rotation; }

// What has to be in memory whole, and be read through one binding.
struct SceneBuffer {
    const char* what;
    uint64_t elements = 0;
    uint64_t bytes = 0;  // Of an element.
    const char* hint;
};

constexpr const char* kSmallerScene = "use a smaller scene";
constexpr const char* kFewerKeys = "use fewer --time-steps or a smaller scene";

std::vector<SceneBuffer> scene_buffers(const Scene& scene, uint64_t keys) {
    uint64_t texels = 0;
    for (const Image& image : scene.images) texels += uint64_t(image.width) * image.height;
    const uint64_t vertices = scene.vertices.size() + 64;  // Rounded up to keep bindings aligned.
    return {{"triangles", scene.triangles.size() + 1, 16, kSmallerScene},
            {"numbers of shells", scene.triangles.size(), 4, kSmallerScene},
            {"positions (vertices times poses)", vertices * keys, 16, kFewerKeys},
            {"normals (vertices times poses)", vertices * keys, 16, kFewerKeys},
            {"vertex attributes", 2 * vertices, 16, kSmallerScene},
            {"materials", 2 * scene.materials.size(), 16, kSmallerScene},
            {"texels of decoded textures, four at a time,", (texels + 3) / 4, 16, "use smaller or fewer textures"},
            {"vertices at rest", 3 * vertices, 16, kSmallerScene},
            {"joint weights", scene.influences.size(), 8, kSmallerScene},
            {"morph target positions", scene.morph_positions.size(), 16, kSmallerScene},
            {"morph target normals", scene.morph_normals.size(), 16, kSmallerScene}};
}

uint64_t bytes_of(const std::vector<SceneBuffer>& buffers) {
    uint64_t bytes = 0;
    for (const SceneBuffer& b : buffers) bytes += b.elements * b.bytes;
    return bytes;
}

}  // namespace

void check_turns(const Scene& scene) {
    uint32_t targets = 0, influences = 0;
    for (const Morph& morph : scene.morphs) targets = std::max(targets, morph.target_count);
    for (const Vertex& vertex : scene.vertices) influences = std::max(influences, vertex.influence_count);
    if (uint64_t(targets) + influences >= shared::kMostTurns) {
        throw Error(ErrorKind::input, std::to_string(targets) + " morph targets of a mesh", scene.path.string(),
                    "use fewer than " + std::to_string(shared::kMostTurns - influences));
    }
}

void check_scene(const gpu::Device& device, const Scene& scene, uint64_t keys, uint64_t budget) {
    const gpu::Limits& limits = device.limits();
    const std::vector<SceneBuffer> buffers = scene_buffers(scene, keys);
    for (const SceneBuffer& b : buffers) {
        const uint64_t most = std::min(limits.most_elements(b.bytes), limits.max_buffer_bytes / b.bytes - 1);
        if (b.elements <= most) continue;
        throw Error(ErrorKind::out_of_memory,
                    std::to_string(b.elements) + " " + b.what + " are more than the " + std::to_string(most) +
                        " that the device can bind",
                    scene.path.string(), b.hint);
    }
    // The camera's view of the vertices, and one light's.
    const uint64_t views = (scene.lights.empty() ? 1 : 2) * buffers[2].elements * buffers[2].bytes;
    const uint64_t data = bytes_of(buffers) + views;
    const uint64_t needed = data + std::max(kLeastWorkBytes, data / kLeastWorkShare);
    if (needed <= budget) return;
    const uint64_t mebibytes = needed / (1u << 20) + 1;
    throw Error(ErrorKind::out_of_memory, "the scene's own data takes " + std::to_string(mebibytes) + " MiB of device memory",
                scene.path.string(),
                "use --memory-budget " + std::to_string(mebibytes) + "M or more; the device says that it has " +
                    std::to_string(limits.heap_bytes >> 20) + " MiB");
}

bool is_still(const std::vector<Pose>& poses) {
    const Pose& first = poses.front();
    return std::all_of(poses.begin(), poses.end(), [&](const Pose& p) {
        return p.palette == first.palette && p.morph_weights == first.morph_weights &&
               std::equal(p.cameras.begin(), p.cameras.end(), first.cameras.begin(), same) &&
               std::equal(p.lights.begin(), p.lights.end(), first.lights.begin(), same);
    });
}

bool lights_still(const std::vector<Pose>& poses) {
    const Pose& first = poses.front();
    return std::all_of(poses.begin(), poses.end(),
                       [&](const Pose& p) { return std::equal(p.lights.begin(), p.lights.end(), first.lights.begin(), same); });
}

uint64_t batch_slots(const gpu::Device& device, const View& view, uint32_t spp, uint32_t lit_planes, bool asks,
                     uint64_t bytes) {
    const gpu::Limits& limits = device.limits();
    const uint64_t all = uint64_t(tiles_across(view)) * tiles_down(view) * spp * shared::kTileTexels;
    const uint64_t slot_bytes = kSlotBytes + 4 * uint64_t(lit_planes - 1) + (asks ? kAskBytes : 0);
    const uint64_t most = std::min({limits.is_cpu ? kBatchSlots : kGpuBatchSlots, all, bytes / slot_bytes,
                                    limits.max_storage_range / (asks ? 16 : 8), limits.most_elements(4) / lit_planes});
    return std::max<uint64_t>(most / shared::kTileTexels, 1) * shared::kTileTexels;
}

uint64_t film_tiles(const gpu::Device& device, uint32_t planes, uint64_t bytes) {
    return std::max<uint64_t>(
        1, std::min(device.limits().max_storage_range, bytes) / (uint64_t(planes) * shared::kTileTexels * sizeof(float)));
}

std::vector<Batch> split_batches(const Window& window, uint32_t spp, uint64_t most_slots, uint32_t most_strata) {
    uint64_t items = most_slots / shared::kTileTexels;
    uint32_t strata = static_cast<uint32_t>(std::min<uint64_t>({spp, items, most_strata}));
    uint32_t tile_step = static_cast<uint32_t>(std::min<uint64_t>(window.tile_count, items / strata));
    std::vector<Batch> batches;
    for (uint32_t s = 0; s < spp; s += strata) {
        for (uint32_t tile = 0; tile < window.tile_count; tile += tile_step) {
            batches.push_back(
                {window.tile_first + tile, std::min(tile_step, window.tile_count - tile), s, std::min(strata, spp - s)});
        }
    }
    return batches;
}

bool can_halve(const Batch& batch) { return batch.tile_count > 1 || batch.stratum_count > 1; }

void halve(std::vector<Batch>& batches, size_t first) {
    std::vector<Batch> halves(batches.begin(), batches.begin() + static_cast<std::ptrdiff_t>(first));
    for (size_t b = first; b < batches.size(); ++b) {
        const Batch& batch = batches[b];
        Batch low = batch, high = batch;
        if (batch.tile_count > 1) {
            low.tile_count /= 2;
            high.tile_count -= low.tile_count;
            high.tile_first += low.tile_count;
        } else {
            low.stratum_count /= 2;
            high.stratum_count -= low.stratum_count;
            high.stratum_first += low.stratum_count;
        }
        if (can_halve(batch)) halves.push_back(low);
        halves.push_back(high);
    }
    batches = std::move(halves);
}

}  // namespace gnomon
