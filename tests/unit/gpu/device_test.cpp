// SPDX-License-Identifier: Apache-2.0
// Listing and choosing devices, their limits.
#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "gpu/vulkan.hpp"
#include "gpu_test.hpp"

namespace gnomon::gpu {
namespace {

// Sets an environment variable for the life of this object.
class ScopedVariable {
public:
    ScopedVariable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old, had_ = true;
        setenv(name, value, 1);
    }
    ~ScopedVariable() {
        if (had_) {
            setenv(name_, old_.c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }

private:
    const char* name_;
    std::string old_;
    bool had_ = false;
};

TEST(ListDevices, DescribesWhatIsThere) {
    const std::vector<DeviceDescription> devices = gnomon::list_devices();
    ASSERT_FALSE(devices.empty());
    uint32_t chosen = 0;
    for (size_t i = 0; i < devices.size(); ++i) {
        EXPECT_EQ(devices[i].index, i);
        EXPECT_FALSE(devices[i].name.empty());
        EXPECT_FALSE(devices[i].driver.empty());
        EXPECT_GT(devices[i].heap_bytes, 0u);
        EXPECT_THAT(devices[i].type, testing::AnyOf("discrete", "integrated", "virtual", "cpu", "other"));
        if (devices[i].chosen) {
            ++chosen;
            EXPECT_THAT(devices[i].missing, testing::IsEmpty());
        }
    }
    EXPECT_EQ(chosen, 1u);
}

TEST(ListDevices, WithoutADriverIsEmpty) {
    const ScopedVariable no_drivers("VK_DRIVER_FILES", "/nonexistent.json");
    const ScopedVariable no_icds("VK_ICD_FILENAMES", "/nonexistent.json");
    EXPECT_THAT(list_devices(), testing::IsEmpty());
    expect_error(ErrorKind::no_device, {"no Vulkan device"}, [] { Device("", false); });
}

TEST(Validation, WithoutTheLayerNamesThePackage) {
    const ScopedVariable no_layers("VK_LAYER_PATH", "/nonexistent");
    expect_error(ErrorKind::no_device, {"vulkan-validationlayers"}, [] { Device("", true); });
}

TEST(DeviceChoice, ByIndexByPartOfTheNameAndByDefault) {
    const std::vector<DeviceDescription> devices = list_devices();
    const auto chosen = std::find_if(devices.begin(), devices.end(), [](const DeviceDescription& d) { return d.chosen; });
    ASSERT_NE(chosen, devices.end());
    EXPECT_EQ(Device("", false).description().index, chosen->index);
    EXPECT_EQ(Device(std::to_string(chosen->index), false).description().name, chosen->name);
    std::string shouted = chosen->name.substr(1);
    std::transform(shouted.begin(), shouted.end(), shouted.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    EXPECT_THAT(Device(shouted, false).description().name, testing::HasSubstr(chosen->name.substr(1)));
}

TEST(DeviceChoice, UnknownListsWhatExists) {
    const std::string name = list_devices().at(0).name;
    expect_error(ErrorKind::no_device, {"'no such device'", name}, [] { Device("no such device", false); });
    expect_error(ErrorKind::no_device, {"'999'", name}, [] { Device("999", false); });
    expect_error(ErrorKind::no_device, {"'99999999999999999999'", name}, [] { Device("99999999999999999999", false); });
}

// Usual size, least, most, may be required: of CPUs, of three makers' GPUs, and of one with large subgroups.
TEST(SubgroupSizes, AreRequiredAndAtMost64WherePossible) {
    const auto expect_size = [](const SubgroupSize& chosen, uint32_t size, uint32_t most, bool required) {
        EXPECT_EQ(chosen.size, size);
        EXPECT_EQ(chosen.most, most);
        EXPECT_EQ(chosen.required, required);
    };
    expect_size(choose_subgroup_size(4, 4, 4, true), 4, 4, true);
    expect_size(choose_subgroup_size(32, 32, 32, true), 32, 32, true);
    expect_size(choose_subgroup_size(32, 8, 32, true), 32, 32, true);
    expect_size(choose_subgroup_size(32, 8, 32, false), 32, 32, false);
    expect_size(choose_subgroup_size(64, 32, 64, true), 64, 64, true);
    expect_size(choose_subgroup_size(128, 64, 128, true), 64, 128, true);
    expect_size(choose_subgroup_size(128, 128, 128, true), 128, 128, true);
    expect_size(choose_subgroup_size(64, 64, 128, false), 64, 128, false);
}

TEST_F(DeviceTest, LimitsAreWithinVulkansGuarantees) {
    const Limits& limits = device.limits();
    EXPECT_EQ(limits.heap_bytes, device.description().heap_bytes);
    EXPECT_GE(limits.max_buffer_bytes, uint64_t{1} << 30);
    EXPECT_GE(limits.max_storage_range, uint64_t{1} << 27);
    EXPECT_LE(limits.storage_alignment, 256u);
    EXPECT_GE(limits.max_texels, 65536u);
    EXPECT_LE(limits.texel_alignment, 256u);
    EXPECT_GE(limits.max_groups, 65535u);
    EXPECT_GE(limits.subgroup_size, 1u);
    EXPECT_GE(limits.storage_buffers, 4u);
    EXPECT_GE(limits.push_constant_bytes, 128u);
    EXPECT_EQ(limits.timestamps, device.has_timestamps());
    EXPECT_EQ(limits.is_cpu, device.description().type == "cpu");
}

}  // namespace
}  // namespace gnomon::gpu
