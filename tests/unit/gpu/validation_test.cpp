// SPDX-License-Identifier: Apache-2.0
// Mistakes that the validation layer sees become errors.
#include "gpu/vulkan.hpp"
#include "gpu_test.hpp"
#include "gpu_test_double_precision.spv.h"

namespace gnomon::gpu {
namespace {

TEST(Validation, AFeatureThatIsNotEnabledIsThrownFromTheNextSubmit) {
    Device device("", true);
    const Program program = device.program({"double_precision", gpu_test_double_precision});
    const Buffer values = device.allocate("values", 64);
    Recorder recorder(device);
    recorder.fill("clear", values, 0);
    expect_error(ErrorKind::internal, {"validation layer", "Float64"}, [&] { recorder.submit(); });
    EXPECT_THAT(device.validation_messages(), testing::Not(testing::IsEmpty()));

    // It is thrown once, and the recorder and the device go on.
    recorder.fill("clear", values, 3);
    EXPECT_NO_THROW(recorder.submit());
    EXPECT_EQ(download_vector<uint32_t>(device, values, 1)[0], 3u);
}

TEST(Validation, AMissingBarrierIsSeen) {
    Device device("", true);
    const Buffer values = device.allocate("values", 64);
    const VkBuffer handle = values.impl()->memory.buffer.get();
    expect_error(ErrorKind::internal, {"WRITE_AFTER_WRITE", "values"}, [&] {
        device.impl()->run_once([&](VkCommandBuffer commands) {
            vkCmdFillBuffer(commands, handle, 0, 64, 1);
            vkCmdFillBuffer(commands, handle, 0, 64, 2);
        });
    });
}

// What it says of itself, where it was kept from working for a while, is none of gnomon's mistakes.
TEST(Validation, ItsOwnTimeoutsAreNotTaken) {
    const Instance instance(true);
    const auto submit = reinterpret_cast<PFN_vkSubmitDebugUtilsMessageEXT>(
        vkGetInstanceProcAddr(instance.handle, "vkSubmitDebugUtilsMessageEXT"));
    const auto say = [&](const char* name) {
        const VkDebugUtilsMessengerCallbackDataEXT data{
            .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT, .pMessageIdName = name, .pMessage = name};
        submit(instance.handle, VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT, VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
               &data);
    };
    say("INTERNAL-ERROR-VkFence-state-timeout");
    say("UNASSIGNED-VkQueue-state-timeout");
    EXPECT_THAT(instance.messages, testing::IsEmpty());
    say("VUID-vkQueueSubmit");
    EXPECT_THAT(instance.messages, testing::ElementsAre("VUID-vkQueueSubmit"));
}

}  // namespace
}  // namespace gnomon::gpu
