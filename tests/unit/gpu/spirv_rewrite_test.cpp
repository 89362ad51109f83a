// SPDX-License-Identifier: Apache-2.0
// What is put into SPIR-V, and where; no device is needed but for the last test.
#include "gpu/spirv_rewrite.hpp"

#include <algorithm>
#include <map>
#include <spirv/unified1/spirv.hpp11>

#include "gpu_test.hpp"
#include "gpu_test_arithmetic.spv.h"
#include "gpu_test_scale.spv.h"

namespace gnomon::gpu {
namespace {

using Module = std::vector<uint32_t>;

struct Instruction {
    spv::Op op;
    std::vector<uint32_t> operands;
    bool operator==(const Instruction&) const = default;
};

std::vector<Instruction> disassemble(std::span<const uint32_t> module) {
    std::vector<Instruction> instructions;
    for (size_t at = 5; at < module.size(); at += module[at] >> 16) {
        const auto words = module.subspan(at, module[at] >> 16);
        instructions.push_back({static_cast<spv::Op>(words[0] & 0xffffu), {words.begin() + 1, words.end()}});
    }
    return instructions;
}

size_t position(const std::vector<Instruction>& instructions, spv::Op op) {
    return static_cast<size_t>(
        std::find_if(instructions.begin(), instructions.end(), [&](const Instruction& i) { return i.op == op; }) -
        instructions.begin());
}

bool is_no_contraction(const Instruction& i) {
    return i.op == spv::Op::OpDecorate && i.operands.at(1) == static_cast<uint32_t>(spv::Decoration::NoContraction);
}

bool is_new_extension(const Instruction& i) {
    return i.op == spv::Op::OpExtension && i.operands.at(0) == 0x5f565053;  // "SPV_"
}

bool is_new_mode(const Instruction& i) {
    return i.op == spv::Op::OpExecutionMode &&
           i.operands.at(1) == static_cast<uint32_t>(spv::ExecutionMode::SubgroupUniformControlFlowKHR);
}

Module rewrite(std::span<const uint32_t> module, bool uniform_control_flow) {
    return rewrite_spirv({"arithmetic", module}, uniform_control_flow);
}

const std::vector<Instruction> kBefore = disassemble(gpu_test_arithmetic);

TEST(SpirvRewrite, DecoratesEachFloatInstructionOnce) {
    using enum spv::Op;
    const std::vector<spv::Op> expected{OpFAdd,
                                        OpFSub,
                                        OpFMul,
                                        OpFDiv,
                                        OpFNegate,
                                        OpFMod,
                                        OpDot,
                                        OpVectorTimesScalar,
                                        OpMatrixTimesVector,
                                        OpVectorTimesMatrix,
                                        OpMatrixTimesScalar,
                                        OpMatrixTimesMatrix,
                                        OpOuterProduct};
    const auto after = disassemble(rewrite(gpu_test_arithmetic, false));
    std::map<uint32_t, int> decorations;
    for (const Instruction& i : after) {
        if (is_no_contraction(i)) ++decorations[i.operands[0]];
    }
    std::map<spv::Op, int> seen;
    size_t arithmetic = 0;
    for (const Instruction& i : after) {
        if (std::find(expected.begin(), expected.end(), i.op) == expected.end()) continue;
        ++seen[i.op];
        ++arithmetic;
        EXPECT_EQ(decorations[i.operands.at(1)], 1) << "instruction " << static_cast<uint32_t>(i.op);
    }
    EXPECT_EQ(seen.size(), expected.size()) << "the shader has one of each";
    EXPECT_EQ(decorations.size(), arithmetic) << "and nothing else is decorated";
    EXPECT_GT(std::count_if(kBefore.begin(), kBefore.end(), is_no_contraction), 0) << "what is precise is so before";
}

TEST(SpirvRewrite, KeepsTheOrderOfSections) {
    const auto after = disassemble(rewrite(gpu_test_arithmetic, true));
    const size_t types = position(after, spv::Op::OpTypeVoid);
    for (size_t i = 0; i < after.size(); ++i) {
        if (is_no_contraction(after[i])) {
            EXPECT_LT(i, types);
            EXPECT_GT(i, position(after, spv::Op::OpName));
        }
        if (is_new_mode(after[i])) {
            EXPECT_EQ(after[i].operands[0], after[position(after, spv::Op::OpEntryPoint)].operands[1]);
            EXPECT_GT(i, position(after, spv::Op::OpEntryPoint));
            EXPECT_LT(i, position(after, spv::Op::OpSource));
        }
        if (is_new_extension(after[i])) {
            EXPECT_GT(i, position(after, spv::Op::OpCapability));
            EXPECT_LT(i, position(after, spv::Op::OpExtInstImport));
            EXPECT_LT(i, position(after, spv::Op::OpMemoryModel));
        }
    }
}

TEST(SpirvRewrite, AddsNothingElse) {
    std::vector<Instruction> after = disassemble(rewrite(gpu_test_arithmetic, true));
    std::vector<Instruction> before = kBefore;
    const auto is_added = [](const Instruction& i) { return is_no_contraction(i) || is_new_extension(i) || is_new_mode(i); };
    std::erase_if(after, is_added);
    std::erase_if(before, is_added);
    EXPECT_EQ(after, before);
    const Module once = rewrite(gpu_test_arithmetic, true);
    EXPECT_EQ(rewrite(once, true), once) << "nor a second time";
}

TEST(SpirvRewrite, UniformControlFlowIsForShadersWithSubgroups) {
    const auto count = [](const Module& module, bool (*is)(const Instruction&)) {
        const auto instructions = disassemble(module);
        return std::count_if(instructions.begin(), instructions.end(), is);
    };
    EXPECT_EQ(count(rewrite(gpu_test_arithmetic, true), is_new_extension), 1);
    EXPECT_EQ(count(rewrite(gpu_test_arithmetic, true), is_new_mode), 1);
    EXPECT_EQ(count(rewrite(gpu_test_arithmetic, false), is_new_extension), 0);
    EXPECT_EQ(count(rewrite(gpu_test_arithmetic, false), is_new_mode), 0);
    EXPECT_EQ(count(rewrite(gpu_test_scale, true), is_new_extension), 0);
    EXPECT_EQ(count(rewrite(gpu_test_scale, true), is_new_mode), 0);
}

TEST(SpirvRewrite, RejectsBrokenModules) {
    const Module whole(std::begin(gpu_test_arithmetic), std::end(gpu_test_arithmetic));
    for (size_t words = 0; words < whole.size(); ++words) {
        try {
            rewrite(std::span(whole).first(words), true);
        } catch (const Error& error) {
            ASSERT_EQ(error.kind(), ErrorKind::internal);
            ASSERT_THAT(error.what(), testing::HasSubstr("shader arithmetic"));
        }
    }
}

using SpirvRewriteOnDevice = DeviceTest;

// The validation layer reads what the device was given.
TEST_F(SpirvRewriteOnDevice, IsValid) {
    const Program program = device.program({"arithmetic", gpu_test_arithmetic});
    const Buffer input = upload_new(device, "input", std::vector<float>(24, 2.0f));
    const Buffer output = device.allocate("output", 272);
    const std::vector<Binding> bindings{{.name = "Input", .buffer = &input}, {.name = "Output", .buffer = &output}};
    Recorder recorder(device);
    recorder.dispatch_bytes("test/arithmetic", program, bindings, {}, 1);
    recorder.submit();
    EXPECT_EQ(download_vector<float>(device, output, 1, 3 * 64 + 3 * 16)[0], 2.0f * 2.0f + 2.0f - 2.0f / 2.0f);
}

}  // namespace
}  // namespace gnomon::gpu
