// SPDX-License-Identifier: Apache-2.0
// The command buffer of a recorder: barriers, labels, timestamps, pieces, copies from and to the host.
#include <algorithm>
#include <array>
#include <cstring>

#include "gpu/bindings.hpp"
#include "gpu/copies.hpp"
#include "gpu/recorder_impl.hpp"

namespace gnomon::gpu {
namespace {

constexpr uint64_t kStagingAlignment = 16;

bool may_merge(const Recorder::Impl::Span& a, const Recorder::Impl::Span& b, double most_seconds) {
    return a.stage == b.stage && a.marked == b.marked && a.pace_key == b.pace_key && !a.arguments && !b.arguments &&
           a.expected + b.expected <= most_seconds;
}

}  // namespace

Recorder::Impl::Impl(const std::shared_ptr<Device::Impl>& owner) : device(owner), state(owner->take_state()) {}

Recorder::Impl::~Impl() { device->put_back(std::move(state)); }

void Recorder::Impl::begin() {
    if (recording) return;
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(state->commands.buffer, &info), "begin a command buffer");
    recording = true;
    record_barrier(state->commands.buffer);  // what the submissions before wrote
    state->timestamps.record(state->commands.buffer);
}

void Recorder::Impl::add(Span what, std::span<const Access> accesses, const Record& record_command) {
    for (const Access& access : accesses) {
        if (access.write) stage_before(access);
    }
    begin();
    what.marked = marked;
    const VkCommandBuffer commands = state->commands.buffer;
    for (const Access& access : accesses) used.insert(access.buffer);
    expected += what.expected;
    const bool barrier = hazards.add(accesses);
    if (!spans.empty() && !barrier && may_merge(spans.back(), what, device->pace.merged_seconds())) {
        spans.back().groups += what.groups;
        spans.back().expected += what.expected;
        spans.back().dispatches += what.dispatches;
    } else {
        if (!spans.empty()) state->timestamps.record(commands);
        spans.push_back(std::move(what));
    }
    if (barrier) record_barrier(commands);
    const Instance& instance = device->instance;
    const std::string& stage = spans.back().stage;
    if (instance.begin_label) {
        const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                         .pLabelName = stage.empty() ? "transfer" : stage.c_str()};
        instance.begin_label(commands, &label);
    }
    record_command(commands);
    if (instance.end_label) instance.end_label(commands);
}

void Recorder::Impl::make_time(double seconds) {
    if (recording && expected + seconds > device->pace.submission_seconds()) flush();
}

void Recorder::Impl::add_pieces(std::string_view stage, const std::string& pace_key, const Grid& grid,
                                std::span<const Access> accesses,
                                const std::function<void(VkCommandBuffer, uint32_t, uint32_t)>& record_piece) {
    for (uint64_t row = 0; row < grid.y;) {
        const uint64_t left = (grid.y - row) * grid.x;
        make_time(device->pace.next(pace_key, left).seconds);
        // Without timestamps only what runs alone is measured.
        if (!device->limits.timestamps && device->pace.next(pace_key, left).probe) flush();
        const Pace::Piece piece = device->pace.next(pace_key, left);
        const uint64_t rows = std::clamp<uint64_t>(piece.groups / grid.x, 1, grid.y - row);
        add({std::string(stage), pace_key, rows * grid.x, piece.seconds, row == 0 ? 1u : 0u, nullptr}, accesses,
            [&](VkCommandBuffer commands) { record_piece(commands, static_cast<uint32_t>(row), static_cast<uint32_t>(rows)); });
        row += rows;
        if (piece.probe && row < grid.y) flush();
    }
}

void Recorder::Impl::add_copy(const std::string& stage, const Access& from, VkBuffer from_handle, const Access& to,
                              VkBuffer to_handle) {
    const VkBufferCopy region{.srcOffset = from.begin, .dstOffset = to.begin, .size = from.end - from.begin};
    add({.stage = stage}, std::array{from, to},
        [&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, from_handle, to_handle, 1, &region); });
}

const Memory& Recorder::Impl::staging() {
    constexpr VkMemoryPropertyFlags kCoherent = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr std::array kPreferences{kCoherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kCoherent};
    if (!state->staging.mapped) {
        state->staging = device->make_memory(
            "staging", kStagingBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kPreferences, true);
    }
    return state->staging;
}

void Recorder::Impl::upload(const std::shared_ptr<Buffer::Impl>& buffer, std::span<const std::byte> data, uint64_t offset) {
    if (data.empty()) return;
    if (buffer->memory.mapped && !used.contains(buffer.get())) {
        std::memcpy(buffer->memory.mapped + offset, data.data(), data.size());
        return;
    }
    in_use.push_back(buffer);
    stage_before({buffer.get(), offset, offset + data.size(), true});  // it may take staging memory, and free all
    const Memory& memory = staging();
    for (uint64_t at = 0; at < data.size();) {
        if (staged == kStagingBytes) flush();
        const uint64_t bytes = std::min<uint64_t>(kStagingBytes - staged, data.size() - at);
        const uint64_t place = staged;
        staged += (bytes + kStagingAlignment - 1) / kStagingAlignment * kStagingAlignment;
        std::memcpy(memory.mapped + place, data.data() + at, bytes);
        add_copy("", {&memory, place, place + bytes, false}, memory.buffer.get(),
                 {buffer.get(), offset + at, offset + at + bytes, true}, buffer->memory.buffer.get());
        at += bytes;
    }
}

void Recorder::Impl::fetch(const std::shared_ptr<Buffer::Impl>& buffer, uint64_t offset, uint64_t bytes, std::byte* to,
                           const std::shared_ptr<Download::State>& download) {
    in_use.push_back(buffer);
    if (buffer->memory.mapped) {
        used.insert(buffer.get());
        fetches.push_back({buffer, offset, bytes, to, download, std::nullopt});
        return;
    }
    const Memory& memory = staging();
    for (uint64_t at = 0; at < bytes;) {
        if (staged == kStagingBytes) flush();
        const uint64_t part = std::min<uint64_t>(kStagingBytes - staged, bytes - at);
        const uint64_t place = staged;
        staged += (part + kStagingAlignment - 1) / kStagingAlignment * kStagingAlignment;
        add_copy("", {buffer.get(), offset + at, offset + at + part, false}, buffer->memory.buffer.get(),
                 {&memory, place, place + part, true}, memory.buffer.get());
        fetches.push_back({buffer, offset + at, part, to + at, at + part == bytes ? download : nullptr, place});
        at += part;
    }
}

std::shared_ptr<Download::State> Recorder::Impl::fetch_new(const std::shared_ptr<Buffer::Impl>& buffer, uint64_t offset,
                                                           uint64_t bytes) {
    auto download = std::make_shared<Download::State>();
    download->name = buffer->name;
    download->data.resize(bytes);
    download->ready = bytes == 0;
    if (bytes > 0) fetch(buffer, offset, bytes, download->data.data(), download);
    return download;
}

void Recorder::Impl::stage_before(const Access& write) {
    for (size_t i = 0; i < fetches.size(); ++i) {
        const Fetch& f = fetches[i];
        const bool overlap = f.buffer.get() == write.buffer && f.offset < write.end && write.begin < f.offset + f.bytes;
        if (f.staged_at || !overlap) continue;
        if (f.bytes > kStagingBytes - staged) {
            flush();
            return;
        }
        const Memory& memory = staging();
        const uint64_t place = staged;
        staged += (f.bytes + kStagingAlignment - 1) / kStagingAlignment * kStagingAlignment;
        add_copy("", {f.buffer.get(), f.offset, f.offset + f.bytes, false}, f.buffer->memory.buffer.get(),
                 {&memory, place, place + f.bytes, true}, memory.buffer.get());
        fetches[i].staged_at = place;
    }
}

void Recorder::Impl::finish_fetches() {
    std::vector<Copy> copies;
    for (const Fetch& f : fetches) {
        const std::byte* from = f.staged_at ? state->staging.mapped + *f.staged_at : f.buffer->memory.mapped + f.offset;
        copies.push_back({from, f.to, f.bytes});
    }
    copy_all(copies);
    for (const Fetch& f : fetches) {
        if (f.state) f.state->ready = true;
    }
}

void Recorder::Impl::flush() {
    if (device->shared_recorder && device->shared_recorder != this) device->shared_recorder->flush();
    try {
        if (recording) {
            state->timestamps.record(state->commands.buffer);
            record_host_barrier(state->commands.buffer);
            check(vkEndCommandBuffer(state->commands.buffer), "end a command buffer");
            const double seconds = device->submit_and_wait(state->commands.buffer);
            finish_fetches();
            account(seconds);
            if (device->after_submission) device->after_submission();
            check(vkResetCommandPool(device->device.get(), state->commands.pool.get(), 0), "reset a command pool");
        } else {
            finish_fetches();
        }
    } catch (...) {
        reset();
        throw;
    }
    forget();
}

// A timestamp is of when all before it is done, so that what overlaps counts to the earlier stage and the sum of all stages is
// the time that all took. Without timestamps what ran together is given parts of the time as it was expected to take.
void Recorder::Impl::account(double wall_seconds) {
    const bool measured = device->limits.timestamps;
    const double scale = expected > 0.0 ? wall_seconds / expected : 0.0;
    const std::vector<double> seconds = state->timestamps.seconds_between();
    for (size_t i = 0; i < spans.size(); ++i) {
        const Span& span = spans[i];
        if (!span.stage.empty()) device->add_stage_time(span.stage, seconds[i], span.dispatches, span.marked);
        if (span.pace_key.empty()) continue;
        uint64_t groups = span.groups;
        if (span.arguments) {
            const Grid grid = checked_arguments(span.stage, span.arguments->data, groups);
            groups = grid.x * grid.y;
        }
        if (groups == 0) continue;
        const double estimate = measured ? seconds[i] : spans.size() == 1 ? wall_seconds : scale * span.expected;
        device->pace.measured(span.pace_key, groups, estimate);
        device->longest_dispatch_seconds = std::max(device->longest_dispatch_seconds, estimate);
    }
}

void Recorder::Impl::forget() {
    recording = false;
    spans.clear();
    expected = 0.0;
    hazards.clear();
    used.clear();
    fetches.clear();
    staged = 0;
    state->timestamps.reset();
}

void Recorder::Impl::reset() {
    forget();
    check(vkResetCommandPool(device->device.get(), state->commands.pool.get(), 0), "reset a command pool");
    state->sets.reset();
    in_use.clear();
}

}  // namespace gnomon::gpu
