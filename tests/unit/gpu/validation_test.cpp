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

}  // namespace
}  // namespace gnomon::gpu
