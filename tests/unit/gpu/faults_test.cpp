// SPDX-License-Identifier: Apache-2.0
// What is said of a driver's faults.
#include "gpu/faults.hpp"

#include "gpu_test.hpp"
#include "gpu_test_fault_loops.spv.h"

namespace gnomon::gpu {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Faults, DependOnDriverAndVersion) {
    const auto of_mesa = [](const std::string& version) { return faults_of(VK_DRIVER_ID_MESA_LLVMPIPE, version); };
    EXPECT_THAT(of_mesa("Mesa 22.3.6 (LLVM 15.0.6)"), Contains(HasSubstr("65,535")));
    EXPECT_THAT(of_mesa("Mesa 25.0.6 (LLVM 19.1.7)"), Contains(HasSubstr("65,535")));
    EXPECT_THAT(of_mesa("Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)"), Not(Contains(HasSubstr("65,535"))));
    EXPECT_THAT(of_mesa("Mesa 26.1.0-devel (LLVM 19.1.7)"), Not(Contains(HasSubstr("65,535"))));
    EXPECT_THAT(of_mesa("of no known form"), Contains(HasSubstr("65,535")));
    EXPECT_THAT(faults_of(VK_DRIVER_ID_MOLTENVK, "1.2"), IsEmpty());
}

class FaultsTest : public DeviceTest {};

// On every driver: a fault that is named is there, and one that is not is not.
TEST_F(FaultsTest, LongLoopsEndEarlyWhereThatIsSaid) {
    constexpr uint32_t kTurns = 100'000, kInvocations = 64;
    const Program program = device.program({"fault_loops", gpu_test_fault_loops});
    const Buffer counts = device.allocate("counts", kInvocations * sizeof(uint32_t));
    Recorder recorder(device);
    recorder.dispatch("test/loops", program, std::vector<Binding>{{.name = "Counts", .buffer = &counts}}, kTurns, 1);
    recorder.submit();
    const bool is_said = testing::Value(device.description().faults, Contains(HasSubstr("65,535")));
    for (const uint32_t count : download_vector<uint32_t>(device, counts, kInvocations))
        EXPECT_EQ(count, is_said ? 65'535u : kTurns);
}

}  // namespace
}  // namespace gnomon::gpu
