// SPDX-License-Identifier: Apache-2.0
// Inserts decorations and an execution mode into a SPIR-V module, each in the section where the module's layout wants it.
#include "gpu/spirv_rewrite.hpp"

#include <algorithm>
#include <gnomon/error.hpp>
#include <set>
#include <spirv/unified1/spirv.hpp11>
#include <string_view>

namespace gnomon::gpu {
namespace {

using Words = std::span<const uint32_t>;

constexpr size_t kHeaderWords = 5;
constexpr std::string_view kUniformControlFlow = "SPV_KHR_subgroup_uniform_control_flow";

// The sections of a module that matter here, in their order.
enum class Section { capabilities, extensions, imports, entry_points, execution_modes, annotations, rest };

Section section_of(spv::Op op) {
    switch (op) {
        case spv::Op::OpCapability:
            return Section::capabilities;
        case spv::Op::OpExtension:
            return Section::extensions;
        case spv::Op::OpExtInstImport:
        case spv::Op::OpMemoryModel:
            return Section::imports;
        case spv::Op::OpEntryPoint:
            return Section::entry_points;
        case spv::Op::OpExecutionMode:
        case spv::Op::OpExecutionModeId:
            return Section::execution_modes;
        case spv::Op::OpString:
        case spv::Op::OpSource:
        case spv::Op::OpSourceExtension:
        case spv::Op::OpSourceContinued:
        case spv::Op::OpName:
        case spv::Op::OpMemberName:
        case spv::Op::OpModuleProcessed:
        case spv::Op::OpDecorate:
        case spv::Op::OpDecorateId:
        case spv::Op::OpDecorateString:
        case spv::Op::OpMemberDecorate:
        case spv::Op::OpMemberDecorateString:
        case spv::Op::OpDecorationGroup:
        case spv::Op::OpGroupDecorate:
        case spv::Op::OpGroupMemberDecorate:
            return Section::annotations;
        default:
            return Section::rest;
    }
}

bool is_float_arithmetic(spv::Op op) {
    switch (op) {
        case spv::Op::OpFNegate:
        case spv::Op::OpFAdd:
        case spv::Op::OpFSub:
        case spv::Op::OpFMul:
        case spv::Op::OpFDiv:
        case spv::Op::OpFRem:
        case spv::Op::OpFMod:
        case spv::Op::OpVectorTimesScalar:
        case spv::Op::OpMatrixTimesScalar:
        case spv::Op::OpVectorTimesMatrix:
        case spv::Op::OpMatrixTimesVector:
        case spv::Op::OpMatrixTimesMatrix:
        case spv::Op::OpOuterProduct:
        case spv::Op::OpDot:
            return true;
        default:
            return false;
    }
}

// A literal string, padded with zeros to whole words.
std::vector<uint32_t> literal(std::string_view text) {
    std::vector<uint32_t> words(text.size() / 4 + 1, 0);
    for (size_t i = 0; i < text.size(); ++i) words[i / 4] |= static_cast<uint32_t>(text[i]) << (8 * (i % 4));
    return words;
}

class Rewriter {
public:
    Rewriter(const Shader& shader, bool uniform_control_flow) : shader_(shader), uniform_control_flow_(uniform_control_flow) {
        split();
    }

    std::vector<uint32_t> rewritten() const {
        std::vector<uint32_t> result(shader_.spirv.begin(), shader_.spirv.begin() + kHeaderWords);
        Section current = Section::capabilities;
        const auto leave_sections_before = [&](Section next) {
            if (current <= Section::extensions && next > Section::extensions) append_extension(result);
            if (current <= Section::execution_modes && next > Section::execution_modes) append_execution_mode(result);
            if (current <= Section::annotations && next > Section::annotations) append_decorations(result);
            current = std::max(current, next);
        };
        for (const Words words : instructions_) {
            leave_sections_before(section_of(opcode(words)));
            result.insert(result.end(), words.begin(), words.end());
        }
        return result;
    }

private:
    [[noreturn]] void fail(const char* what) const {
        throw Error(ErrorKind::internal, what, "shader " + shader_.name, "change the shader or the code that uses it");
    }

    static spv::Op opcode(Words words) { return static_cast<spv::Op>(words[0] & spv::OpCodeMask); }

    uint32_t operand(Words words, size_t i) const {
        if (i >= words.size()) fail("SPIR-V instruction is too short");
        return words[i];
    }

    void split() {
        const Words spirv = shader_.spirv;
        if (spirv.size() < kHeaderWords || spirv[0] != spv::MagicNumber) fail("not a SPIR-V module");
        for (size_t at = kHeaderWords; at < spirv.size();) {
            const size_t count = spirv[at] >> spv::WordCountShift;
            if (count == 0 || count > spirv.size() - at) fail("SPIR-V instruction runs past the end");
            read(instructions_.emplace_back(spirv.subspan(at, count)));
            at += count;
        }
    }

    void read(Words words) {
        const spv::Op op = opcode(words);
        if (is_float_arithmetic(op)) arithmetic_.push_back(operand(words, 2));
        if (op == spv::Op::OpEntryPoint) entry_point_ = operand(words, 2);
        if (op == spv::Op::OpDecorate && operand(words, 2) == static_cast<uint32_t>(spv::Decoration::NoContraction)) {
            decorated_.insert(words[1]);
        }
        if (op == spv::Op::OpCapability && operand(words, 1) == static_cast<uint32_t>(spv::Capability::GroupNonUniform)) {
            subgroups_ = true;
        }
        if (op == spv::Op::OpExecutionMode &&
            operand(words, 2) == static_cast<uint32_t>(spv::ExecutionMode::SubgroupUniformControlFlowKHR)) {
            declared_ = true;
        }
    }

    static void append(std::vector<uint32_t>& result, spv::Op op, std::span<const uint32_t> operands) {
        result.push_back(static_cast<uint32_t>((operands.size() + 1) << spv::WordCountShift) | static_cast<uint32_t>(op));
        result.insert(result.end(), operands.begin(), operands.end());
    }

    bool declares() const { return uniform_control_flow_ && subgroups_ && !declared_; }

    void append_extension(std::vector<uint32_t>& result) const {
        if (declares()) append(result, spv::Op::OpExtension, literal(kUniformControlFlow));
    }

    void append_execution_mode(std::vector<uint32_t>& result) const {
        if (!declares()) return;
        const std::array operands{entry_point_, static_cast<uint32_t>(spv::ExecutionMode::SubgroupUniformControlFlowKHR)};
        append(result, spv::Op::OpExecutionMode, operands);
    }

    void append_decorations(std::vector<uint32_t>& result) const {
        for (const uint32_t id : arithmetic_) {
            if (decorated_.contains(id)) continue;
            const std::array operands{id, static_cast<uint32_t>(spv::Decoration::NoContraction)};
            append(result, spv::Op::OpDecorate, operands);
        }
    }

    const Shader& shader_;
    bool uniform_control_flow_;
    std::vector<Words> instructions_;
    std::vector<uint32_t> arithmetic_;  // result ids
    std::set<uint32_t> decorated_;
    uint32_t entry_point_ = 0;
    bool subgroups_ = false;
    bool declared_ = false;
};

}  // namespace

std::vector<uint32_t> rewrite_spirv(const Shader& shader, bool uniform_control_flow) {
    return Rewriter(shader, uniform_control_flow).rewritten();
}

}  // namespace gnomon::gpu
