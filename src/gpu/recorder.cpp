// SPDX-License-Identifier: Apache-2.0
// What may be recorded, checked.
#include <algorithm>
#include <array>
#include <utility>

#include "gpu/bindings.hpp"
#include "gpu/recorder_impl.hpp"

namespace gnomon::gpu {
namespace {

struct Job {
    std::string pace_key;
    std::vector<Descriptor> descriptors;
    std::vector<Access> accesses;
};

// Errors: see Recorder::dispatch.
Job checked_job(std::string_view stage, const Device::Impl& device, const Program& program, std::span<const Binding> bindings,
                std::span<const std::byte> params) {
    if (!program) fail_stage(stage, "the program is empty");
    const Program::Impl& code = *program.impl();
    if (code.device.get() != &device) fail_stage(stage, "program '" + code.name + "' is of another device");
    if (params.size() != code.reflection.push_constant_bytes) {
        fail_stage(stage, std::to_string(params.size()) + " bytes of parameters, the shader takes " +
                              std::to_string(code.reflection.push_constant_bytes));
    }
    Job job{std::string(stage) + " " + code.key, bind_resources(stage, code, bindings), {}};
    for (const Descriptor& d : job.descriptors) {
        job.accesses.push_back({d.owner, d.offset, d.offset + d.bytes, d.resource->writable});
    }
    return job;
}

void check_groups(std::string_view stage, const Limits& limits, uint64_t groups) {
    const uint64_t most = limits.max_groups;
    if (groups <= most * most) return;
    fail_stage(stage, std::to_string(groups) + " workgroups, of which the device runs at most " + std::to_string(most) +
                          " by " + std::to_string(most));
}

// Keeps what the job needs, and gives what records all of it but the dispatch itself.
Recorder::Impl::Record bind_job(Recorder::Impl& impl, const Job& job, const Program& program, std::span<const Binding> bindings,
                                std::span<const std::byte> params) {
    const std::shared_ptr<Program::Impl>& code = program.impl();
    impl.in_use.push_back(code);
    for (const Binding& binding : bindings) impl.in_use.push_back(binding.buffer->impl());
    const VkDescriptorSet set = impl.state->sets.make(code->set_layout.get(), job.descriptors);
    return [&code, set, params](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, code->pipeline.get());
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, code->layout.get(), 0, 1, &set, 0, nullptr);
        if (params.empty()) return;
        vkCmdPushConstants(commands, code->layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<uint32_t>(params.size()),
                           params.data());
    };
}

void add_grid(Recorder::Impl& impl, std::string_view stage, const Job& job, const Grid& grid,
              const Recorder::Impl::Record& bind) {
    impl.add_pieces(stage, job.pace_key, grid, job.accesses, [&](VkCommandBuffer commands, uint32_t first_row, uint32_t rows) {
        bind(commands);
        vkCmdDispatchBase(commands, 0, first_row, 0, static_cast<uint32_t>(grid.x), rows, 1);
    });
}

}  // namespace

Recorder::Recorder(Device& device) : impl_(std::make_unique<Impl>(device.impl())) {}
Recorder::~Recorder() = default;

Recorder& Device::recorder() {
    if (!recorder_) {
        recorder_ = std::make_unique<Recorder>(*this);
        impl_->shared_recorder = recorder_->impl_.get();
    }
    return *recorder_;
}

void Recorder::dispatch_bytes(std::string_view stage, const Program& program, std::span<const Binding> bindings,
                              std::span<const std::byte> params, uint64_t groups) {
    const Device::Impl& device = *impl_->device;
    const Job job = checked_job(stage, device, program, bindings, params);
    if (groups == 0) return;
    check_groups(stage, device.limits, groups);
    const Impl::Record bind = bind_job(*impl_, job, program, bindings, params);
    add_grid(*impl_, stage, job, spread_groups(groups, device.limits.max_groups, device.pace.longest_row(job.pace_key)), bind);
}

void Recorder::dispatch_indirect_bytes(std::string_view stage, const Program& program, std::span<const Binding> bindings,
                                       std::span<const std::byte> params, const Buffer& arguments, uint64_t offset,
                                       uint64_t most_groups) {
    constexpr uint64_t kBytes = sizeof(VkDispatchIndirectCommand);
    Device::Impl& device = *impl_->device;
    Job job = checked_job(stage, device, program, bindings, params);
    const Buffer::Impl& source = checked_buffer(stage, device, arguments, "the arguments' buffer");
    const std::string name = "the arguments in buffer " + source.name;
    checked_range(stage, name, offset, kBytes, source.bytes, sizeof(uint32_t));
    for (const Descriptor& d : job.descriptors) {
        const bool overlap = d.owner == &source && d.offset < offset + kBytes && offset < d.offset + d.bytes;
        if (overlap && d.resource->writable)
            fail_stage(stage, "'" + d.resource->name + "' overlaps " + name + " and may be written");
    }
    check_groups(stage, device.limits, most_groups);
    if (most_groups == 0) return;
    const Impl::Record bind = bind_job(*impl_, job, program, bindings, params);
    const double seconds = device.pace.next(job.pace_key, most_groups).seconds;
    impl_->make_time(seconds);
    const auto values = impl_->fetch_new(arguments.impl(), offset, kBytes);
    if (device.pace.fits(job.pace_key, most_groups)) {
        job.accesses.push_back({&source, offset, offset + kBytes, false});
        impl_->add({std::string(stage), job.pace_key, most_groups, seconds, 1, values}, job.accesses,
                   [&](VkCommandBuffer commands) {
                       bind(commands);
                       // lavapipe lets an indirect dispatch begin where the dispatch before it did: here, from zero.
                       vkCmdDispatch(commands, 0, 0, 0);
                       vkCmdDispatchIndirect(commands, source.memory.buffer.get(), offset);
                   });
        return;
    }
    // Only what the host knows can be cut.
    impl_->flush();
    const Grid grid = checked_arguments(stage, values->data, most_groups);
    if (grid.x == 0 || grid.y == 0) {
        device.add_stage_time(std::string(stage), 0.0, 1, impl_->marked);
    } else {
        add_grid(*impl_, stage, job, grid, bind);
    }
}

void Recorder::fill(std::string_view stage, const Buffer& buffer, uint32_t value, uint64_t offset, uint64_t bytes) {
    const Buffer::Impl& target = checked_buffer(stage, *impl_->device, buffer, "the fill");
    const std::string name = "buffer " + target.name;
    const uint64_t range = checked_range(stage, name, offset, bytes, target.capacity, sizeof(uint32_t));
    if (range % sizeof(uint32_t) != 0) fail_stage(stage, "a fill of " + std::to_string(range) + " bytes of " + name);
    impl_->in_use.push_back(buffer.impl());
    const std::array accesses{Access{&target, offset, offset + range, true}};
    impl_->add({.stage = std::string(stage)}, accesses,
               [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, target.memory.buffer.get(), offset, range, value); });
}

void Recorder::copy(std::string_view stage, const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
                    uint64_t bytes) {
    const Buffer::Impl& source = checked_buffer(stage, *impl_->device, from, "the copy's source");
    const Buffer::Impl& target = checked_buffer(stage, *impl_->device, to, "the copy's target");
    if (bytes == 0) return;
    checked_range(stage, "buffer " + source.name, from_offset, bytes, source.bytes, 1);
    checked_range(stage, "buffer " + target.name, to_offset, bytes, target.bytes, 1);
    const bool overlap = &source == &target && from_offset < to_offset + bytes && to_offset < from_offset + bytes;
    if (overlap) fail_stage(stage, "a copy within buffer " + source.name + " between ranges that overlap");
    impl_->in_use.push_back(from.impl());
    impl_->in_use.push_back(to.impl());
    impl_->add_copy(std::string(stage), {&source, from_offset, from_offset + bytes, false}, source.memory.buffer.get(),
                    {&target, to_offset, to_offset + bytes, true}, target.memory.buffer.get());
}

void Recorder::upload(const Buffer& buffer, std::span<const std::byte> data, uint64_t offset) {
    impl_->upload(checked_transfer(*impl_->device, buffer, offset, data.size(), "upload"), data, offset);
}

Download Recorder::download(const Buffer& buffer, uint64_t offset, uint64_t bytes) {
    Download download;
    download.state_ = impl_->fetch_new(checked_transfer(*impl_->device, buffer, offset, bytes, "download"), offset, bytes);
    return download;
}

bool Recorder::mark(bool on) { return std::exchange(impl_->marked, on); }

void Recorder::download(const Buffer& buffer, std::span<std::byte> data, uint64_t offset) {
    download(buffer, std::span(&data, 1), offset);
}

void Recorder::download(const Buffer& buffer, std::span<const std::span<std::byte>> parts, uint64_t offset) {
    for (const std::span<std::byte>& part : parts) {
        const auto& source = checked_transfer(*impl_->device, buffer, offset, part.size(), "download");
        if (!part.empty()) impl_->fetch(source, offset, part.size(), part.data(), nullptr);
        offset += part.size();
    }
    submit();
}

void Recorder::submit() {
    impl_->flush();
    impl_->state->sets.reset();
    impl_->in_use.clear();
    impl_->device->throw_new_messages();
}

bool Download::ready() const { return state_ && state_->ready; }

std::span<const std::byte> Download::bytes() const {
    const std::string hint = "fix the code that reads it";
    if (!state_) throw Error(ErrorKind::internal, "an empty download is read", "", hint);
    if (!state_->ready)
        throw Error(ErrorKind::internal, "a download is read before it was submitted", "buffer " + state_->name, hint);
    return state_->data;
}

void upload(Device& device, const Buffer& buffer, std::span<const std::byte> data, uint64_t offset) {
    device.recorder().upload(buffer, data, offset);
}

void download(Device& device, const Buffer& buffer, std::span<std::byte> data, uint64_t offset) {
    device.recorder().download(buffer, data, offset);
}

}  // namespace gnomon::gpu
