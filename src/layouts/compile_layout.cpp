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
#include "source_table.h"
#include "text/read_text.hpp"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

// glslang itself has no limits.
constexpr size_t kMostNested = 32;
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
};
constexpr uint32_t kFirstBinding = 16;
constexpr uint32_t kEndBinding = 40;
constexpr const char* kHint = "see CONTRIBUTING.md, A new layout";

const EmbeddedFile* find_source(const std::string& name) {
    auto found = std::find_if(std::begin(kSourceTable), std::end(kSourceTable), [&](const auto& s) { return s.name == name; });
    return found == std::end(kSourceTable) ? nullptr : found;
}

// Resolves includes: those of the stages among the embedded sources, whose names are relative; layout.glsl, and what it
// includes, in the layout's folder under absolute names.
class Includer : public glslang::TShader::Includer {
public:
    explicit Includer(const fs::path& folder) : folder_(folder) {}

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
        if (from.is_absolute()) return in_folder(header, from);
        if (header == "layout.glsl") return in_folder(header, folder_);
        for (const fs::path& name : {(from / header).lexically_normal(), header}) {
            if (const EmbeddedFile* source = find_source(name.generic_string())) return made(name, source->text);
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

    fs::path folder_;
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
Compiled compile(const EmbeddedFile& source, const std::string& name, const fs::path& folder, bool storage_reads) {
    const char* text = source.text.data();
    const int length = static_cast<int>(source.text.size());
    const char* text_name = name.c_str();

    // As glslangValidator --target-env vulkan1.3.
    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&text, &length, &text_name, 1);
    if (storage_reads) shader.setPreamble("#define GN_STORAGE_READS\n");
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(folder);
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
    const EmbeddedFile* source = find_source(name);
    if (source == nullptr) throw Error(ErrorKind::internal, "no such stage", stage, "report this as a bug");
    const std::string where = (layout.folder / "layout.glsl").string();
    // First a byte that says which, then the words or the log.
    const auto work = [&] {
        const Compiled compiled = compile(*source, name, layout.folder, storage_reads);
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

// What the manifest promises a stage: the blocks to one that writes, the texel buffers to one that reads.
std::vector<gpu::Resource> promised(const Layout& layout, bool writes) {
    std::vector<gpu::Resource> result;
    for (const LayoutBuffer& b : layout.buffers) {
        if (writes) {
            result.push_back({b.block, gpu::ResourceKind::storage_buffer});
        } else if (!b.texel.empty()) {
            result.push_back({b.texel, is_float(b.format) ? gpu::ResourceKind::float_texels : gpu::ResourceKind::uint_texels});
        }
    }
    return result;
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

void check_buffers(const std::vector<uint32_t>& words, const std::string& stage, const Layout& layout, bool storage_reads) {
    const std::string where = (layout.folder / "layout.json").string();
    gpu::Reflection code;
    try {
        code = gpu::reflect({stage, words}, {});
    } catch (const Error& error) {
        throw Error(ErrorKind::input, std::string("not what a layout may declare: ") + error.what(),
                    (layout.folder / "layout.glsl").string(), kHint);
    }
    check_code(code, layout);
    std::vector<gpu::Resource> declared = std::move(code.resources);
    std::erase_if(declared, [](const gpu::Resource& r) { return r.binding < kFirstBinding || r.binding >= kEndBinding; });
    const auto named = [](const std::string& name) { return [&name](const gpu::Resource& r) { return r.name == name; }; };
    const bool writes = stage.starts_with("raster/");
    const std::vector<gpu::Resource> expected = promised(layout, writes);
    for (const gpu::Resource& e : expected) {
        auto d = std::find_if(declared.begin(), declared.end(), named(e.name));
        if (d == declared.end()) {
            throw Error(ErrorKind::input, "layout.glsl declares no '" + e.name + "' at a binding from 16 to 39 for " + stage,
                        where, kHint);
        }
        // What is declared by READ_... is a storage buffer in that variant.
        if (d->kind != e.kind && !(storage_reads && d->kind == gpu::ResourceKind::storage_buffer)) {
            throw Error(ErrorKind::input, "'" + e.name + "' is of another kind or format in layout.glsl", where, kHint);
        }
    }
    for (const LayoutBuffer& b : layout.buffers) {
        if (!writes) break;
        const auto d = std::find_if(declared.begin(), declared.end(), named(b.block));
        if (d->min_bytes <= b.element_bytes) continue;
        throw Error(ErrorKind::input,
                    "block '" + b.block + "' holds " + std::to_string(d->min_bytes) +
                        " bytes before any array without a length, its buffer may have " + std::to_string(b.element_bytes),
                    where + ":" + std::to_string(b.line), kHint);
    }
    for (const gpu::Resource& d : declared) {
        if (std::none_of(expected.begin(), expected.end(), named(d.name)))
            throw Error(ErrorKind::input, "no buffer for '" + d.name + "', which layout.glsl declares for " + stage, where,
                        kHint);
    }
}

}  // namespace

std::vector<uint32_t> compile_stage(const std::string& stage, const Layout& layout, bool storage_reads) {
    std::vector<uint32_t> words = compile_in_child(stage, layout, storage_reads);
    check_buffers(words, stage, layout, storage_reads);
    return words;
}

}  // namespace gnomon
