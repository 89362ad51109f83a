// SPDX-License-Identifier: Apache-2.0
// The Vulkan instance, the validation layer's messages, and which device is used.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "gpu/faults.hpp"
#include "gpu/limits.hpp"
#include "gpu/vulkan.hpp"

namespace gnomon::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kPortabilitySubset = "VK_KHR_portability_subset";  // Vulkan's headers name it for beta users only

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
    // The layer of itself (UNASSIGNED-VkFence-state-timeout in 1.3.239, INTERNAL-ERROR-VkFence-state-timeout in 1.4.309): its
    // threads took more than 10 s, as where the process was stopped for a while.
    const std::string_view name = data->pMessageIdName == nullptr ? "" : data->pMessageIdName;
    if (!name.ends_with("-state-timeout")) static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
    return VK_FALSE;
}

bool has_validation_layer() {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, kValidationLayer) == 0; });
}

std::vector<VkExtensionProperties> instance_extensions() {
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return extensions;
}

bool has_extension(const std::vector<VkExtensionProperties>& extensions, const char* name) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& extension) { return std::strcmp(extension.extensionName, name) == 0; });
}

template <class Function>
Function load(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

std::string type_name(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "cpu";
        default:
            return "other";
    }
}

// The lower, the sooner an empty choice takes it.
int type_rank(const std::string& type) {
    if (type == "discrete") return 0;
    return type == "integrated" || type == "virtual" ? 1 : 2;
}

std::string version_text(uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

constexpr VkApplicationInfo kApplication{
    .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "gnomon", .apiVersion = VK_API_VERSION_1_3};

// Drivers are unloaded with the last instance, and one cannot count on a driver to load any number of times in a process: with
// NVIDIA's there was no device any more after some thirty. An instance that is never destroyed keeps those that were found.
void keep_drivers() {
    static const VkInstance kept = [] {
        const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &kApplication};
        VkInstance instance = VK_NULL_HANDLE;
        return vkCreateInstance(&info, nullptr, &instance) == VK_SUCCESS ? instance : VK_NULL_HANDLE;
    }();
    static_cast<void>(kept);
}

std::string join(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
    return text;
}

// The first queue family with compute, if possible one with timestamps.
void find_queue(Candidate& candidate) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(candidate.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(candidate.physical, &count, families.data());
    bool has_compute = false;
    for (uint32_t i = 0; i < count && candidate.timestamp_bits == 0; ++i) {
        if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)) continue;
        if (has_compute && families[i].timestampValidBits == 0) continue;
        has_compute = true;
        candidate.queue_family = i;
        candidate.timestamp_bits = families[i].timestampValidBits;
    }
    if (!has_compute) candidate.description.missing.emplace_back("a compute queue");
}

// Of what the shaders and the parts into which buffers are bound need, Vulkan's own minima are enough.
void find_missing_limits(const VkPhysicalDeviceLimits& limits, std::vector<std::string>& missing) {
    constexpr uint64_t kTexels = 65536;
    constexpr uint64_t kStorageRange = uint64_t{1} << 27;
    // With texels enough, and where everything is read through storage buffers: methods/temporal/shadow@linked.
    constexpr uint64_t kStorageBuffers = 4, kStorageReadBuffers = 20;
    constexpr uint64_t kTexelBuffers = 16;
    constexpr uint64_t kPushConstantBytes = 128;
    constexpr uint64_t kInvocations = 64;
    constexpr uint64_t kGroups = 65535;
    struct Need {
        uint64_t has;
        uint64_t least;
        const char* what;
    };
    const std::array needs{
        Need{limits.maxTexelBufferElements, kTexels, "texels in a buffer view"},
        Need{limits.maxStorageBufferRange, kStorageRange, "bytes in a storage binding"},
        Need{limits.maxPerStageDescriptorStorageBuffers,
             limits.maxTexelBufferElements < kManyTexels ? kStorageReadBuffers : kStorageBuffers, "storage buffers"},
        Need{limits.maxPerStageDescriptorSampledImages, kTexelBuffers, "texel buffers"},
        Need{limits.maxPushConstantsSize, kPushConstantBytes, "bytes of push constants"},
        Need{limits.maxComputeWorkGroupInvocations, kInvocations, "invocations in a workgroup"},
        Need{limits.maxComputeWorkGroupSize[0], kInvocations, "invocations along x"},
        Need{limits.maxComputeWorkGroupCount[0], kGroups, "workgroups along x"},
        Need{limits.maxComputeWorkGroupCount[1], kGroups, "workgroups along y"},
    };
    for (const Need& need : needs) {
        if (need.has >= need.least) continue;
        missing.push_back(std::to_string(need.least) + " " + need.what + " (it has " + std::to_string(need.has) + ")");
    }
}

void find_missing_features(Candidate& candidate) {
    VkPhysicalDeviceVulkan13Features features13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan11Features features11{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES,
                                                .pNext = &features13};
    VkPhysicalDeviceVulkan12Features features12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                                .pNext = &features11};
    VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &features12};
    vkGetPhysicalDeviceFeatures2(candidate.physical, &features);
    std::vector<std::string>& missing = candidate.description.missing;
    if (!features12.scalarBlockLayout) missing.emplace_back("scalarBlockLayout");
    if (!features13.computeFullSubgroups) missing.emplace_back("computeFullSubgroups");
    if (!features13.maintenance4) missing.emplace_back("maintenance4");
    if (!features13.synchronization2) missing.emplace_back("synchronization2");
    candidate.subgroup_size_control = features13.subgroupSizeControl;
    candidate.storage_8bit = features12.storageBuffer8BitAccess;
    candidate.storage_16bit = features11.storageBuffer16BitAccess;
}

void find_subgroup_size(Candidate& candidate, const VkPhysicalDeviceSubgroupProperties& subgroup,
                        const VkPhysicalDeviceSubgroupSizeControlProperties& control) {
    const bool may_require =
        candidate.subgroup_size_control && (control.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
    candidate.subgroup =
        choose_subgroup_size(subgroup.subgroupSize, control.minSubgroupSize, control.maxSubgroupSize, may_require);
    candidate.max_workgroup_subgroups = control.maxComputeWorkgroupSubgroups;
}

// What is used where the device offers it.
void find_extensions(Candidate& candidate) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(candidate.physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> offered(count);
    vkEnumerateDeviceExtensionProperties(candidate.physical, nullptr, &count, offered.data());
    // A device that has it may be used only with it; of what it takes away nothing is used.
    if (has_extension(offered, kPortabilitySubset)) candidate.extensions.push_back(kPortabilitySubset);
    if (has_extension(offered, VK_KHR_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_EXTENSION_NAME)) {
        VkPhysicalDeviceShaderSubgroupUniformControlFlowFeaturesKHR control_flow{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_FEATURES_KHR};
        VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &control_flow};
        vkGetPhysicalDeviceFeatures2(candidate.physical, &features);
        candidate.uniform_control_flow = control_flow.shaderSubgroupUniformControlFlow;
        if (candidate.uniform_control_flow) {
            candidate.extensions.push_back(VK_KHR_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_EXTENSION_NAME);
        }
    }
}

void find_missing_subgroup_operations(const VkPhysicalDeviceSubgroupProperties& subgroup, bool shuffles,
                                      std::vector<std::string>& missing) {
    if (!(subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT)) {
        missing.emplace_back("subgroup operations in compute shaders");
        return;
    }
    constexpr std::pair<VkSubgroupFeatureFlagBits, const char*> kRequired[] = {
        {VK_SUBGROUP_FEATURE_BASIC_BIT, "basic"},
        {VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, "arithmetic"},
    };
    for (const auto& [bit, name] : kRequired) {
        if (!(subgroup.supportedOperations & bit)) missing.push_back(std::string("subgroup ") + name);
    }
    if (!shuffles) missing.emplace_back("subgroup shuffle");
}

std::vector<std::pair<std::string, uint64_t>> described_limits(const Candidate& candidate,
                                                               const VkPhysicalDeviceLimits& vulkan) {
    const Limits& limits = candidate.limits;
    return {{"buffer_bytes", limits.max_buffer_bytes},
            {"storage_range_bytes", limits.max_storage_range},
            {"texel_elements", limits.max_texels},
            {"storage_buffers", limits.storage_buffers},
            {"push_constant_bytes", limits.push_constant_bytes},
            {"workgroups", limits.max_groups},
            {"workgroup_invocations", vulkan.maxComputeWorkGroupInvocations},
            {"workgroup_width", vulkan.maxComputeWorkGroupSize[0]},
            {"subgroup_invocations", limits.subgroup_size},
            {"subgroup_invocations_most", candidate.subgroup.most},
            {"timestamp_bits", limits.timestamps ? candidate.timestamp_bits : 0},
            {"mapped", limits.mapped},
            {"dispatch_milliseconds", limits.dispatch_ms}};
}

uint64_t largest_local_heap(VkPhysicalDevice physical) {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    uint64_t largest = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
            largest = std::max(largest, uint64_t{memory.memoryHeaps[i].size});
        }
    }
    return largest;
}

Candidate describe(VkPhysicalDevice physical, uint32_t index) {
    Candidate candidate{.physical = physical};
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    DeviceDescription& description = candidate.description;
    description.index = index;
    description.name = properties.deviceName;
    description.type = type_name(properties.deviceType);
    description.vulkan = version_text(properties.apiVersion);
    description.heap_bytes = largest_local_heap(physical);
    find_queue(candidate);
    if (properties.apiVersion < VK_API_VERSION_1_3) {  // what follows may not be asked of it
        description.driver = "Vulkan " + description.vulkan;
        description.missing.push_back("Vulkan 1.3 (it has " + description.vulkan + ")");
        return candidate;
    }
    VkPhysicalDeviceSubgroupSizeControlProperties control{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES};
    VkPhysicalDeviceSubgroupProperties subgroup{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES,
                                                .pNext = &control};
    VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, .pNext = &subgroup};
    VkPhysicalDeviceProperties2 properties2{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
    vkGetPhysicalDeviceProperties2(physical, &properties2);
    description.driver_name = driver.driverName;
    description.driver_version = driver.driverInfo;
    description.driver = description.driver_name + " " + description.driver_version;
    description.faults = faults_of(driver.driverID, description.driver_version);
    find_missing_features(candidate);
    find_extensions(candidate);
    find_subgroup_size(candidate, subgroup, control);
    candidate.limits = own_limits(candidate);
    if (const char* lower = std::getenv("GNOMON_LIMITS")) candidate.limits = lower_limits(candidate.limits, lower);
    description.limits = described_limits(candidate, properties2.properties.limits);
    find_missing_subgroup_operations(subgroup, candidate.limits.shuffles, description.missing);
    find_missing_limits(properties2.properties.limits, description.missing);
    return candidate;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// The index of the device that a choice names: by its index, by type, where usable ones go before others, or by a part of its
// name; candidates.size() where there is none.
size_t index_of(const std::string& choice, const std::vector<Candidate>& candidates) {
    const size_t none = candidates.size();
    if (choice.size() < 10 && std::all_of(choice.begin(), choice.end(), [](unsigned char c) { return std::isdigit(c); }))
        return std::min<size_t>(std::stoul(choice), none);
    const std::string wanted = lower(choice);
    if (wanted != "cpu" && wanted != "gpu") {
        const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
            return lower(c.description.name).find(wanted) != std::string::npos;
        });
        return static_cast<size_t>(found - candidates.begin());
    }
    const auto rank = [&](size_t i) {
        return std::pair(!candidates[i].description.missing.empty(), type_rank(candidates[i].description.type));
    };
    size_t best = none;
    for (size_t i = 0; i < candidates.size(); ++i) {
        const std::string& type = candidates[i].description.type;
        const bool fits = wanted == "cpu" ? type == "cpu" : type_rank(type) < 2;
        if (fits && (best == none || rank(i) < rank(best))) best = i;
    }
    return best;
}

}  // namespace

Instance::Instance(bool validate) {
    if (validate && !has_validation_layer()) {
        throw Error(ErrorKind::no_device, std::string(kValidationLayer) + " is not installed", "validation",
                    "install it (Debian package vulkan-validationlayers) or run without validation");
    }
    const std::vector<VkExtensionProperties> offered = instance_extensions();
    const bool debug_utils = has_extension(offered, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    if (debug_utils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    const bool portability = has_extension(offered, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    if (portability) extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    if (validate) {
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT validation{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                             .enabledValidationFeatureCount = 1,
                                             .pEnabledValidationFeatures = &synchronization};
    const VkInstanceCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = validate ? &validation : nullptr,
        .flags = portability ? VkInstanceCreateFlags{VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR} : 0,
        .pApplicationInfo = &kApplication,
        .enabledLayerCount = static_cast<uint32_t>(layers.size()),
        .ppEnabledLayerNames = layers.data(),
        .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data()};
    const VkResult result = vkCreateInstance(&info, nullptr, &handle);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {  // no driver on this machine
        handle = VK_NULL_HANDLE;
        return;
    }
    if (result != VK_SUCCESS) {
        // One manifest that it cannot read, whatever others there are, is "out of host memory" to loader 1.3.239.
        if (const std::vector<std::string> errors = loader_errors(); !errors.empty())
            throw Error(ErrorKind::no_device, "cannot create a Vulkan instance: " + join(errors), "Vulkan loader",
                        "repair or remove what it names, or name the manifest of a driver that works in VK_DRIVER_FILES");
    }
    check(result, "create a Vulkan instance");
    keep_drivers();
    if (!debug_utils) return;
    begin_label = load<PFN_vkCmdBeginDebugUtilsLabelEXT>(handle, "vkCmdBeginDebugUtilsLabelEXT");
    end_label = load<PFN_vkCmdEndDebugUtilsLabelEXT>(handle, "vkCmdEndDebugUtilsLabelEXT");
    set_name = load<PFN_vkSetDebugUtilsObjectNameEXT>(handle, "vkSetDebugUtilsObjectNameEXT");
    if (!validate) return;
    const VkDebugUtilsMessengerCreateInfoEXT messenger{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = collect_message,
        .pUserData = &messages};
    const auto create_messenger = load<PFN_vkCreateDebugUtilsMessengerEXT>(handle, "vkCreateDebugUtilsMessengerEXT");
    check(create_messenger(handle, &messenger, nullptr, &messenger_), "create a debug messenger");
}

Instance::~Instance() {
    if (messenger_) {
        load<PFN_vkDestroyDebugUtilsMessengerEXT>(handle, "vkDestroyDebugUtilsMessengerEXT")(handle, messenger_, nullptr);
    }
    if (handle) vkDestroyInstance(handle, nullptr);
}

SubgroupSize choose_subgroup_size(uint32_t usual, uint32_t least, uint32_t most, bool may_require) {
    constexpr uint32_t kMost = 64;
    const bool large = usual > kMost && least <= kMost;
    return {.size = may_require && large ? kMost : usual, .most = std::max(usual, most), .required = may_require};
}

std::vector<Candidate> find_candidates(const Instance& instance) {
    std::vector<Candidate> candidates;
    if (!instance.handle) return candidates;
    uint32_t count = 0;
    const VkResult result = vkEnumeratePhysicalDevices(instance.handle, &count, nullptr);
    if (result == VK_ERROR_INITIALIZATION_FAILED) return candidates;  // drivers, but none of them works here
    check(result, "list the Vulkan devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance.handle, &count, devices.data()), "list the Vulkan devices");
    for (uint32_t i = 0; i < count; ++i) candidates.push_back(describe(devices[i], i));

    Candidate* chosen = nullptr;
    for (Candidate& candidate : candidates) {
        if (!candidate.description.missing.empty()) continue;
        if (!chosen || type_rank(candidate.description.type) < type_rank(chosen->description.type)) chosen = &candidate;
    }
    if (chosen) chosen->description.chosen = true;
    return candidates;
}

Candidate choose_candidate(const Instance& instance, const std::string& choice) {
    const std::vector<Candidate> candidates = find_candidates(instance);
    if (candidates.empty()) {
        const std::vector<std::string> errors = loader_errors();
        throw Error(ErrorKind::no_device, "no Vulkan device" + (errors.empty() ? "" : ": " + join(errors)), "Vulkan loader",
                    "install a Vulkan driver, or repair what the loader names; Debian package mesa-vulkan-drivers has one that "
                    "runs on the CPU");
    }
    std::vector<std::string> lines;
    for (const Candidate& candidate : candidates) {
        const DeviceDescription& description = candidate.description;
        std::string line = std::to_string(description.index) + " '" + description.name + "'";
        if (!description.missing.empty()) line += " (lacks " + join(description.missing) + ")";
        lines.push_back(std::move(line));
    }
    if (choice.empty()) {
        const auto chosen =
            std::find_if(candidates.begin(), candidates.end(), [](const Candidate& c) { return c.description.chosen; });
        if (chosen != candidates.end()) return *chosen;
        throw Error(ErrorKind::no_device, "no Vulkan device has what gnomon needs", join(lines), "update the driver");
    }
    const size_t index = index_of(choice, candidates);
    if (index == candidates.size()) {
        throw Error(ErrorKind::no_device, "no Vulkan device matches '" + choice + "'", "--device", "there are: " + join(lines));
    }
    const DeviceDescription& found = candidates[index].description;
    if (!found.missing.empty()) {
        throw Error(ErrorKind::no_device, "device '" + found.name + "' lacks " + join(found.missing), "--device",
                    "choose another or update its driver; there are: " + join(lines));
    }
    return candidates[index];
}

std::vector<std::string> loader_errors() {
    std::vector<std::string> messages;
    const VkDebugUtilsMessengerCreateInfoEXT listener{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
                                                      .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                                                      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT,
                                                      .pfnUserCallback = collect_message,
                                                      .pUserData = &messages};
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = &listener,
                                    .pApplicationInfo = &kApplication,
                                    .enabledExtensionCount = 1,
                                    .ppEnabledExtensionNames = &extension};
    VkInstance instance = VK_NULL_HANDLE;
    if (vkCreateInstance(&info, nullptr, &instance) == VK_SUCCESS) vkDestroyInstance(instance, nullptr);
    std::vector<std::string> errors;
    for (std::string& message : messages) {  // It looks for drivers several times.
        if (std::find(errors.begin(), errors.end(), message) == errors.end()) errors.push_back(std::move(message));
    }
    return errors;
}

std::vector<DeviceDescription> list_devices() {
    const Instance instance(false);
    std::vector<DeviceDescription> descriptions;
    for (Candidate& candidate : find_candidates(instance)) descriptions.push_back(std::move(candidate.description));
    return descriptions;
}

}  // namespace gnomon::gpu

namespace gnomon {

std::vector<DeviceDescription> list_devices() { return gpu::list_devices(); }

std::vector<std::string> loader_errors() { return gpu::loader_errors(); }

}  // namespace gnomon
