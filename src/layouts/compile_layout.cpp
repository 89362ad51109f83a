// SPDX-License-Identifier: Apache-2.0
#include "layouts/compile_layout.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <deque>
#include <gnomon/error.hpp>
#include <optional>
#include <regex>
#include <sstream>

#include "gpu/reflection.hpp"
#include "source_table.h"
#include "text/read_text.hpp"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostNested = 32;  // Includes; glslang itself has no limit.
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
        std::string reason;
        std::optional<std::string> text = read_text(from / header, reason);
        if (!text) return failed(texts_.emplace_back("cannot be read from the layout's folder: " + reason));
        return made(from / header, texts_.emplace_back(std::move(*text)));
    }

    IncludeResult* made(const fs::path& name, std::string_view text) {
        return &results_.emplace_back(name.string(), text.data(), text.size(), nullptr);
    }
    IncludeResult* failed(std::string_view message) { return made({}, message); }

    fs::path folder_;
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

std::vector<uint32_t> compile(const std::string& stage, const Layout& layout, bool storage_reads) {
    struct Process {
        Process() { glslang::InitializeProcess(); }
        ~Process() { glslang::FinalizeProcess(); }
    };
    static const Process process;

    const std::string name = stage + ".comp";
    const EmbeddedFile* source = find_source(name);
    if (source == nullptr) throw Error(ErrorKind::internal, "no such stage", stage, "report this as a bug");
    const char* text = source->text.data();
    const int length = static_cast<int>(source->text.size());
    const char* text_name = name.c_str();

    // As glslangValidator --target-env vulkan1.3.
    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&text, &length, &text_name, 1);
    if (storage_reads) shader.setPreamble("#define GN_STORAGE_READS\n");
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(layout.folder);
    if (!shader.parse(GetDefaultResources(), 100, false, messages, includer)) fail(shader.getInfoLog(), layout);

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) fail(program.getInfoLog(), layout);
    std::vector<uint32_t> words;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words);
    return words;
}

bool is_float(gpu::Texel format) {
    return format == gpu::Texel::r32_float || format == gpu::Texel::rg32_float || format == gpu::Texel::rgba32_float;
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

void check_buffers(const std::vector<uint32_t>& words, const std::string& stage, const Layout& layout, bool storage_reads) {
    const std::string where = (layout.folder / "layout.json").string();
    std::vector<gpu::Resource> declared;
    try {
        declared = gpu::reflect({stage, words}, {}).resources;
    } catch (const Error& error) {
        throw Error(ErrorKind::input, std::string("not what a layout may declare: ") + error.what(),
                    (layout.folder / "layout.glsl").string(), kHint);
    }
    std::erase_if(declared, [](const gpu::Resource& r) { return r.binding < kFirstBinding || r.binding >= kEndBinding; });
    const auto named = [](const std::string& name) { return [&name](const gpu::Resource& r) { return r.name == name; }; };
    const std::vector<gpu::Resource> expected = promised(layout, stage.starts_with("raster/"));
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
    for (const gpu::Resource& d : declared) {
        if (std::none_of(expected.begin(), expected.end(), named(d.name)))
            throw Error(ErrorKind::input, "no buffer for '" + d.name + "', which layout.glsl declares for " + stage, where,
                        kHint);
    }
}

}  // namespace

std::vector<uint32_t> compile_stage(const std::string& stage, const Layout& layout, bool storage_reads) {
    std::vector<uint32_t> words = compile(stage, layout, storage_reads);
    check_buffers(words, stage, layout, storage_reads);
    return words;
}

}  // namespace gnomon
