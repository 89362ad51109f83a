// SPDX-License-Identifier: Apache-2.0
#include "layouts/compile_layout.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <gnomon/error.hpp>
#include <optional>
#include <regex>
#include <spirv/unified1/spirv.hpp11>
#include <sstream>

#include "gpu/reflection.hpp"
#include "layouts/child_process.hpp"
#include "layouts/interface.hpp"
#include "layouts/sources.hpp"
#include "text/read_text.hpp"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

// glslang itself has no limits.
constexpr size_t kMostNested = 40;
constexpr size_t kMostIncludes = 1000;
constexpr size_t kMostSourceBytes = size_t{4} << 20;
constexpr size_t kMostWords = size_t{1} << 18;  // Of SPIR-V, ten times the longest stage of ours.
// Drivers keep them on their stack, for each lane.
constexpr uint64_t kMostLocalBytes = 16384;
// Those that the device is opened for.
constexpr spv::Capability kCapabilities[] = {
    spv::Capability::Shader,
    spv::Capability::SampledBuffer,
    spv::Capability::ImageQuery,
    spv::Capability::GroupNonUniform,
    spv::Capability::GroupNonUniformArithmetic,
    spv::Capability::GroupNonUniformShuffle,
    // Of buffers with such elements, which a device without them does not get (add_layout_stages).
    spv::Capability::StorageBuffer8BitAccess,
    spv::Capability::StorageBuffer16BitAccess,
};
constexpr const char* kHint = "see docs/layouts.md";

// Resolves includes: those of the stages, and of a layout that is built in, among the embedded sources, whose names are
// relative; layout.glsl in a folder, and what it includes, there, under absolute names. Both may include from "library/".
class Includer : public glslang::TShader::Includer {
public:
    explicit Includer(const Layout& layout)
        : folder_(layout.folder), built_in_("layouts/" + layout.name), interface_(layout_interface(layout)) {}

    IncludeResult* includeLocal(const char* header, const char* includer, size_t depth) override {
        return resolve(header, fs::path(includer).parent_path(), depth);
    }
    // Asked after includeLocal has failed, too: its result is what glslang reports.
    IncludeResult* includeSystem(const char* header, const char* includer, size_t depth) override {
        return resolve(header, fs::path(includer).parent_path(), depth);
    }
    void releaseInclude(IncludeResult*) override {}

private:
    IncludeResult* resolve(const fs::path& header, const fs::path& from, size_t depth) {
        if (depth > kMostNested) return failed("includes are nested too deeply");
        if (from.is_absolute() && *header.begin() != "library") return in_folder(header, from);
        if (header == "layout_interface.glsl") return made(header, interface_);
        if (header == "layout.glsl" && !folder_.empty()) return in_folder(header, folder_);
        for (const fs::path& name : {(from / header).lexically_normal(), header, built_in_ / header}) {
            if (const auto text = find_source(name.generic_string())) return made(name, *text);
        }
        return failed("no such source");
    }

    IncludeResult* in_folder(const fs::path& header, const fs::path& from) {
        if (header.is_absolute() || std::find(header.begin(), header.end(), "..") != header.end())
            return failed("a layout includes only files of its own folder");
        std::error_code error;
        const fs::path file = fs::weakly_canonical(from / header, error);
        const auto [end, ignored] = std::mismatch(folder_.begin(), folder_.end(), file.begin(), file.end());
        if (error || end != folder_.end())
            return failed("a layout includes only files of its own folder, and no links out of it");
        std::string reason;
        std::optional<std::string> text = read_text(file, reason);
        if (!text) return failed(texts_.emplace_back("cannot be read from the layout's folder: " + reason));
        bytes_ += text->size();
        if (++count_ > kMostIncludes || bytes_ > kMostSourceBytes)
            return failed("a layout's includes are too many or too long");
        return made(file, texts_.emplace_back(std::move(*text)));
    }

    IncludeResult* made(const fs::path& name, std::string_view text) {
        return &results_.emplace_back(name.string(), text.data(), text.size(), nullptr);
    }
    IncludeResult* failed(std::string_view message) { return made({}, message); }

    fs::path folder_, built_in_;
    std::string interface_;
    size_t count_ = 0, bytes_ = 0;  // Of includes from there.
    std::deque<std::string> texts_;
    std::deque<IncludeResult> results_;
};

// The first error of a glslang log: "ERROR: <file>:<line>: <message>", or, of the linker, a message that may end in an indented
// line.
[[noreturn]] void fail(const std::string& log, const Layout& layout) {
    std::string where = (layout.folder / "layout.glsl").string();
    std::string what = log.substr(0, log.find('\n'));
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("ERROR: ")) continue;
        what = line.substr(7);
        std::smatch part;
        if (!std::regex_match(what, part, std::regex("(.*?):(\\d+): (?:'' : +)?(.*)"))) {
            if (std::getline(lines, line) && line.starts_with(' ')) what += line.substr(line.find_first_not_of(' '));
            break;
        }
        std::string file = part[1], place = file + ":" + std::string(part[2]), message = part[3];
        if (file == "layout_interface.glsl" && message.find("redefinition") != message.npos) {
            const std::string name = message.substr(0, message.find(" :"));
            throw Error(ErrorKind::input, "the name " + name + " is one of the stages' own",
                        (layout.folder / "layout.json").string(), "give the buffer or size another name");
        }
        // Elsewhere than in the layout: a stage does not find there what it asks for.
        const bool in_layout = fs::path(file).is_absolute();
        what = message + (in_layout ? "" : " (" + place + ")");
        if (in_layout) where = place;
        break;
    }
    throw Error(ErrorKind::input, "layout does not compile: " + what, where, kHint);
}

// What the compiler makes of a stage: words, or the log of what is wrong.
struct Compiled {
    std::vector<uint32_t> words;
    std::string log;
};

// In a process that may be lost: glslang recurses as deep as an expression does, and a small text may be expanded to a large
// one.
Compiled compile(std::string_view source, const std::string& name, const Layout& layout, bool storage_reads) {
    const char* text = source.data();
    const int length = static_cast<int>(source.size());
    const char* text_name = name.c_str();

    // As glslangValidator --target-env vulkan1.3.
    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&text, &length, &text_name, 1);
    if (storage_reads) shader.setPreamble("#define GN_STORAGE_READS\n");
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(layout);
    if (!shader.parse(GetDefaultResources(), 100, false, messages, includer)) return {{}, shader.getInfoLog()};

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) return {{}, program.getInfoLog()};
    Compiled compiled;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), compiled.words);
    return compiled;
}

std::vector<uint32_t> compile_in_child(const std::string& stage, const Layout& layout, bool storage_reads) {
    struct Process {
        Process() { glslang::InitializeProcess(); }
        ~Process() { glslang::FinalizeProcess(); }
    };
    static const Process process;

    const std::string name = stage + ".comp";
    const std::optional<std::string_view> source = find_source(name);
    if (!source) throw Error(ErrorKind::internal, "no such stage", stage, "report this as a bug");
    const std::string where = (layout.folder / "layout.glsl").string();
    // First a byte that says which, then the words or the log.
    const auto work = [&] {
        const Compiled compiled = compile(*source, name, layout, storage_reads);
        if (compiled.words.empty()) return "-" + compiled.log;
        return "+" + std::string(reinterpret_cast<const char*>(compiled.words.data()), compiled.words.size() * 4);
    };
    std::string reason;
    const std::string result = run_in_child(work, {}, reason);
    if (result.empty()) {
        throw Error(ErrorKind::input, "layout does not compile: the compiler " + reason, where,
                    "write what is nested deeply, expanded or long in a simpler way; " + std::string(kHint));
    }
    if (result[0] == '-') fail(result.substr(1), layout);
    std::vector<uint32_t> words(result.size() / 4);
    std::memcpy(words.data(), result.data() + 1, words.size() * 4);
    if (words.size() > kMostWords) {
        throw Error(ErrorKind::input,
                    "layout is too long: " + std::to_string(words.size()) + " words of SPIR-V for " + stage +
                        " are more than " + std::to_string(kMostWords),
                    where, kHint);
    }
    return words;
}

std::string name_of(uint32_t capability) {
    constexpr std::pair<spv::Capability, const char*> kNames[] = {
        {spv::Capability::Float64, "Float64"},
        {spv::Capability::Float16, "Float16"},
        {spv::Capability::Int64, "Int64"},
        {spv::Capability::Int64Atomics, "Int64Atomics"},
        {spv::Capability::Int16, "Int16"},
        {spv::Capability::Int8, "Int8"},
        {spv::Capability::PhysicalStorageBufferAddresses, "PhysicalStorageBufferAddresses"},
        {spv::Capability::RayQueryKHR, "RayQueryKHR"},
        {spv::Capability::GroupNonUniformBallot, "GroupNonUniformBallot"},
        {spv::Capability::GroupNonUniformVote, "GroupNonUniformVote"},
    };
    for (const auto& [known, name] : kNames) {
        if (static_cast<uint32_t>(known) == capability) return name;
    }
    return "number " + std::to_string(capability);
}

// What a layout's code may be: a driver trusts it.
void check_code(const gpu::Reflection& code, const Layout& layout) {
    const std::string where = (layout.folder / "layout.glsl").string();
    for (uint32_t c : code.capabilities) {
        if (std::find(std::begin(kCapabilities), std::end(kCapabilities), static_cast<spv::Capability>(c)) ==
            std::end(kCapabilities)) {
            throw Error(ErrorKind::input,
                        "layout uses the SPIR-V capability " + name_of(c) + ", which gnomon opens no device with", where,
                        kHint);
        }
    }
    if (code.local_bytes > kMostLocalBytes) {
        throw Error(ErrorKind::input,
                    "layout's local variables take " + std::to_string(code.local_bytes) +
                        " bytes of an invocation, more than " + std::to_string(kMostLocalBytes),
                    where, "use smaller arrays, or a buffer");
    }
}

void check_resources(const std::vector<uint32_t>& words, const std::string& stage, const Layout& layout,
                     std::set<std::string> expected) {
    const std::string where = (layout.folder / "layout.glsl").string();
    gpu::Reflection code;
    try {
        code = gpu::reflect({stage, words}, {});
    } catch (const Error& error) {
        throw Error(ErrorKind::input, std::string("not what a layout may declare: ") + error.what(), where, kHint);
    }
    check_code(code, layout);
    expected.insert({"LayoutCounters", "LayoutFaults", "LayoutReads", "LayoutAtomics"});
    for (const LayoutSize& size : layout.sizes) expected.insert(read_name(size));
    for (const LayoutBuffer& buffer : layout.buffers) expected.insert({buffer.name, written_name(buffer)});
    for (const gpu::Resource& resource : code.resources) {
        if (expected.count(resource.name) > 0) continue;
        throw Error(ErrorKind::input, "layout declares '" + resource.name + "', which gnomon binds nothing to", where,
                    "name it among the 'buffers' of layout.json; " + std::string(kHint));
    }
}

}  // namespace

std::vector<uint32_t> compile_stage(const std::string& stage, const Layout& layout, bool storage_reads,
                                    const std::set<std::string>& bound) {
    std::vector<uint32_t> words = compile_in_child(stage, layout, storage_reads);
    check_resources(words, stage, layout, bound);
    return words;
}

}  // namespace gnomon
