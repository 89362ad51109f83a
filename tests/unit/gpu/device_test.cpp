// SPDX-License-Identifier: Apache-2.0
// Listing and choosing devices, their limits.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "gpu/vulkan.hpp"
#include "gpu_test.hpp"
#include "gpu_test_declarations.spv.h"
#include "gpu_test_read_write.spv.h"
#include "gpu_test_scale.spv.h"

namespace gnomon::gpu {
namespace {

TEST(ListDevices, DescribesWhatIsThere) {
    const std::vector<DeviceDescription> devices = gnomon::list_devices();
    ASSERT_FALSE(devices.empty());
    uint32_t chosen = 0;
    for (size_t i = 0; i < devices.size(); ++i) {
        EXPECT_EQ(devices[i].index, i);
        EXPECT_FALSE(devices[i].name.empty());
        EXPECT_FALSE(devices[i].driver.empty());
        EXPECT_GT(devices[i].heap_bytes, 0u);
        EXPECT_THAT(devices[i].vulkan, testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
        EXPECT_THAT(devices[i].type, testing::AnyOf("discrete", "integrated", "virtual", "cpu", "other"));
        if (devices[i].chosen) {
            ++chosen;
            EXPECT_THAT(devices[i].missing, testing::IsEmpty());
            EXPECT_EQ(devices[i].driver, devices[i].driver_name + " " + devices[i].driver_version);
            EXPECT_THAT(devices[i].limits, testing::Contains(testing::Pair("storage_range_bytes", testing::Ge(1u << 27))));
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

// Whether a loader goes on with the other drivers or not, memory is not what lacks.
TEST(ListDevices, AManifestThatIsBrokenIsNamedOrPassedOver) {
    const std::filesystem::path folder = testing::TempDir();
    std::ofstream(folder / "gnomon_broken.json") << "{";
    const std::string broken = (folder / "gnomon_broken.json").string();
    const ScopedVariable drivers("VK_DRIVER_FILES", broken.c_str());
    const ScopedVariable icds("VK_ICD_FILENAMES", broken.c_str());
    try {
        EXPECT_THAT(list_devices(), testing::IsEmpty());
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::no_device);
        EXPECT_THAT(error.what(), testing::HasSubstr("gnomon_broken.json"));
    }
}

TEST(ListDevices, ALibraryThatIsMissingIsNamed) {
    const std::filesystem::path manifest = std::filesystem::path(testing::TempDir()) / "gnomon_no_library.json";
    std::ofstream(manifest) << R"({"file_format_version": "1.0.0",)"
                            << R"( "ICD": {"library_path": "/nonexistent/libgnomon_driver.so", "api_version": "1.3.0"}})";
    const ScopedVariable drivers("VK_DRIVER_FILES", manifest.c_str());
    const ScopedVariable icds("VK_ICD_FILENAMES", manifest.c_str());
    EXPECT_THAT(loader_errors(), testing::Contains(testing::HasSubstr("libgnomon_driver.so")));
    EXPECT_THAT(list_devices(), testing::IsEmpty());
    expect_error(ErrorKind::no_device, {"no Vulkan device: ", "libgnomon_driver.so", "repair"}, [] { Device("", false); });
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

TEST(DeviceChoice, ByType) {
    const auto expect_type = [](const char* choice, const std::vector<std::string>& types) {
        const std::vector<DeviceDescription> devices = list_devices();
        const bool is_there = std::any_of(devices.begin(), devices.end(), [&](const DeviceDescription& d) {
            return d.missing.empty() && std::find(types.begin(), types.end(), d.type) != types.end();
        });
        if (is_there) {
            EXPECT_THAT(Device(choice, false).description().type, testing::AnyOfArray(types));
        } else {
            expect_error(ErrorKind::no_device, {choice}, [&] { Device(choice, false); });
        }
    };
    expect_type("cpu", {"cpu"});
    expect_type("CPU", {"cpu"});
    expect_type("gpu", {"discrete", "integrated", "virtual"});
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

TEST(LoweredLimits, AreWhatTheDeviceSeemsToHave) {
    const ScopedVariable lowered("GNOMON_LIMITS",
                                 "texels=65536,storage_range=16777216,storage_buffers=4,push_constants=64,groups=100,"
                                 "buffer=1000000,dispatch_ms=3,timestamps=0,mapped=0");
    const Device device("", true);
    EXPECT_EQ(device.limits().max_texels, 65536u);
    EXPECT_EQ(device.limits().max_storage_range, 16777216u);
    EXPECT_EQ(device.limits().storage_buffers, 4u);
    EXPECT_EQ(device.limits().push_constant_bytes, 64u);
    EXPECT_EQ(device.limits().max_groups, 100u);
    EXPECT_EQ(device.limits().max_buffer_bytes, 1000000u);
    EXPECT_EQ(device.limits().dispatch_ms, 3u);
    EXPECT_FALSE(device.limits().mapped);
    EXPECT_FALSE(device.has_timestamps());
}

TEST(LoweredLimits, WithoutShufflesNoDeviceIsUsable) {
    const ScopedVariable lowered("GNOMON_LIMITS", "shuffles=0");
    for (const DeviceDescription& device : list_devices()) {
        EXPECT_THAT(device.missing, testing::Contains("subgroup shuffle"));
        EXPECT_FALSE(device.chosen);
    }
    expect_error(ErrorKind::no_device, {"no Vulkan device has what gnomon needs", "lacks subgroup shuffle"},
                 [] { Device("", false); });
    expect_error(ErrorKind::no_device, {"lacks subgroup shuffle"}, [] { Device("0", false); });
}

TEST(LoweredLimits, OthersAndHigherOnesAreErrors) {
    const auto expect_refused = [](const char* text, const std::string& what) {
        const ScopedVariable lowered("GNOMON_LIMITS", text);
        expect_error(ErrorKind::usage, {"GNOMON_LIMITS", "'" + what + "'", "storage_range", "push_constants"},
                     [] { Device("", false); });
    };
    expect_refused("texel=65536", "texel=65536");
    expect_refused("texels=65536,,groups=1", "");
    expect_refused("texels", "texels");
    expect_refused("texels=", "texels=");
    expect_refused("groups=many", "groups=many");
    expect_refused("groups=-1", "groups=-1");
    expect_refused("groups=7 ", "groups=7 ");
    expect_refused("groups=7,groups=8", "groups=8");
    expect_refused("timestamps=2", "timestamps=2");
    expect_refused("storage_range=99999999999999", "storage_range=99999999999999");
    expect_refused("storage_range=99999999999999999999", "storage_range=99999999999999999999");
}

TEST(LoweredLimits, AreChecked) {
    const ScopedVariable lowered("GNOMON_LIMITS", "texels=8,storage_range=64,push_constants=8,groups=3,buffer=4096");
    Device device("", true);
    const Program program = device.program({"scale", gpu_test_scale});
    const Buffer values = device.allocate("values", 64);
    const Buffer scaled = device.allocate("scaled", 128);
    Recorder recorder(device);
    const auto dispatch = [&](uint64_t texels, uint64_t range, uint64_t groups) {
        const std::vector<Binding> bindings{
            {.name = "values", .buffer = &values, .texel = Texel::r32_float, .bytes = 4 * texels},
            {.name = "Scaled", .buffer = &scaled, .bytes = range}};
        recorder.dispatch("test/scale", program, bindings, std::array<uint32_t, 2>{}, groups);
    };
    EXPECT_NO_THROW(dispatch(8, 64, 9));
    expect_error(ErrorKind::internal, {"'values'", "9 texels", "at most 8"}, [&] { dispatch(9, 64, 9); });
    expect_error(ErrorKind::internal, {"'Scaled'", "68 bytes", "at most 64"}, [&] { dispatch(8, 68, 9); });
    expect_error(ErrorKind::internal, {"10 workgroups", "3 by 3"}, [&] { dispatch(8, 64, 10); });
    expect_error(ErrorKind::out_of_memory, {"'large'", "at most 4.0 KiB"}, [&] { device.allocate("large", 8192); });
    EXPECT_NO_THROW(recorder.submit());
}

TEST(LoweredLimits, OfProgramsAreChecked) {
    const ScopedVariable lowered("GNOMON_LIMITS", "storage_buffers=2,push_constants=123");
    Device device("", true);
    EXPECT_NO_THROW(device.program({"scale", gpu_test_scale}));
    expect_error(ErrorKind::no_device, {"read_write", "3 storage buffers", "allows 2"}, [&] {
        device.program({"read_write", gpu_test_read_write});
    });
    expect_error(ErrorKind::no_device, {"declarations", "124 bytes of push constants", "allows 123"}, [&] {
        device.program({"declarations", gpu_test_declarations});
    });
}

TEST(LoweredLimits, WithoutTimestampsStagesHaveNoSeconds) {
    const ScopedVariable lowered("GNOMON_LIMITS", "timestamps=0");
    Device device("", true);
    const Buffer values = device.allocate("values", 64);
    Recorder recorder(device);
    recorder.fill("clear", values, 1);
    recorder.fill("clear", values, 2);
    recorder.submit();
    EXPECT_EQ(download_vector<uint32_t>(device, values, 1)[0], 2u);
    ASSERT_EQ(device.stage_times().size(), 1u);
    EXPECT_EQ(device.stage_times()[0].seconds, 0.0);
    EXPECT_EQ(device.stage_times()[0].dispatches, 2u);
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
