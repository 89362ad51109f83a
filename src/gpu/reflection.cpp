// SPDX-License-Identifier: Apache-2.0
// Reads the declarations of a SPIR-V module, all of which come before its first function.
#include "gpu/reflection.hpp"

#include <algorithm>
#include <gnomon/error.hpp>
#include <map>
#include <optional>
#include <spirv/unified1/spirv.hpp11>
#include <tuple>
#include <utility>

namespace gnomon::gpu {
namespace {

using Words = std::span<const uint32_t>;

/// The declarations of one module, by result id.
class Module {
public:
    Module(const Shader& shader, std::span<const Constant> constants) : shader_(shader) {
        parse();
        specialize(constants);
    }

    Reflection reflection() const {
        Reflection result;
        for (const auto& [id, words] : definitions_) {
            if (opcode(words) == spv::Op::OpVariable) add_variable(id, words, result);
        }
        for (const Words words : local_variables_) result.local_bytes += local_bytes(pointed_type(words));
        result.capabilities = capabilities_;
        check_unique(result.resources);
        result.local_size = local_size();
        return result;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorKind::internal, what, "shader " + shader_.name, "change the shader or the code that uses it");
    }

    static spv::Op opcode(Words words) { return static_cast<spv::Op>(words[0] & spv::OpCodeMask); }

    // Operand i of an instruction, its opcode word being 0.
    uint32_t operand(Words words, size_t i) const {
        if (i >= words.size()) fail("SPIR-V instruction is too short");
        return words[i];
    }

    std::string literal_string(Words words, size_t first) const {
        std::string text;
        for (size_t i = first; i < words.size(); ++i) {
            for (uint32_t byte = 0; byte < 4; ++byte) {
                const char c = static_cast<char>(words[i] >> (8 * byte));
                if (c == 0) return text;
                text += c;
            }
        }
        fail("SPIR-V string does not end");
    }

    void parse() {
        constexpr size_t kHeaderWords = 5;
        const Words spirv = shader_.spirv;
        if (spirv.size() < kHeaderWords || spirv[0] != spv::MagicNumber) fail("not a SPIR-V module");
        bool in_functions = false;
        for (size_t at = kHeaderWords; at < spirv.size();) {
            const size_t count = spirv[at] >> spv::WordCountShift;
            if (count == 0 || count > spirv.size() - at) fail("SPIR-V instruction runs past the end");
            const Words words = spirv.subspan(at, count);
            in_functions = in_functions || opcode(words) == spv::Op::OpFunction;
            if (!in_functions) read(words);
            if (opcode(words) == spv::Op::OpVariable && is_local(words)) local_variables_.push_back(words);
            at += count;
        }
        if (!has_entry_point_) fail("no compute entry point 'main'");
    }

    bool is_local(Words words) const {
        const auto storage = static_cast<spv::StorageClass>(operand(words, 3));
        return storage == spv::StorageClass::Function || storage == spv::StorageClass::Private ||
               storage == spv::StorageClass::Workgroup;
    }

    void read(Words words) {
        switch (opcode(words)) {
            case spv::Op::OpCapability:
                capabilities_.push_back(operand(words, 1));
                break;
            case spv::Op::OpEntryPoint:
                if (has_entry_point_ || operand(words, 1) != static_cast<uint32_t>(spv::ExecutionModel::GLCompute) ||
                    literal_string(words, 3) != "main") {
                    fail("an entry point other than one compute 'main'");
                }
                has_entry_point_ = true;
                break;
            case spv::Op::OpExecutionMode:
            case spv::Op::OpExecutionModeId:
                execution_modes_.push_back(words);
                break;
            case spv::Op::OpName:
                names_[operand(words, 1)] = literal_string(words, 2);
                break;
            case spv::Op::OpDecorate:
                decorations_[{operand(words, 1), decoration(words, 2)}] = words.size() > 3 ? words[3] : 0;
                break;
            case spv::Op::OpMemberDecorate:
                member_decorations_[{operand(words, 1), operand(words, 2), decoration(words, 3)}] =
                    words.size() > 4 ? words[4] : 0;
                break;
            case spv::Op::OpGroupDecorate:
            case spv::Op::OpGroupMemberDecorate:
                fail("SPIR-V decoration groups are not supported");
            case spv::Op::OpTypeInt:
            case spv::Op::OpTypeFloat:
            case spv::Op::OpTypeVector:
            case spv::Op::OpTypeMatrix:
            case spv::Op::OpTypeArray:
            case spv::Op::OpTypeRuntimeArray:
            case spv::Op::OpTypeStruct:
            case spv::Op::OpTypePointer:
            case spv::Op::OpTypeImage:
            case spv::Op::OpTypeSampledImage:
                definitions_[operand(words, 1)] = words;
                break;
            case spv::Op::OpConstant:
            case spv::Op::OpConstantComposite:
            case spv::Op::OpSpecConstant:
            case spv::Op::OpSpecConstantTrue:
            case spv::Op::OpSpecConstantFalse:
            case spv::Op::OpSpecConstantComposite:
            case spv::Op::OpVariable:
                definitions_[operand(words, 2)] = words;
                break;
            default:
                break;
        }
    }

    spv::Decoration decoration(Words words, size_t i) const { return static_cast<spv::Decoration>(operand(words, i)); }

    std::optional<uint32_t> decorated(uint32_t id, spv::Decoration decoration) const {
        const auto found = decorations_.find({id, decoration});
        return found == decorations_.end() ? std::nullopt : std::optional(found->second);
    }

    std::optional<uint32_t> member_decorated(uint32_t id, uint32_t member, spv::Decoration decoration) const {
        const auto found = member_decorations_.find({id, member, decoration});
        return found == member_decorations_.end() ? std::nullopt : std::optional(found->second);
    }

    Words definition(uint32_t id) const {
        const auto found = definitions_.find(id);
        if (found == definitions_.end()) fail("SPIR-V id " + std::to_string(id) + " is of a kind that is not supported here");
        return found->second;
    }

    std::string name(uint32_t id) const {
        const auto found = names_.find(id);
        return found == names_.end() ? std::string() : found->second;
    }

    // Several result ids may share one constant_id: each use of a local_size_x_id makes its own.
    void specialize(std::span<const Constant> constants) {
        for (size_t i = 0; i < constants.size(); ++i) {
            const std::string label = "specialization constant " + std::to_string(constants[i].id);
            for (size_t j = 0; j < i; ++j) {
                if (constants[j].id == constants[i].id) fail(label + " is given twice");
            }
            bool found = false;
            for (const auto& [key, constant_id] : decorations_) {
                if (key.second != spv::Decoration::SpecId || constant_id != constants[i].id) continue;
                const Words words = definition(key.first);
                if (opcode(words) == spv::Op::OpSpecConstant && words.size() != 4) fail(label + " is not of 32 bits");
                specialized_[key.first] = constants[i].value;
                found = true;
            }
            if (!found) fail("no " + label);
        }
    }

    uint32_t constant_value(uint32_t id) const {
        const auto specialized = specialized_.find(id);
        if (specialized != specialized_.end()) return specialized->second;
        const Words words = definition(id);
        if (opcode(words) != spv::Op::OpConstant && opcode(words) != spv::Op::OpSpecConstant) {
            fail("a size that is neither a constant nor a specialization constant");
        }
        return operand(words, 3);
    }

    // Bytes of a type in a block. Matrices take their stride from the member that holds them.
    uint64_t type_bytes(uint32_t id, uint32_t matrix_stride = 0, bool row_major = false) const {
        const Words words = definition(id);
        switch (opcode(words)) {
            case spv::Op::OpTypeInt:
            case spv::Op::OpTypeFloat:
                return operand(words, 2) / 8;
            case spv::Op::OpTypeVector:
                return operand(words, 3) * type_bytes(operand(words, 2));
            case spv::Op::OpTypeMatrix:
                return uint64_t{row_major ? operand(definition(operand(words, 2)), 3) : operand(words, 3)} * matrix_stride;
            case spv::Op::OpTypeArray:
                return uint64_t{constant_value(operand(words, 3))} * decorated(id, spv::Decoration::ArrayStride).value_or(0);
            case spv::Op::OpTypeRuntimeArray:
                return 0;
            case spv::Op::OpTypeStruct:
                return struct_bytes(id, words);
            default:
                fail("a block member of a type that is not supported");
        }
    }

    // Of a type outside blocks; what has no size of its own, as a bool, counts as a word.
    uint64_t local_bytes(uint32_t id) const {
        constexpr uint64_t kMost = uint64_t{1} << 32;  // No product of a length and this wraps around.
        const auto found = definitions_.find(id);
        if (found == definitions_.end()) return 4;
        const Words words = found->second;
        switch (opcode(words)) {
            case spv::Op::OpTypeInt:
            case spv::Op::OpTypeFloat:
                return operand(words, 2) / 8;
            case spv::Op::OpTypeVector:
            case spv::Op::OpTypeMatrix:
                return operand(words, 3) * local_bytes(operand(words, 2));
            case spv::Op::OpTypeArray:
                return std::min(kMost, constant_value(operand(words, 3)) * local_bytes(operand(words, 2)));
            case spv::Op::OpTypeStruct: {
                uint64_t bytes = 0;
                for (size_t member = 2; member < words.size(); ++member) bytes += local_bytes(words[member]);
                return std::min(kMost, bytes);
            }
            default:
                return 4;
        }
    }

    // What the pointer of a variable points to.
    uint32_t pointed_type(Words variable) const { return operand(definition(operand(variable, 1)), 3); }

    uint64_t struct_bytes(uint32_t id, Words words) const {
        uint64_t bytes = 0;
        for (uint32_t member = 0; member + 2 < words.size(); ++member) {
            const auto offset = member_decorated(id, member, spv::Decoration::Offset);
            if (!offset) fail("a block member without an offset");
            const uint32_t stride = member_decorated(id, member, spv::Decoration::MatrixStride).value_or(0);
            const bool row_major = member_decorated(id, member, spv::Decoration::RowMajor).has_value();
            bytes = std::max(bytes, *offset + type_bytes(words[member + 2], stride, row_major));
        }
        return bytes;
    }

    void add_variable(uint32_t id, Words words, Reflection& result) const {
        const auto storage = static_cast<spv::StorageClass>(operand(words, 3));
        const uint32_t type = pointed_type(words);
        if (storage == spv::StorageClass::PushConstant) {
            result.push_constant_bytes = static_cast<uint32_t>(type_bytes(type));
            return;
        }
        const auto binding = decorated(id, spv::Decoration::Binding);
        if (!binding) return;
        if (decorated(id, spv::Decoration::DescriptorSet).value_or(0) != 0) fail("a resource outside descriptor set 0");

        Resource resource{.name = name(type), .binding = *binding};
        const spv::Op op = opcode(definition(type));
        if (storage == spv::StorageClass::UniformConstant) {
            resource.name = name(id);
            resource.kind = texel_kind(resource.name, type);
        } else if (op == spv::Op::OpTypeStruct &&
                   (storage == spv::StorageClass::StorageBuffer || storage == spv::StorageClass::Uniform)) {
            const bool block = storage == spv::StorageClass::Uniform && !decorated(type, spv::Decoration::BufferBlock);
            resource.kind = block ? ResourceKind::uniform_buffer : ResourceKind::storage_buffer;
            resource.min_bytes = type_bytes(type);
            resource.writable = !block && !decorated(id, spv::Decoration::NonWritable) && !all_members_read_only(type);
        } else {
            fail("resource '" + name(id) + "' is an array or of a kind that is not supported");
        }
        result.resources.push_back(std::move(resource));
    }

    // glslang decorates the members of a readonly block, not its variable.
    bool all_members_read_only(uint32_t type) const {
        const size_t members = definition(type).size() - 2;
        for (uint32_t member = 0; member < members; ++member) {
            if (!member_decorated(type, member, spv::Decoration::NonWritable)) return false;
        }
        return true;
    }

    ResourceKind texel_kind(const std::string& variable, uint32_t type) const {
        Words image = definition(type);
        if (opcode(image) == spv::Op::OpTypeSampledImage) image = definition(operand(image, 2));
        constexpr uint32_t kSampled = 1;
        if (opcode(image) == spv::Op::OpTypeImage && operand(image, 3) == static_cast<uint32_t>(spv::Dim::Buffer) &&
            operand(image, 7) == kSampled) {
            const Words texel = definition(operand(image, 2));
            if (opcode(texel) == spv::Op::OpTypeFloat) return ResourceKind::float_texels;
            if (opcode(texel) == spv::Op::OpTypeInt && operand(texel, 3) == 0) return ResourceKind::uint_texels;
        }
        fail("resource '" + variable + "' is not a samplerBuffer or usamplerBuffer");
    }

    void check_unique(const std::vector<Resource>& resources) const {
        for (size_t i = 0; i < resources.size(); ++i) {
            if (resources[i].name.empty()) fail("a resource without a name (was the SPIR-V stripped?)");
            for (size_t j = 0; j < i; ++j) {
                if (resources[i].name == resources[j].name) fail("two resources named '" + resources[i].name + "'");
                if (resources[i].binding == resources[j].binding) {
                    fail("'" + resources[j].name + "' and '" + resources[i].name + "' share a binding number");
                }
            }
        }
    }

    std::array<uint32_t, 3> local_size() const {
        // A constant decorated as the built-in WorkgroupSize goes before the execution modes.
        for (const auto& [key, value] : decorations_) {
            if (key.second == spv::Decoration::BuiltIn && value == static_cast<uint32_t>(spv::BuiltIn::WorkgroupSize)) {
                const Words words = definition(key.first);
                return {constant_value(operand(words, 3)), constant_value(operand(words, 4)),
                        constant_value(operand(words, 5))};
            }
        }
        for (const Words words : execution_modes_) {
            const auto mode = static_cast<spv::ExecutionMode>(operand(words, 2));
            if (mode == spv::ExecutionMode::LocalSize) return {operand(words, 3), operand(words, 4), operand(words, 5)};
            if (mode == spv::ExecutionMode::LocalSizeId) {
                return {constant_value(operand(words, 3)), constant_value(operand(words, 4)),
                        constant_value(operand(words, 5))};
            }
        }
        fail("no local size");
    }

    const Shader& shader_;
    bool has_entry_point_ = false;
    std::vector<Words> execution_modes_, local_variables_;
    std::vector<uint32_t> capabilities_;
    std::map<uint32_t, std::string> names_;
    std::map<uint32_t, Words> definitions_;
    std::map<std::pair<uint32_t, spv::Decoration>, uint32_t> decorations_;
    std::map<std::tuple<uint32_t, uint32_t, spv::Decoration>, uint32_t> member_decorations_;
    std::map<uint32_t, uint32_t> specialized_;  // id of a constant: its value
};

}  // namespace

Reflection reflect(const Shader& shader, std::span<const Constant> constants) { return Module(shader, constants).reflection(); }

}  // namespace gnomon::gpu
