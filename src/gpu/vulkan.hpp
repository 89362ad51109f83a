// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: errors from results of Vulkan, and what the types of gpu.hpp hold.
#pragma once

#include <functional>
#include <gnomon/error.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "gpu/gpu.hpp"
#include "gpu/owned.hpp"
#include "gpu/pace.hpp"
#include "gpu/pool.hpp"
#include "gpu/reflection.hpp"

namespace gnomon::gpu {

/// Throw unless the result is a success. `what` completes "cannot ...". Errors: out_of_memory, device_lost, else internal.
void check(VkResult result, std::string_view what, std::string_view where = "");

/// vkCreate...(device, &info, nullptr, &handle) as an Owned.
template <class OwnedT, class Create, class Info>
OwnedT create(VkDevice device, Create create_function, const Info& info, const std::string& what, std::string_view where = "") {
    decltype(std::declval<OwnedT>().get()) handle = VK_NULL_HANDLE;
    check(create_function(device, &info, nullptr, &handle), "create " + what, where);
    return OwnedT(device, handle);
}

/// A buffer with its memory; `mapped` where the host can see it.
struct Memory {
    MemoryPool::Piece piece;  // before the buffer, so that the buffer goes first
    OwnedBuffer buffer;
    std::byte* mapped = nullptr;
};

/// A VkInstance with the validation layer if asked for. No handle where there is no driver.
struct Instance {
    explicit Instance(bool validate);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle = VK_NULL_HANDLE;
    std::vector<std::string> messages;                       ///< Of the validation layer.
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;  ///< These three only with VK_EXT_debug_utils.
    PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT set_name = nullptr;

private:
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

/// How many invocations are a subgroup. A compiler may choose for each SPIR-V 1.6 shader by itself, from Vulkan's
/// minSubgroupSize to `most`, unless it is told.
struct SubgroupSize {
    uint32_t size = 1;  ///< What pipelines ask for, or else the device's usual one.
    uint32_t most = 1;
    bool required = false;  ///< Pipelines ask for it.
};

/// The usual size, or 64 where that is more and a device may be asked for 64: workgroups have 64 invocations.
SubgroupSize choose_subgroup_size(uint32_t usual, uint32_t least, uint32_t most, bool may_require);

/// A device of this machine, usable or not.
struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceDescription description;
    uint32_t queue_family = 0;
    uint32_t timestamp_bits = 0;  ///< 0: it has none.
    bool subgroup_size_control = false;
    bool storage_8bit = false;
    bool storage_16bit = false;
    SubgroupSize subgroup;
    uint32_t max_workgroup_subgroups = 0;  ///< Where a size is required.
    Limits limits;                         ///< Of a device with Vulkan 1.3, or lowered for tests.
    bool uniform_control_flow = false;     ///< It has VK_KHR_shader_subgroup_uniform_control_flow.
    std::vector<const char*> extensions;   ///< To enable.
};

std::vector<Candidate> find_candidates(const Instance& instance);

/// Errors: ErrorKind::no_device.
Candidate choose_candidate(const Instance& instance, const std::string& choice);

/// A command buffer in a pool of its own.
struct Commands {
    OwnedCommandPool pool;
    VkCommandBuffer buffer = VK_NULL_HANDLE;
};

struct DestroyDevice {
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
};

struct RecorderState;

struct Device::Impl {
    Impl(const std::string& choice, bool validate);
    ~Impl();

    /// A command buffer, reset; the caller lends it and puts it back. None is freed before the device is: the validation layer
    /// of 1.3.239 drops the labels of a freed one in a thread of its own, without its lock (its issue 5172).
    Commands take_commands();
    void put_back(Commands commands);
    /// What a recorder needs; lent and put back in the same way.
    std::unique_ptr<RecorderState> take_state();
    void put_back(std::unique_ptr<RecorderState> state);
    /// Record one command buffer, run it and wait.
    void run_once(const std::function<void(VkCommandBuffer)>& record);
    /// Run an ended command buffer and wait. Errors as Recorder::submit.
    /// Gives the seconds that the host waited.
    double submit_and_wait(VkCommandBuffer commands);
    /// Throw what the validation layer said since the last call.
    void throw_new_messages();
    void set_object_name(VkObjectType type, uint64_t handle, const std::string& name);

    /// The first of these sets of memory properties that the device offers gives the memory. `map`: for the host to see.
    Memory make_memory(const std::string& name, uint64_t bytes, VkBufferUsageFlags usage,
                       std::span<const VkMemoryPropertyFlags> preferences, bool map);
    /// Bytes of device memory that buffers may take together with what is kept for later ones.
    uint64_t most_held_bytes() const;
    void release_memory(uint64_t down_to);  ///< Of each pool.

    void add_live(const std::string& name, uint64_t bytes);
    void remove_live(const std::string& name, uint64_t bytes);
    /// ": name bytes, ..." of the largest live buffers.
    std::string describe_live() const;
    void add_stage_time(const std::string& stage, double seconds, uint64_t dispatches, bool marked);

    Instance instance;
    Candidate candidate;
    std::unique_ptr<VkDevice_T, DestroyDevice> device;  // before all that is made from it
    Limits limits;                                      ///< The candidate's; checks use these where there is one.
    VkPhysicalDeviceLimits vulkan_limits{};
    VkPhysicalDeviceMemoryProperties memory_properties{};
    uint64_t max_allocation_bytes = 0;
    VkQueue queue = VK_NULL_HANDLE;
    OwnedFence fence;
    std::vector<Commands> idle_commands;
    size_t commands_made = 0;
    std::map<std::pair<uint32_t, bool>, MemoryPool> pools;  ///< By memory type and whether they are mapped.
    std::vector<std::unique_ptr<RecorderState>> idle_states;
    size_t states_made = 0;

    Recorder::Impl* shared_recorder = nullptr;  ///< Device::recorder()'s, which runs before what others submit.
    size_t messages_thrown = 0;
    uint64_t budget = 0;
    uint64_t live_bytes = 0;
    uint64_t peak_bytes = 0;
    std::map<std::string, uint64_t> live_by_name;
    std::map<std::string, uint64_t> largest_by_name;
    std::vector<StageTime> stage_times;
    uint64_t submissions = 0;
    std::function<void()> after_submission;
    double longest_dispatch_seconds = 0.0;
    Pace pace{0.0};
};

struct Buffer::Impl {
    ~Impl();
    /// Cached; it lives as long as the buffer.
    VkBufferView view(VkFormat format, uint64_t offset, uint64_t bytes);

    std::shared_ptr<Device::Impl> device;
    std::string name;
    uint64_t bytes = 0;
    uint64_t capacity = 0;  ///< bytes, rounded up to whole texels of any format.
    Memory memory;
    std::map<std::tuple<VkFormat, uint64_t, uint64_t>, OwnedBufferView> views;
};

struct Program::Impl {
    std::shared_ptr<Device::Impl> device;
    std::string name;
    std::string key;  ///< The name with the values of its constants.
    Reflection reflection;
    OwnedSetLayout set_layout;
    OwnedPipelineLayout layout;
    OwnedPipeline pipeline;
};

constexpr uint64_t kStagingBytes = uint64_t{32} << 20;

/// All that was written before is seen by all shaders and transfers after.
void record_barrier(VkCommandBuffer commands);
/// All that was written before is seen by the host after the fence.
void record_host_barrier(VkCommandBuffer commands);

/// "1.5 MiB".
std::string format_bytes(uint64_t bytes);

}  // namespace gnomon::gpu
