// SPDX-License-Identifier: Apache-2.0
// Records commands with barriers, labels and timestamps, and runs them.
#include <algorithm>

#include "gpu/bindings.hpp"
#include "gpu/timestamps.hpp"
#include "gpu/vulkan.hpp"

namespace gnomon::gpu {

struct Recorder::Impl {
    explicit Impl(const std::shared_ptr<Device::Impl>& owner);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// Add one command to the stage; record_command(commands) records it.
    template <class Record>
    void add(std::string_view stage, Record record_command);
    void begin();
    void reset();
    /// The buffer's Impl, kept until the work is done. Errors: an empty buffer, another device's.
    Buffer::Impl& use(std::string_view stage, const Buffer& buffer, const std::string& name);

    std::shared_ptr<Device::Impl> device;
    Commands commands;
    bool recording = false;
    DescriptorSets sets;
    Timestamps timestamps;
    std::vector<std::string> stages;  // of the commands recorded, in order
    std::vector<std::shared_ptr<const void>> in_use;
};

Recorder::Impl::Impl(const std::shared_ptr<Device::Impl>& owner)
    : device(owner), commands(owner->take_commands()), sets(*owner), timestamps(*owner) {}

Recorder::Impl::~Impl() { device->put_back(std::move(commands)); }

void Recorder::Impl::begin() {
    if (recording) return;
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands.buffer, &info), "begin a command buffer");
    recording = true;
}

template <class Record>
void Recorder::Impl::add(std::string_view stage, Record record_command) {
    begin();
    const std::string& name = stages.emplace_back(stage);
    const Instance& instance = device->instance;
    if (instance.begin_label) {
        const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = name.c_str()};
        instance.begin_label(commands.buffer, &label);
    }
    record_barrier(commands.buffer);
    timestamps.record(commands.buffer);
    record_command(commands.buffer);
    timestamps.record(commands.buffer);
    if (instance.end_label) instance.end_label(commands.buffer);
}

void Recorder::Impl::reset() {
    recording = false;
    stages.clear();
    timestamps.reset();
    check(vkResetCommandPool(device->device.get(), commands.pool.get(), 0), "reset a command pool");
    sets.reset();
    in_use.clear();
}

Buffer::Impl& Recorder::Impl::use(std::string_view stage, const Buffer& buffer, const std::string& name) {
    Buffer::Impl& impl = checked_buffer(stage, *device, buffer, name);
    in_use.push_back(buffer.impl());
    return impl;
}

Recorder::Recorder(Device& device) : impl_(std::make_unique<Impl>(device.impl())) {}
Recorder::~Recorder() = default;

void Recorder::dispatch_bytes(std::string_view stage, const Program& program, std::span<const Binding> bindings,
                              std::span<const std::byte> params, uint64_t groups) {
    if (!program) fail_stage(stage, "the program is empty");
    const std::shared_ptr<Program::Impl>& code = program.impl();
    if (code->device != impl_->device) fail_stage(stage, "program '" + code->name + "' is of another device");
    const Reflection& reflection = code->reflection;
    if (params.size() != reflection.push_constant_bytes) {
        fail_stage(stage, std::to_string(params.size()) + " bytes of parameters, the shader takes " +
                              std::to_string(reflection.push_constant_bytes));
    }
    const std::vector<Descriptor> descriptors = bind_resources(stage, *code, bindings);
    if (groups == 0) return;
    const uint64_t max_groups = impl_->device->limits.max_groups;
    // Rows of equal length: fewer than y groups run beyond the last.
    const uint64_t y = (groups - 1) / max_groups + 1;
    const uint64_t x = (groups - 1) / y + 1;
    if (y > max_groups) {
        fail_stage(stage, std::to_string(groups) + " workgroups, of which the device runs at most " +
                              std::to_string(max_groups) + " by " + std::to_string(max_groups));
    }
    impl_->in_use.push_back(code);
    for (const Binding& binding : bindings) impl_->in_use.push_back(binding.buffer->impl());
    const VkDescriptorSet set = impl_->sets.make(code->set_layout.get(), descriptors);
    impl_->add(stage, [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, code->pipeline.get());
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, code->layout.get(), 0, 1, &set, 0, nullptr);
        if (!params.empty()) {
            vkCmdPushConstants(commands, code->layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                               static_cast<uint32_t>(params.size()), params.data());
        }
        vkCmdDispatch(commands, static_cast<uint32_t>(x), static_cast<uint32_t>(y), 1);
    });
}

void Recorder::fill(std::string_view stage, const Buffer& buffer, uint32_t value, uint64_t offset, uint64_t bytes) {
    Buffer::Impl& target = impl_->use(stage, buffer, "the fill");
    const std::string name = "buffer " + target.name;
    const uint64_t range = checked_range(stage, name, offset, bytes, target.capacity, sizeof(uint32_t));
    if (range % sizeof(uint32_t) != 0) fail_stage(stage, "a fill of " + std::to_string(range) + " bytes of " + name);
    impl_->add(stage,
               [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, target.memory.buffer.get(), offset, range, value); });
}

void Recorder::copy(std::string_view stage, const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
                    uint64_t bytes) {
    Buffer::Impl& source = impl_->use(stage, from, "the copy's source");
    Buffer::Impl& target = impl_->use(stage, to, "the copy's target");
    if (bytes == 0) return;
    checked_range(stage, "buffer " + source.name, from_offset, bytes, source.bytes, 1);
    checked_range(stage, "buffer " + target.name, to_offset, bytes, target.bytes, 1);
    const bool overlap = &source == &target && from_offset < to_offset + bytes && to_offset < from_offset + bytes;
    if (overlap) fail_stage(stage, "a copy within buffer " + source.name + " between ranges that overlap");
    impl_->add(stage, [&](VkCommandBuffer commands) {
        const VkBufferCopy region{.srcOffset = from_offset, .dstOffset = to_offset, .size = bytes};
        vkCmdCopyBuffer(commands, source.memory.buffer.get(), target.memory.buffer.get(), 1, &region);
    });
}

void Recorder::submit() {
    Impl& impl = *impl_;
    if (!impl.recording) {
        impl.in_use.clear();
        impl.device->throw_new_messages();
        return;
    }
    try {
        record_host_barrier(impl.commands.buffer);
        check(vkEndCommandBuffer(impl.commands.buffer), "end a command buffer");
        impl.device->submit_and_wait(impl.commands.buffer);
        const std::vector<double> seconds = impl.timestamps.seconds_between_pairs();
        for (size_t i = 0; i < seconds.size(); ++i) impl.device->add_stage_time(impl.stages[i], seconds[i]);
    } catch (...) {
        impl.reset();
        throw;
    }
    impl.reset();
}

}  // namespace gnomon::gpu
