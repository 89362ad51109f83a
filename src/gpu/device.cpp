// SPDX-License-Identifier: Apache-2.0
// The logical device: its queue, its limits, running command buffers, statistics.
#include <algorithm>
#include <chrono>
#include <limits>

#include "gpu/recorder_impl.hpp"
#include "gpu/vulkan.hpp"

namespace gnomon::gpu {
namespace {

VkDevice create_device(const Candidate& candidate) {
    VkPhysicalDeviceVulkan13Features features13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                                                .subgroupSizeControl = candidate.subgroup_size_control,
                                                .computeFullSubgroups = VK_TRUE,
                                                .synchronization2 = VK_TRUE,
                                                .maintenance4 = VK_TRUE};
    VkPhysicalDeviceVulkan11Features features11{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES,
                                                .pNext = &features13,
                                                .storageBuffer16BitAccess = candidate.storage_16bit};
    const VkPhysicalDeviceVulkan12Features features12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                                      .pNext = &features11,
                                                      .storageBuffer8BitAccess = candidate.storage_8bit,
                                                      .scalarBlockLayout = VK_TRUE};
    VkPhysicalDeviceShaderSubgroupUniformControlFlowFeaturesKHR control_flow{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_FEATURES_KHR,
        .shaderSubgroupUniformControlFlow = VK_TRUE};
    if (candidate.uniform_control_flow) features13.pNext = &control_flow;
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = candidate.queue_family,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features12,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = static_cast<uint32_t>(candidate.extensions.size()),
                                  .ppEnabledExtensionNames = candidate.extensions.data()};
    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(candidate.physical, &info, nullptr, &device), "open the device", candidate.description.name);
    return device;
}

struct Result {
    ErrorKind kind;
    const char* meaning;
    const char* hint;
};

Result explain(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return {ErrorKind::out_of_memory, "out of host memory", "lower --shadow-res or --size"};
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return {ErrorKind::out_of_memory, "out of device memory", "set a lower --memory-budget or lower --shadow-res"};
        case VK_ERROR_DEVICE_LOST:
            return {ErrorKind::device_lost, "the device was lost",
                    "the driver crashed or stopped work that took too long; try another --device or a newer driver"};
        default:
            return {ErrorKind::internal, "Vulkan call failed", "run with validation to see why"};
    }
}

// Stages and accesses of all that gnomon runs on the device.
constexpr VkPipelineStageFlags2 kStages =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
constexpr VkAccessFlags2 kReads = VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT |
                                  VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT;

void record_memory_barrier(VkCommandBuffer commands, VkPipelineStageFlags2 to_stages, VkAccessFlags2 to_accesses) {
    const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = kStages,
                                   .srcAccessMask = kWrites,
                                   .dstStageMask = to_stages,
                                   .dstAccessMask = to_accesses};
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

void check(VkResult result, std::string_view what, std::string_view where) {
    if (result >= VK_SUCCESS) return;
    const Result explained = explain(result);
    throw Error(explained.kind,
                "cannot " + std::string(what) + ": " + explained.meaning + " (VkResult " +
                    std::to_string(static_cast<int>(result)) + ")",
                std::string(where), explained.hint);
}

void record_barrier(VkCommandBuffer commands) { record_memory_barrier(commands, kStages, kReads | kWrites); }

void record_host_barrier(VkCommandBuffer commands) {
    record_memory_barrier(commands, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

Device::Impl::Impl(const std::string& choice, bool validate)
    : instance(validate), candidate(choose_candidate(instance, choice)), device(create_device(candidate)) {
    vkGetDeviceQueue(device.get(), candidate.queue_family, 0, &queue);
    vkGetPhysicalDeviceMemoryProperties(candidate.physical, &memory_properties);

    VkPhysicalDeviceMaintenance3Properties maintenance3{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &maintenance3};
    vkGetPhysicalDeviceProperties2(candidate.physical, &properties);
    vulkan_limits = properties.properties.limits;
    max_allocation_bytes = maintenance3.maxMemoryAllocationSize;
    limits = candidate.limits;
    pace = Pace(1e-3 * limits.dispatch_ms);

    const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fence = create<OwnedFence>(device.get(), vkCreateFence, fence_info, "a fence");
}

Device::Impl::~Impl() = default;

Commands Device::Impl::take_commands() {
    Commands commands;
    if (!idle_commands.empty()) {
        commands = std::move(idle_commands.back());
        idle_commands.pop_back();
        check(vkResetCommandPool(device.get(), commands.pool.get(), 0), "reset a command pool");
        return commands;
    }
    idle_commands.reserve(++commands_made);  // To put them back needs no memory.
    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                            .queueFamilyIndex = candidate.queue_family};
    commands.pool = create<OwnedCommandPool>(device.get(), vkCreateCommandPool, pool_info, "a command pool");
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = commands.pool.get(),
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    check(vkAllocateCommandBuffers(device.get(), &info, &commands.buffer), "allocate a command buffer");
    return commands;
}

void Device::Impl::put_back(Commands commands) { idle_commands.push_back(std::move(commands)); }

std::unique_ptr<RecorderState> Device::Impl::take_state() {
    if (idle_states.empty()) {
        idle_states.reserve(++states_made);
        return std::make_unique<RecorderState>(*this);
    }
    std::unique_ptr<RecorderState> state = std::move(idle_states.back());
    idle_states.pop_back();
    check(vkResetCommandPool(device.get(), state->commands.pool.get(), 0), "reset a command pool");
    state->sets.reset();
    state->timestamps.reset();
    return state;
}

void Device::Impl::put_back(std::unique_ptr<RecorderState> state) { idle_states.push_back(std::move(state)); }

void Device::Impl::run_once(const std::function<void(VkCommandBuffer)>& record) {
    Commands commands = take_commands();
    const VkCommandBufferBeginInfo begin_info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                              .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands.buffer, &begin_info), "begin a command buffer");
    record_barrier(commands.buffer);
    record(commands.buffer);
    record_host_barrier(commands.buffer);
    check(vkEndCommandBuffer(commands.buffer), "end a command buffer");
    submit_and_wait(commands.buffer);
    put_back(std::move(commands));
}

double Device::Impl::submit_and_wait(VkCommandBuffer commands) {
    throw_new_messages();  // what was recorded wrongly must not run
    ++submissions;
    const VkCommandBufferSubmitInfo buffer_info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                                .commandBuffer = commands};
    const VkSubmitInfo2 info{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2, .commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer_info};
    const auto start = std::chrono::steady_clock::now();
    check(vkQueueSubmit2(queue, 1, &info, fence.get()), "submit work");
    const VkFence wait_for = fence.get();
    check(vkWaitForFences(device.get(), 1, &wait_for, VK_TRUE, std::numeric_limits<uint64_t>::max()),
          "wait for submitted work");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    check(vkResetFences(device.get(), 1, &wait_for), "reset a fence");
    throw_new_messages();
    return seconds.count();
}

void Device::Impl::throw_new_messages() {
    if (messages_thrown == instance.messages.size()) return;
    std::string text;
    for (; messages_thrown < instance.messages.size(); ++messages_thrown) text += " | " + instance.messages[messages_thrown];
    throw Error(ErrorKind::internal, "the Vulkan validation layer reports:" + text, "", "report this as a bug of gnomon");
}

void Device::Impl::set_object_name(VkObjectType type, uint64_t handle, const std::string& name) {
    if (!instance.set_name) return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = handle,
                                             .pObjectName = name.c_str()};
    check(instance.set_name(device.get(), &info), "name an object", name);
}

void Device::Impl::add_live(const std::string& name, uint64_t bytes) {
    uint64_t& live = live_by_name[name];
    uint64_t& largest = largest_by_name[name];  // Nothing is counted where there is no memory to count it in.
    live += bytes;
    live_bytes += bytes;
    peak_bytes = std::max(peak_bytes, live_bytes);
    largest = std::max(largest, bytes);
}

void Device::Impl::remove_live(const std::string& name, uint64_t bytes) {
    live_bytes -= bytes;
    const auto found = live_by_name.find(name);
    found->second -= bytes;
    if (found->second == 0) live_by_name.erase(found);
}

void Device::Impl::add_stage_time(const std::string& stage, double seconds, uint64_t dispatches, bool marked) {
    auto found =
        std::find_if(stage_times.begin(), stage_times.end(), [&](const StageTime& time) { return time.name == stage; });
    if (found == stage_times.end()) found = stage_times.insert(found, {.name = stage});
    found->seconds += seconds;
    found->dispatches += dispatches;
    found->marked_seconds += marked ? seconds : 0.0;
}

Device::Device(const std::string& choice, bool validate) : impl_(std::make_shared<Impl>(choice, validate)) {}
Device::~Device() { impl_->shared_recorder = nullptr; }

const DeviceDescription& Device::description() const { return impl_->candidate.description; }
const Limits& Device::limits() const { return impl_->limits; }
bool Device::has_timestamps() const { return impl_->limits.timestamps; }
const std::vector<std::string>& Device::validation_messages() const { return impl_->instance.messages; }

void Device::set_budget(uint64_t bytes) {
    impl_->budget = bytes;
    impl_->release_memory(impl_->most_held_bytes());
}
uint64_t Device::budget() const { return impl_->budget > 0 ? impl_->budget : impl_->limits.heap_bytes; }
uint64_t Device::budget_left() const { return budget() - std::min(budget(), impl_->live_bytes); }
uint64_t Device::live_bytes() const { return impl_->live_bytes; }
uint64_t Device::peak_bytes() const { return impl_->peak_bytes; }
std::map<std::string, uint64_t> Device::largest_bytes() const { return impl_->largest_by_name; }

std::vector<StageTime> Device::stage_times() const { return impl_->stage_times; }

double Device::longest_dispatch_seconds() const { return impl_->longest_dispatch_seconds; }

uint64_t Device::submissions() const { return impl_->submissions; }

void Device::on_submission(std::function<void()> call) { impl_->after_submission = std::move(call); }

void Device::reset_statistics() {
    recorder().submit();
    impl_->submissions = 0;
    impl_->longest_dispatch_seconds = 0.0;
    impl_->stage_times.clear();
    impl_->peak_bytes = impl_->live_bytes;
    impl_->largest_by_name = impl_->live_by_name;
}

}  // namespace gnomon::gpu
