// SPDX-License-Identifier: Apache-2.0
#include "layouts/dependences.hpp"

#include <algorithm>
#include <gnomon/error.hpp>
#include <map>
#include <optional>
#include <set>
#define SPV_ENABLE_UTILITY_CODE
#include <spirv/unified1/spirv.hpp11>

namespace gnomon {
namespace {

using Words = std::span<const uint32_t>;

spv::Op opcode(Words words) { return static_cast<spv::Op>(words[0] & spv::OpCodeMask); }

// A variable, or a component of it: a vector's, or a structure's member.
struct Place {
    uint32_t variable = 0;
    std::optional<uint32_t> component;
};

// How values flow through a module: a graph over components of values and of variables, which are not told apart by when they
// are written.
class Flow {
public:
    Flow(Words spirv, const std::vector<std::string>& names) : names_(names) {
        constexpr size_t kHeaderWords = 5;
        if (spirv.size() < kHeaderWords || spirv[0] != spv::MagicNumber) fail();
        for (size_t at = kHeaderWords; at < spirv.size();) {
            const size_t count = spirv[at] >> spv::WordCountShift;
            if (count == 0 || count > spirv.size() - at) fail();
            instructions_.push_back(spirv.subspan(at, count));
            at += count;
        }
        for (const Words words : instructions_) declare(words);
        // What asks a constant is known then: once more without the other branch.
        size_t skipped = 0;
        do {
            skipped = unreachable_.size();
            edges_.clear();
            nodes_.clear();
            add_all();
            find_constants();
            find_unreachable();
        } while (unreachable_.size() > skipped);
    }

    // The numbers of reads whose indices are computed from what read j gives.
    std::set<size_t> needing(size_t j) {
        std::set<size_t> found;
        std::set<uint32_t> seen;
        std::vector<uint32_t> open = {read_node(j)};
        while (!open.empty()) {
            const uint32_t node = open.back();
            open.pop_back();
            for (const uint32_t next : edges_[node]) {
                const auto read = std::find(reads_.begin(), reads_.end(), next);
                if (read != reads_.end()) found.insert(static_cast<size_t>(read - reads_.begin()));
                if (read == reads_.end() && seen.insert(next).second) open.push_back(next);
            }
        }
        return found;
    }

private:
    [[noreturn]] static void fail() {
        throw Error(ErrorKind::internal, "not a SPIR-V module", "a layout's stage", "report this as a bug");
    }

    void declare(Words words) {
        bool has_result = false, has_type = false;
        spv::HasResultAndType(opcode(words), &has_result, &has_type);
        if (has_result && has_type) {
            type_of_[words[2]] = words[1];
            definition_[words[2]] = words;
        } else if (has_result) {
            definition_[words[1]] = words;
        }
        switch (opcode(words)) {
            case spv::Op::OpName:
                name_of_[words[1]] = reinterpret_cast<const char*>(&words[2]);
                break;
            case spv::Op::OpFunction:
                function_ = words[2];
                break;
            case spv::Op::OpFunctionParameter:
                parameters_[function_].push_back(words[2]);
                break;
            case spv::Op::OpReturnValue:
                returned_[function_].push_back(words[1]);
                break;
            default:
                break;
        }
    }

    Words definition(uint32_t id) const {
        const auto found = definition_.find(id);
        if (found == definition_.end()) fail();
        return found->second;
    }

    bool is_pointer(uint32_t id) const { return opcode(definition(type_of_.at(id))) == spv::Op::OpTypePointer; }

    // Of a type, or of what a pointer points to.
    Words value_type(uint32_t type) const {
        const Words words = definition(type);
        return opcode(words) == spv::Op::OpTypePointer ? definition(words[3]) : words;
    }
    uint32_t component_count(uint32_t id) const {
        const Words type = value_type(type_of_.at(id));
        if (opcode(type) == spv::Op::OpTypeVector) return type[3];
        return opcode(type) == spv::Op::OpTypeStruct ? static_cast<uint32_t>(type.size() - 2) : 1;
    }

    uint32_t node(uint32_t id, uint32_t component) {
        const auto [found, is_new] = nodes_.emplace(std::pair(id, component), static_cast<uint32_t>(edges_.size()));
        if (is_new) edges_.emplace_back();
        return found->second;
    }
    // What a read gives, and what its index is: one node.
    uint32_t read_node(size_t read) const { return reads_[read]; }

    void add(uint32_t from, uint32_t to) { edges_[from].push_back(to); }

    std::vector<uint32_t> nodes_of(uint32_t id) {
        std::vector<uint32_t> all;
        for (uint32_t i = 0; i < component_count(id); ++i) all.push_back(node(id, i));
        return all;
    }
    std::vector<uint32_t> nodes_of(const Place& place) {
        return place.component ? std::vector{node(place.variable, *place.component)} : nodes_of(place.variable);
    }
    // Component by component where there are as many; else each to all.
    void flow(const std::vector<uint32_t>& from, const std::vector<uint32_t>& to) {
        for (size_t i = 0; i < from.size(); ++i) {
            for (size_t j = 0; j < to.size(); ++j) {
                if (from.size() != to.size() || i == j) add(from[i], to[j]);
            }
        }
    }
    bool is_value(uint32_t id) const { return type_of_.contains(id); }

    // Which of the reads a variable is.
    std::optional<size_t> read_of(uint32_t variable) const {
        if (!in_memory(variable)) return std::nullopt;  // A local variable may have a buffer's name.
        const auto named = [&](uint32_t id) {
            const auto name = name_of_.find(id);
            return name == name_of_.end() ? names_.end() : std::find(names_.begin(), names_.end(), name->second);
        };
        auto found = named(variable);
        if (found == names_.end()) found = named(value_type(type_of_.at(variable))[1]);
        return found == names_.end() ? std::nullopt : std::optional(static_cast<size_t>(found - names_.begin()));
    }

    Place place_of(uint32_t pointer) const {
        const Words words = definition(pointer);
        if (opcode(words) != spv::Op::OpAccessChain && opcode(words) != spv::Op::OpInBoundsAccessChain) return {pointer, {}};
        Place place = place_of(words[3]);
        if (place.component || words.size() < 5) return place;
        const Words index = definition(words[4]), type = value_type(type_of_.at(place.variable));
        const bool has_components = opcode(type) == spv::Op::OpTypeVector || opcode(type) == spv::Op::OpTypeStruct;
        if (opcode(index) == spv::Op::OpConstant && has_components) place.component = index[3];
        return place;
    }

    void add_all() {
        reads_.clear();
        for (size_t i = 0; i < names_.size(); ++i) reads_.push_back(node(0, static_cast<uint32_t>(i)));
        for (size_t i = 0; i < instructions_.size(); ++i) {
            if (!unreachable_.contains(i)) add_instruction(instructions_[i]);
        }
    }

    void add_instruction(Words words) {
        switch (opcode(words)) {
            case spv::Op::OpFunctionCall:
                return add_call(words);
            case spv::Op::OpStore:
                return add_store(words);
            case spv::Op::OpLoad:
                return add_load(words);
            case spv::Op::OpAccessChain:
            case spv::Op::OpInBoundsAccessChain:
                return add_access(words);
            case spv::Op::OpImageFetch:
                if (const auto read = read_of(image_variable(words[3]))) {
                    flow(nodes_of(words[4]), {read_node(*read)});
                    flow({read_node(*read)}, nodes_of(words[2]));
                }
                return;
            case spv::Op::OpCompositeConstruct:
                return add_construction(words);
            case spv::Op::OpCompositeExtract:
                return flow(component_count(words[3]) > words[4] ? std::vector{node(words[3], words[4])} : nodes_of(words[3]),
                            nodes_of(words[2]));
            case spv::Op::OpCompositeInsert: {
                flow(nodes_of(words[4]), nodes_of(words[2]));
                return flow(nodes_of(words[3]), {node(words[2], std::min(words[5], component_count(words[2]) - 1))});
            }
            case spv::Op::OpVectorShuffle: {
                const uint32_t first = component_count(words[3]);
                for (uint32_t i = 5; i < words.size(); ++i) {
                    if (words[i] == ~0u) continue;
                    add(words[i] < first ? node(words[3], words[i]) : node(words[4], words[i] - first), node(words[2], i - 5));
                }
                return;
            }
            case spv::Op::OpPhi:
                for (size_t i = 3; i + 1 < words.size(); i += 2) {
                    if (!unreachable_labels_.contains(words[i + 1])) flow(nodes_of(words[i]), nodes_of(words[2]));
                }
                return;
            case spv::Op::OpVariable:
            case spv::Op::OpFunction:
            case spv::Op::OpFunctionParameter:
            case spv::Op::OpConstant:
            case spv::Op::OpSpecConstant:
            case spv::Op::OpConstantComposite:
            case spv::Op::OpImage:
            case spv::Op::OpImageQuerySize:
            case spv::Op::OpArrayLength:
                return;
            default:
                return add_operation(words);
        }
    }

    // Any other: of all its operands.
    void add_operation(Words words) {
        bool has_result = false, has_type = false;
        spv::HasResultAndType(opcode(words), &has_result, &has_type);
        if (!has_type) return;
        for (size_t i = opcode(words) == spv::Op::OpExtInst ? 5 : 3; i < words.size(); ++i) {
            if (is_value(words[i]) && !is_pointer(words[i])) flow(nodes_of(words[i]), nodes_of(words[2]));
        }
    }

    void add_construction(Words words) {
        std::vector<uint32_t> parts;
        const bool members = opcode(value_type(words[1])) == spv::Op::OpTypeStruct;
        for (uint32_t i = 3; i < words.size(); ++i) {
            if (members) {
                flow(nodes_of(words[i]), {node(words[2], i - 3)});
                continue;
            }
            const std::vector<uint32_t> part = nodes_of(words[i]);
            parts.insert(parts.end(), part.begin(), part.end());
        }
        if (!members) flow(parts, nodes_of(words[2]));
    }

    void add_call(Words words) {
        const std::vector<uint32_t>& parameters = parameters_[words[3]];
        for (size_t i = 0; i < parameters.size() && i + 4 < words.size(); ++i) {
            const uint32_t argument = words[i + 4];
            if (!is_pointer(argument)) {
                flow(nodes_of(argument), nodes_of(parameters[i]));
                continue;
            }
            flow(nodes_of(place_of(argument)), nodes_of(parameters[i]));
            flow(nodes_of(parameters[i]), nodes_of(place_of(argument)));
        }
        for (const uint32_t value : returned_[words[3]]) flow(nodes_of(value), nodes_of(words[2]));
    }

    void add_store(Words words) {
        const Place place = place_of(words[1]);
        if (!in_memory(place.variable)) flow(nodes_of(words[2]), nodes_of(place));
    }

    void add_load(Words words) {
        const Place place = place_of(words[3]);
        if (const auto read = read_of(place.variable)) {
            if (place.variable != words[3]) flow({read_node(*read)}, nodes_of(words[2]));  // Not the texel buffer itself.
        } else if (!in_memory(place.variable)) {
            flow(nodes_of(place), nodes_of(words[2]));
        }
    }

    // The index of an element of a block.
    void add_access(Words words) {
        const auto read = read_of(place_of(words[3]).variable);
        for (size_t i = 4; read && i < words.size(); ++i) flow(nodes_of(words[i]), {read_node(*read)});
    }

    // Not of the invocation alone: whatever is there was not read just now.
    bool in_memory(uint32_t variable) const {
        const Words words = definition(variable);
        if (opcode(words) != spv::Op::OpVariable) return false;
        const auto storage = static_cast<spv::StorageClass>(words[3]);
        return storage != spv::StorageClass::Function && storage != spv::StorageClass::Private;
    }

    uint32_t image_variable(uint32_t image) const {
        const Words words = definition(image);
        const bool passes_on = opcode(words) == spv::Op::OpImage || opcode(words) == spv::Op::OpLoad;
        return passes_on ? image_variable(words[3]) : image;
    }

    // Nodes that can only be false: nothing else flows there.
    void find_constants() {
        std::vector<std::vector<uint32_t>> sources(edges_.size());
        for (uint32_t from = 0; from < edges_.size(); ++from) {
            for (const uint32_t to : edges_[from]) sources[to].push_back(from);
        }
        // At first all that something flows to; then those go that anything flows to which does not stay.
        std::vector<bool> constant(edges_.size());
        for (uint32_t i = 0; i < edges_.size(); ++i) constant[i] = !sources[i].empty();
        for (const auto& [key, index] : nodes_) {
            if (key.first != 0 && opcode(definition(key.first)) == spv::Op::OpConstantFalse) constant[index] = true;
        }
        for (bool changed = true; changed;) {
            changed = false;
            for (const auto& [key, index] : nodes_) {
                const bool source = key.first != 0 && opcode(definition(key.first)) == spv::Op::OpConstantFalse;
                if (source || !constant[index]) continue;
                const bool computed = key.first == 0 || is_computed(definition(key.first));
                if (computed ||
                    !std::all_of(sources[index].begin(), sources[index].end(), [&](uint32_t s) { return constant[s]; })) {
                    constant[index] = false;
                    changed = true;
                }
            }
        }
        for (const auto& [key, index] : nodes_) {
            if (constant[index] && component_count(key.first) == 1) false_.insert(key.first);
        }
    }
    // Not only passed on.
    static bool is_computed(Words words) {
        switch (opcode(words)) {
            case spv::Op::OpVariable:
            case spv::Op::OpFunctionParameter:
            case spv::Op::OpLoad:
            case spv::Op::OpCompositeConstruct:
            case spv::Op::OpCompositeExtract:
            case spv::Op::OpCopyObject:
            case spv::Op::OpPhi:
                return false;
            default:
                return true;
        }
    }

    // Instructions that no branch or call leads to from the entry point.
    void find_unreachable() {
        std::map<uint32_t, size_t> blocks;  // By their labels, and the first ones by their functions.
        std::vector<size_t> open;
        for (size_t i = 0, function = 0; i < instructions_.size(); ++i) {
            const Words words = instructions_[i];
            if (opcode(words) == spv::Op::OpEntryPoint) entry_ = words[2];
            if (opcode(words) == spv::Op::OpFunction) function = words[2];
            if (opcode(words) != spv::Op::OpLabel) continue;
            blocks[words[1]] = i;
            blocks.emplace(static_cast<uint32_t>(function), i);
        }
        open.push_back(blocks.at(entry_));
        std::set<size_t> reached;
        while (!open.empty()) {
            const size_t block = open.back();
            open.pop_back();
            if (!reached.insert(block).second) continue;
            for (const uint32_t id : leads_to(block)) open.push_back(blocks.at(id));
        }
        bool skipped = false;
        for (size_t i = 0; i < instructions_.size(); ++i) {
            const spv::Op op = opcode(instructions_[i]);
            if (op == spv::Op::OpLabel) skipped = !reached.contains(i);
            if (op == spv::Op::OpLabel && skipped) unreachable_labels_.insert(instructions_[i][1]);
            if (op == spv::Op::OpFunctionEnd) skipped = false;
            if (skipped) unreachable_.insert(i);
        }
    }
    // Labels of the blocks behind one, and functions that it calls.
    std::vector<uint32_t> leads_to(size_t block) const {
        std::vector<uint32_t> ids;
        for (size_t i = block + 1;; ++i) {
            const Words words = instructions_[i];
            switch (opcode(words)) {
                case spv::Op::OpFunctionCall:
                    ids.push_back(words[3]);
                    break;
                case spv::Op::OpBranch:
                    ids.push_back(words[1]);
                    return ids;
                case spv::Op::OpBranchConditional:
                    if (!false_.contains(words[1])) ids.push_back(words[2]);
                    ids.push_back(words[3]);
                    return ids;
                case spv::Op::OpSwitch:
                    for (size_t k = 2; k < words.size(); k += 2) ids.push_back(words[k]);
                    return ids;
                case spv::Op::OpFunctionEnd:  // Behind what returns.
                case spv::Op::OpLabel:
                    return ids;
                default:
                    break;
            }
        }
    }

    const std::vector<std::string>& names_;
    std::vector<Words> instructions_;
    std::map<uint32_t, Words> definition_;
    std::map<uint32_t, uint32_t> type_of_;
    std::map<uint32_t, std::string> name_of_;
    uint32_t function_ = 0, entry_ = 0;
    std::map<uint32_t, std::vector<uint32_t>> parameters_, returned_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> nodes_;
    std::vector<std::vector<uint32_t>> edges_;
    std::vector<uint32_t> reads_;  // Nodes.
    std::set<uint32_t> false_;
    std::set<size_t> unreachable_;  // Instructions.
    std::set<uint32_t> unreachable_labels_;
};

}  // namespace

Dependences::Dependences(std::span<const uint32_t> spirv, const std::vector<std::string>& names)
    : waits_(names.size(), std::vector<bool>(names.size())) {
    Flow flow(spirv, names);
    for (size_t j = 0; j < names.size(); ++j) {
        for (const size_t i : flow.needing(j)) waits_[i][j] = true;
    }
    reaches_ = waits_;
    for (size_t k = 0; k < names.size(); ++k) {
        for (size_t i = 0; i < names.size(); ++i) {
            for (size_t j = 0; j < names.size(); ++j) reaches_[i][j] = reaches_[i][j] || (reaches_[i][k] && reaches_[k][j]);
        }
    }
}

uint64_t Dependences::longest_chain(std::span<const uint32_t> reads) const {
    // Of each read, with those that lead back to it, and the longest chain that these wait for.
    std::vector<uint64_t> chains(reads.size());
    for (size_t round = 0; round < reads.size(); ++round) {
        for (size_t i = 0; i < reads.size(); ++i) {
            if (reads[i] == 0) continue;
            uint64_t own = reaches_[i][i] ? 0 : 1, before = 0;
            for (size_t j = 0; j < reads.size(); ++j) {
                const bool together = reaches_[i][j] && reaches_[j][i];
                if (together) own += reads[j];
                if (reaches_[i][j] && !together) before = std::max(before, chains[j]);
            }
            chains[i] = own + before;
        }
    }
    return chains.empty() ? 0 : *std::max_element(chains.begin(), chains.end());
}

}  // namespace gnomon
