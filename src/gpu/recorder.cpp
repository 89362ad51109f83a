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

    /// A command, or a piece of one.
    struct Recorded {
        std::string stage;
        std::string pace_key;  // of dispatches
        uint64_t groups = 0;
        double expected = 0.0;  // seconds
        bool first_piece = true;
    };

    /// Add one command; record_command(commands) records it.
    template <class Record>
    void add(Recorded what, Record record_command);
    /// Add a dispatch of the grid, in pieces where it may take long; record_piece(commands, first_row, rows) records one.
    template <class Record>
    void add_pieces(std::string_view stage, const Program::Impl& program, const Grid& grid, Record record_piece);
    void begin();
    /// Run what is recorded and wait; what it needs stays.
    void flush();
    void account(double wall_seconds);
    void reset();
    /// The buffer's Impl, kept until the work is done. Errors: an empty buffer, another device's.
    Buffer::Impl& use(std::string_view stage, const Buffer& buffer, const std::string& name);

    std::shared_ptr<Device::Impl> device;
    Commands commands;
    bool recording = false;
    DescriptorSets sets;
    Timestamps timestamps;
    std::vector<Recorded> recorded;  // since the last flush, in order
    double expected = 0.0;           // seconds, of these
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
void Recorder::Impl::add(Recorded what, Record record_command) {
    begin();
    expected += what.expected;
    const std::string& name = recorded.emplace_back(std::move(what)).stage;
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

template <class Record>
void Recorder::Impl::add_pieces(std::string_view stage, const Program::Impl& program, const Grid& grid, Record record_piece) {
    const std::string key = std::string(stage) + " " + program.key;
    for (uint64_t row = 0; row < grid.y;) {
        const Pace::Piece piece = device->pace.next(key, (grid.y - row) * grid.x);
        // Without timestamps only what runs alone is measured.
        const bool alone = piece.probe && !device->limits.timestamps;
        if (recording && (alone || expected + piece.seconds > device->pace.submission_seconds())) {
            flush();
            continue;
        }
        const uint64_t rows = std::clamp<uint64_t>(piece.groups / grid.x, 1, grid.y - row);
        add({std::string(stage), key, rows * grid.x, piece.seconds, row == 0},
            [&](VkCommandBuffer buffer) { record_piece(buffer, static_cast<uint32_t>(row), static_cast<uint32_t>(rows)); });
        row += rows;
        if (piece.probe && row < grid.y) flush();
    }
}

void Recorder::Impl::flush() {
    if (!recording) return;
    try {
        record_host_barrier(commands.buffer);
        check(vkEndCommandBuffer(commands.buffer), "end a command buffer");
        account(device->submit_and_wait(commands.buffer));
        check(vkResetCommandPool(device->device.get(), commands.pool.get(), 0), "reset a command pool");
    } catch (...) {
        reset();
        throw;
    }
    recording = false;
    recorded.clear();
    expected = 0.0;
    timestamps.reset();
}

// Without timestamps what ran together is given parts of the time as it was expected to take.
void Recorder::Impl::account(double wall_seconds) {
    const bool measured = device->limits.timestamps;
    const double scale = expected > 0.0 ? wall_seconds / expected : 0.0;
    const std::vector<double> seconds = timestamps.seconds_between_pairs();
    for (size_t i = 0; i < recorded.size(); ++i) {
        const Recorded& what = recorded[i];
        device->add_stage_time(what.stage, seconds[i], what.first_piece ? 1 : 0);
        if (what.pace_key.empty()) continue;
        const double estimate = measured ? seconds[i] : recorded.size() == 1 ? wall_seconds : scale * what.expected;
        device->pace.measured(what.pace_key, what.groups, estimate);
        device->longest_dispatch_seconds = std::max(device->longest_dispatch_seconds, estimate);
    }
}

void Recorder::Impl::reset() {
    recording = false;
    recorded.clear();
    expected = 0.0;
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
    const Grid grid = spread_groups(groups, max_groups, impl_->device->pace.longest_row(std::string(stage) + " " + code->key));
    if (grid.x > max_groups) {
        fail_stage(stage, std::to_string(groups) + " workgroups, of which the device runs at most " +
                              std::to_string(max_groups) + " by " + std::to_string(max_groups));
    }
    impl_->in_use.push_back(code);
    for (const Binding& binding : bindings) impl_->in_use.push_back(binding.buffer->impl());
    const VkDescriptorSet set = impl_->sets.make(code->set_layout.get(), descriptors);
    impl_->add_pieces(stage, *code, grid, [&](VkCommandBuffer commands, uint32_t first_row, uint32_t rows) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, code->pipeline.get());
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, code->layout.get(), 0, 1, &set, 0, nullptr);
        if (!params.empty()) {
            vkCmdPushConstants(commands, code->layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                               static_cast<uint32_t>(params.size()), params.data());
        }
        vkCmdDispatchBase(commands, 0, first_row, 0, static_cast<uint32_t>(grid.x), rows, 1);
    });
}

void Recorder::fill(std::string_view stage, const Buffer& buffer, uint32_t value, uint64_t offset, uint64_t bytes) {
    Buffer::Impl& target = impl_->use(stage, buffer, "the fill");
    const std::string name = "buffer " + target.name;
    const uint64_t range = checked_range(stage, name, offset, bytes, target.capacity, sizeof(uint32_t));
    if (range % sizeof(uint32_t) != 0) fail_stage(stage, "a fill of " + std::to_string(range) + " bytes of " + name);
    impl_->add({std::string(stage)},
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
    impl_->add({std::string(stage)}, [&](VkCommandBuffer commands) {
        const VkBufferCopy region{.srcOffset = from_offset, .dstOffset = to_offset, .size = bytes};
        vkCmdCopyBuffer(commands, source.memory.buffer.get(), target.memory.buffer.get(), 1, &region);
    });
}

void Recorder::submit() {
    Impl& impl = *impl_;
    impl.flush();
    impl.sets.reset();
    impl.in_use.clear();
    impl.device->throw_new_messages();
}

}  // namespace gnomon::gpu
