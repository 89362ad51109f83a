// SPDX-License-Identifier: Apache-2.0
// Layouts from a folder: compiled at run time they give the bits of the built-in ones, and what is wrong with one is said with
// its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <gnomon/error.hpp>
#include <gnomon/render.hpp>
#include <thread>

#include "layouts/child_process.hpp"
#include "layouts/layout.hpp"
#include "methods/method.hpp"
#include "support/paths.hpp"
#include "support/two_cubes.hpp"
#include "unit/gpu/gpu_test.hpp"
#include "unit/io/test_folder.hpp"
#include "unit/io/throws.hpp"

namespace gnomon::test {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("the layout has no '" + from + "'");
    return text.replace(at, from.size(), to);
}

class ExternalLayoutTest : public TwoCubes<TestFolder> {
protected:
    ExternalLayoutTest() : TwoCubes(48, 48, 4) {
        settings.shadow_res = 128;
        settings.count_ranges = true;
        settings.layout = folder.string();
    }

    /// A copy of a built-in layout becomes the folder's, under the name "own".
    void copy_layout(const std::string& name) const {
        const auto source = std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "comp_shaders" / "layouts" / name;
        put_content(folder / "layout.glsl", content_of(source / "layout.glsl"));
        put_content(folder / "layout.json",
                    replaced(content_of(source / "layout.json"), "\"name\": \"" + name + "\"", "\"name\": \"own\""));
    }

    void edit(const std::string& file, const std::string& from, const std::string& to) const {
        put_content(folder / file, replaced(content_of(folder / file), from, to));
    }

    Frame render(const std::string& layout) {
        settings.layout = layout;
        return validated_renderer().render(scene, poses, settings);
    }
    Frame render() { return render(folder.string()); }

    static void expect_same_frame(const Frame& frame, const Frame& expected) {
        expect_same_bits(frame, expected);
        EXPECT_EQ(frame.stats.counts.at("ranges.0"), expected.stats.counts.at("ranges.0"));
    }

    /// Rendering fails with an input error that names all of these.
    void expect_input_error(const std::vector<std::string>& parts) {
        const std::optional<Error> error = error_of([&] { render(); });
        ASSERT_TRUE(error.has_value()) << "no error";
        EXPECT_EQ(error->kind(), ErrorKind::input);
        for (const std::string& part : parts) EXPECT_THAT(error->what(), testing::HasSubstr(part));
        EXPECT_THAT(error->what(), testing::Not(testing::HasSubstr("\n")));
    }

    std::string path(const std::string& file) const { return (std::filesystem::canonical(folder) / file).string(); }
};

TEST_F(ExternalLayoutTest, GivesTheBitsOfTheSameLayoutBuiltIn) {
    for (const Method& method : methods()) {
        if (!method.has_s_buffer()) continue;
        settings.method = method.name;
        for (const std::string layout : {"array", "linked", "jagged"}) {
            SCOPED_TRACE(method.name + ", " + layout);
            copy_layout(layout);
            const Frame frame = render();
            EXPECT_EQ(frame.effective.at("layout"), "own");
            expect_same_frame(frame, render(layout));
        }
    }
}

// One table for all lists: a buffer with a length, which any list may write, by compare and exchange. Not built in: its probes,
// a loop in each layout_emit, are too many for lists of thousands of ranges.
TEST_F(ExternalLayoutTest, MayHaveATable) {
    for (const char* method : {"exact", "dtr-analytic"}) {
        settings.method = method;
        const Frame expected = render("array");
        expect_same_frame(render(std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/tests/layouts/hash"), expected);
        settings.memory_budget = 8u << 20;
        expect_same_bits(render(std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/tests/layouts/hash"), expected);
        settings.memory_budget = 0;
    }
}

// All bits of a range in pieces of 8 and 16.
constexpr const char* kSmallManifest = R"({
    "name": "own",
    "sizes": [{ "name": "ranges", "as": "offsets" }],
    "buffers": [
        { "name": "enters", "type": "u16vec2", "per": "ranges" },
        { "name": "leaving", "type": "u8vec4", "per": "ranges" },
        { "name": "depths", "type": "u16vec4", "per": "ranges" },
        { "name": "lows", "type": "uint16", "per": "ranges" },
        { "name": "thirds", "type": "uint8", "per": "ranges" },
        { "name": "highs", "type": "u8vec2", "per": "ranges", "initial": 7 }
    ]
})";
constexpr const char* kSmallElements = R"(
uvec2 halves(float x) { return uvec2(floatBitsToUint(x) & 0xffffu, floatBitsToUint(x) >> 16u); }
float whole(uvec2 h) { return uintBitsToFloat(h.x | h.y << 16u); }

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    uint leave = floatBitsToUint(range.leave);
    set_enters(cursor, halves(range.enter));
    set_leaving(cursor, uvec4(leave, leave >> 8u, leave >> 16u, leave >> 24u));  // What does not fit is cut off.
    set_depths(cursor, uvec4(halves(range.depth), halves(range.exit_depth)));
    set_lows(cursor, range.entry);
    set_thirds(cursor, range.entry >> 16u);
    set_highs(cursor, uvec2(range.entry >> 24u, fetch_highs(cursor).y));
    ++cursor;
}
void layout_close(List list, uint cursor) {}

Iterator layout_begin(List list, Query query) { return Iterator(first_ranges(list), end_ranges(list)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    uvec4 leave = fetch_leaving(it.x), depths = fetch_depths(it.x);
    uvec2 high = fetch_highs(it.x);
    uint entry = high.y == 7u ? fetch_lows(it.x) | fetch_thirds(it.x) << 16u | high.x << 24u : kNone;
    Range range = Range(whole(fetch_enters(it.x)), uintBitsToFloat(leave.x | leave.y << 8u | leave.z << 16u | leave.w << 24u),
                        whole(depths.xy), entry, whole(depths.zw));
    ++it.x;
    return range;
}
)";

TEST_F(ExternalLayoutTest, MayHaveSmallElements) {
    for (const char* method : {"exact", "dtr-analytic"}) {
        SCOPED_TRACE(method);
        settings.method = method;
        const Frame expected = render("array");
        put_content(folder / "layout.json", kSmallManifest);
        put_content(folder / "layout.glsl", kSmallElements);
        const Frame frame = render();
        expect_same_frame(frame, expected);
        EXPECT_EQ(frame.stats.buffer_bytes.at("s_buffer.thirds"), expected.stats.counts.at("ranges.0"));
        // Of a device without texel buffers of enough elements.
        const gpu::ScopedVariable limits("GNOMON_LIMITS", "texel_reads=0");
        expect_same_frame(Renderer("", true).render(scene, poses, settings), expected);
    }
}

TEST_F(ExternalLayoutTest, ALocalVariableMayHaveABuffersName) {
    settings.count_accesses = 1;
    copy_layout("linked");
    const LayoutAccesses expected = render().layout_accesses.value();
    ASSERT_GT(expected.longest_chain, 3u);
    edit("layout.glsl", "it = fetch_links(it);", "uint links = fetch_links(it);\n    it = links;");
    EXPECT_EQ(render().layout_accesses->longest_chain, expected.longest_chain);
}

TEST_F(ExternalLayoutTest, NamesOfTheStagesAreNotFree) {
    copy_layout("array");
    edit("layout.json", "\"buffers\": [", "\"buffers\": [{ \"name\": \"leaves\", \"type\": \"uint\", \"per\": \"list\" },");
    expect_input_error({"the name 'leaves' is one of the stages' own", path("layout.json"), "another name"});
}

TEST_F(ExternalLayoutTest, SmallElementsAreRefusedByDevicesWithoutThem) {
    put_content(folder / "layout.json", kSmallManifest);
    put_content(folder / "layout.glsl", kSmallElements);
    for (const auto& [limit, text] : {std::pair("storage_8bit=0", "elements of 8 bits in its buffer 'leaving'"),
                                      std::pair("storage_16bit=0", "elements of 16 bits in its buffer 'enters'")}) {
        const gpu::ScopedVariable limits("GNOMON_LIMITS", limit);
        Renderer renderer("", true);
        EXPECT_GNOMON_ERROR(renderer.render(scene, poses, settings), ErrorKind::usage, text);
    }
}

TEST_F(ExternalLayoutTest, IsReadAnewForEachFrame) {
    copy_layout("array");
    const Frame expected = render();
    ASSERT_GT(expected.stats.counts.at("ranges_tested"), 0u);
    edit("layout.glsl", "return it.x < it.y;", "return false;");
    EXPECT_EQ(render().stats.counts.at("ranges_visited"), 0u);
    edit("layout.glsl", "return false;", "return it.x < it.y;");
    expect_same_frame(render(), expected);
}

TEST_F(ExternalLayoutTest, AccessesAndWalksAreChecked) {
    settings.check_layout = true;
    copy_layout("array");
    EXPECT_TRUE(render().layout_faults.empty());
    EXPECT_TRUE(render("linked").layout_faults.empty());

    edit("layout.glsl", "fetch_range(it.x)", "fetch_range(it.x + 100000000u)");
    const Frame beyond = render();
    ASSERT_EQ(beyond.layout_faults.size(), 1u);
    EXPECT_EQ(beyond.layout_faults[0].buffer, "ranges");
    EXPECT_GT(beyond.layout_faults[0].count, 0u);
    EXPECT_GE(beyond.layout_faults[0].element, 100'000'000u);

    copy_layout("array");
    edit("layout.glsl", "{ return first_ranges(list); }", "{ return first_ranges(list) + 1u; }");
    const Frame behind = render();
    ASSERT_EQ(behind.layout_faults.size(), 1u);
    EXPECT_EQ(behind.layout_faults[0].buffer, "ranges");

    copy_layout("array");
    edit("layout.glsl", "    ++it.x;\n", "");
    const Frame endless = render();
    ASSERT_EQ(endless.layout_faults.size(), 1u);
    EXPECT_EQ(endless.layout_faults[0].buffer, "");
    EXPECT_GT(endless.layout_faults[0].count, 0u);
    settings.keep_ranges = true;
    EXPECT_TRUE(render().light_ranges.empty());
}

TEST_F(ExternalLayoutTest, DoesNotTakeThePlaceOfOneBuiltIn) {
    const Frame expected = render("array");
    copy_layout("array");
    edit("layout.json", "\"own\"", "\"array\"");
    edit("layout.glsl", "return it.x < it.y;", "return false;");
    EXPECT_EQ(render().stats.counts.at("ranges_visited"), 0u);
    expect_same_frame(render("array"), expected);
}

TEST_F(ExternalLayoutTest, MayBeInSeveralFiles) {
    copy_layout("array");
    std::filesystem::create_directory(folder / "parts");
    put_content(folder / "parts" / "all.glsl", "#include \"more.glsl\"\n");
    put_content(folder / "parts" / "more.glsl", content_of(folder / "layout.glsl"));
    put_content(folder / "layout.glsl", "#include \"parts/all.glsl\"\n");
    expect_same_frame(render(), render("array"));

    edit("parts/more.glsl", "return it.x < it.y;", "return it.x < it.q;");
    expect_input_error({"layout does not compile", path("parts/more.glsl:"), "'q'"});
}

TEST_F(ExternalLayoutTest, NamesFileAndLineOfASyntaxError) {
    copy_layout("linked");
    put_content(folder / "layout.glsl", "\n\n#ifdef LAYOUT_READ\nuint x = ;\n#endif\n" + content_of(folder / "layout.glsl"));
    expect_input_error({"layout does not compile", "syntax error", path("layout.glsl:4"), "docs/layouts.md"});
}

TEST_F(ExternalLayoutTest, NamesAMissingFunction) {
    for (const std::string name :
         {"layout_open", "layout_emit", "layout_close", "layout_begin", "layout_more", "layout_next"}) {
        copy_layout("array");
        edit("layout.glsl", " " + name + "(", " other(");
        expect_input_error({"layout does not compile", "'" + name + "'", path("layout.glsl"), "docs/layouts.md"});
    }
    // Declared only.
    copy_layout("array");
    edit("layout.glsl", "bool layout_more(Iterator it) { return it.x < it.y; }", "bool layout_more(Iterator it);");
    expect_input_error({"layout does not compile", "layout_more", path("layout.glsl")});
}

TEST_F(ExternalLayoutTest, NamesAMissingFile) {
    expect_input_error({"missing", path("layout.json"), "layout.glsl and layout.json"});
    copy_layout("array");
    std::filesystem::remove(folder / "layout.glsl");
    expect_input_error({"missing", path("layout.glsl")});
    std::filesystem::create_directory(folder / "layout.glsl");
    expect_input_error({"missing", path("layout.glsl")});
    EXPECT_GNOMON_ERROR(render("no/such/folder"), ErrorKind::input, "no/such/folder/layout.json");
    EXPECT_GNOMON_ERROR(render("no-such-layout"), ErrorKind::usage, "or a folder with layout.glsl and layout.json");
}

TEST_F(ExternalLayoutTest, NamesWhatIsWrongInTheManifest) {
    copy_layout("array");
    edit("layout.json", "\"buffers\": [", "\"buffers\": ");
    expect_input_error({"not valid JSON", path("layout.json")});
    copy_layout("array");
    edit("layout.json", "\"buffers\": [", "\"buffers\": [" + std::string(80'000, '[') + std::string(80'000, ']') + ", ");
    expect_input_error({"nested more than 64 deep", path("layout.json")});
    copy_layout("array");
    edit("layout.json", "\"buffers\"", "\"Buffers\"");
    expect_input_error({"'buffers' is missing", path("layout.json:1")});
    copy_layout("array");
    edit("layout.json", "vec4", "vec3");
    expect_input_error({"'buffers/0/type' is 'vec3'", "float, u16vec2, u16vec4, u8vec2", path("layout.json:6")});
}

TEST_F(ExternalLayoutTest, SaysWhichMemberOfTheManifestCannotBe) {
    const std::string initial = "is not an integer from 0 to 4294967295", of_float = "is not a number that a 32-bit float";
    const struct {
        const char *from, *to;
        std::string what, place;
    } cases[] = {
        {"\"sizes\"", "\"size\"", "'size' is not known", "layout.json:4"},
        {"\"sizes\"", "\"lossless\": 1, \"sizes\"", "'lossless' is neither true nor false", "layout.json:4"},
        {"\"as\": \"offsets\"", "\"as\": \"offset\"", "'sizes/0/as' is 'offset'", "layout.json:4"},
        {"\"as\": \"offsets\"", "\"As\": \"offsets\"", "'sizes/0/as' is missing", "layout.json:4"},
        {"\"as\": \"offsets\"", "\"as\": \"values\"", "'buffers/0/per' is 'ranges', which have no places", "layout.json:6"},
        {"\"as\": \"offsets\"", "\"per\": \"tile\", \"as\": \"offsets\"", "'sizes/0/per' of the ranges is not 'list'",
         "layout.json:4"},
        {"{ \"name\": \"ranges\", \"as\": \"offsets\" }",
         R"({ "name": "ranges", "as": "offsets" }, { "name": "ranges", "as": "total" })",
         "'sizes/1/name' is 'ranges', as another's", "layout.json:4"},
        {"\"name\": \"exits\"", "\"name\": \"ranges\"", "'buffers/1/name' is 'ranges', as another's", "layout.json:7"},
        {"\"name\": \"exits\"", "\"name\": \"2x\"", "'buffers/1/name' is not a name", "layout.json:7"},
        {"\"name\": \"exits\"", "\"name\": \"a;b\"", "'buffers/1/name' is not a name", "layout.json:7"},
        {"\"per\": \"ranges\", \"when\"", "\"when\"", "has both 'per' and 'length', or neither", "layout.json:7"},
        {"\"per\": \"ranges\", \"when\"", "\"per\": \"pages\", \"when\"", "'buffers/1/per' is 'pages'", "layout.json:7"},
        {"\"per\": \"ranges\", \"when\"", "\"length\": \"2 * pages\", \"when\"",
         "'buffers/1/length' names 'pages', which there is not", "layout.json:7"},
        {"\"per\": \"ranges\", \"when\"", "\"length\": \"2 * (ranges\", \"when\"",
         "'buffers/1/length' is not an expression: the end at character 12", "layout.json:7"},
        {"\"when\"", "\"elements\": 0, \"when\"", "'buffers/1/elements' is not from 1", "layout.json:7"},
        {"\"when\"", "\"initial\": true, \"when\"", of_float, "layout.json:7"},
        {"\"when\"", "\"initial\": 1e39, \"when\"", of_float, "layout.json:7"},
        {"\"when\"", "\"initial\": \"none\", \"when\"", of_float, "layout.json:7"},
        {"\"float\"", "\"uint\", \"initial\": -1", initial, "layout.json:7"},
        {"\"float\"", "\"uint\", \"initial\": 0.5", initial, "layout.json:7"},
        {"\"float\"", "\"uint\", \"initial\": 4294967296", initial, "layout.json:7"},
        {"\"sizes\"", "\"constants\": { \"K\": -1 }, \"sizes\"", "'constants/K' is not an integer", "layout.json:4"},
        {"\"sizes\"", "\"counters\": [\"found\"], \"sizes\"", "'counters' holds what is not 'lost'", "layout.json:4"},
        {"\"sizes\"", "\"finish\": \"texel\", \"sizes\"", "'finish' is 'texel'", "layout.json:4"},
        {"\"sizes\"", "\"iterator\": \"vec2\", \"sizes\"", "'iterator' is 'vec2'", "layout.json:4"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.to);
        copy_layout("array");
        edit("layout.json", c.from, c.to);
        expect_input_error({c.what, path(c.place)});
    }
}

TEST_F(ExternalLayoutTest, BindsOnlyWhatItsManifestNames) {
    copy_layout("array-soa");
    edit("layout.json", "\"name\": \"times\", \"type\"", "\"name\": \"stays\", \"type\"");
    expect_input_error({"layout does not compile", "set_times", path("layout.glsl:")});
    copy_layout("array-soa");
    edit("layout.json", "\"vec2\"", "\"uvec2\"");
    expect_input_error({"layout does not compile", "set_times", path("layout.glsl:")});
    const std::string own = "layout(binding = 39, scalar) buffer Own { uint own[]; };\n";
    copy_layout("array");
    put_content(folder / "layout.glsl", own + content_of(folder / "layout.glsl"));
    expect_input_error({"declares 'Own'", path("layout.glsl")});
    copy_layout("array");
    put_content(folder / "layout.glsl", replaced(own, "binding", "set = 1, binding") + content_of(folder / "layout.glsl"));
    expect_input_error({"not what a layout may declare", path("layout.glsl")});
}

// What the driver could not take, or the compiler: an error, and not a crash.
TEST_F(ExternalLayoutTest, HostileCode) {
    const auto before = [&](const std::string& text) {
        copy_layout("array");
        put_content(folder / "layout.glsl", text + content_of(folder / "layout.glsl"));
    };
    const auto in_more = [&](const std::string& statement) {
        edit("layout.glsl", "{ return it.x < it.y; }", "{ " + statement + " return it.x < it.y; }");
    };
    before(
        "#extension GL_EXT_buffer_reference_uvec2 : require\nlayout(buffer_reference, scalar) buffer Wild { uint word; };\n");
    in_more("if (Wild(uvec2(it.x, 0u)).word == 7u) return true;");
    expect_input_error({"SPIR-V capability", "PhysicalStorageBufferAddresses", path("layout.glsl")});

    before("");
    in_more("double d = double(it.x); if (d * d > 1.0e9LF) return true;");
    expect_input_error({"SPIR-V capability Float64", path("layout.glsl")});

    before("#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require\n");
    in_more("if (uint64_t(it.x) * uint64_t(it.y) > 0xffffffffffffUL) return true;");
    expect_input_error({"SPIR-V capability Int64", path("layout.glsl")});

    before("");
    in_more("uint large[2000000]; large[it.x] = it.y; if (large[it.y] == 7u) return true;");
    expect_input_error({"local variables take 800", "more than 16384", path("layout.glsl")});

    before("");
    std::string sum = "1u";
    for (int i = 0; i < 200'000; ++i) sum += " + it.x";
    in_more("if (" + sum + " == 7u) return true;");
    expect_input_error({"the compiler crashed", path("layout.glsl")});

    std::string laughs = "#define L0 it.x\n";
    for (int i = 1; i < 32; ++i) {
        const std::string before_it = "L" + std::to_string(i - 1);
        laughs += "#define L" + std::to_string(i) + " " + before_it + " + " + before_it + "\n";
    }
    before(laughs);
    in_more("if (L31 == 7u) return true;");
    expect_input_error({"the compiler ", path("layout.glsl")});
}

TEST_F(ExternalLayoutTest, IncludesAreBounded) {
    copy_layout("array");
    const std::string layout = content_of(folder / "layout.glsl");
    // Each file includes the next one twice.
    for (int i = 0; i < 30; ++i) {
        const std::string next = "#include \"" + std::to_string(i + 1) + "\"\n";
        put_content(folder / std::to_string(i), next + next);
    }
    put_content(folder / "30", "");
    put_content(folder / "layout.glsl", "#include \"0\"\n" + layout);
    expect_input_error({"includes are too many or too long", path("")});

    put_content(folder / "layout.glsl", "#include \"long\"\n" + layout);
    put_content(folder / "long", std::string(5 << 20, '\n'));
    expect_input_error({"includes are too many or too long", path("layout.glsl:1")});
}

TEST_F(ExternalLayoutTest, LinksStayInTheFolder) {
    copy_layout("array");
    const std::string layout = content_of(folder / "layout.glsl");
    std::filesystem::create_symlink(std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "README.md", folder / "link");
    put_content(folder / "layout.glsl", "#include \"link\"\n" + layout);
    expect_input_error({"no links out of it", path("layout.glsl:1")});
    std::filesystem::remove(folder / "link");
    put_content(folder / "inside", "");
    std::filesystem::create_symlink("inside", folder / "link");
    expect_same_frame(render(), render("array"));
}

TEST_F(ExternalLayoutTest, IncludesOnlyFilesOfItsFolder) {
    const auto with_include = [&](const std::string& directive) {
        copy_layout("array");
        put_content(folder / "layout.glsl", "\n#include " + directive + "\n" + content_of(folder / "layout.glsl"));
    };
    put_content(folder / "x", "");
    const std::string absolute = path("x");
    for (const std::string& name : {std::string("../x"), std::string("parts/../x"), absolute}) {
        with_include('"' + name + '"');
        expect_input_error({"layout does not compile", "only files of its own folder", path("layout.glsl:2")});
        with_include('<' + name + '>');
        expect_input_error({"layout does not compile", "only files of its own folder", path("layout.glsl:2")});
    }
    for (const std::string directive : {"\"y\"", "<math/cover.h>"}) {
        with_include(directive);
        expect_input_error({"layout does not compile", "no such file", path("layout.glsl:2")});
    }
    with_include("\"layout.glsl\"");
    expect_input_error({"layout does not compile", "nested too deeply", path("layout.glsl")});
}

TEST(RunInChild, WhatAChildMayTake) {
    std::string reason;
    EXPECT_EQ(run_in_child([] { return std::string("a\0b", 3); }, {}, reason), std::string("a\0b", 3));
    EXPECT_EQ(run_in_child([] { return std::string(1 << 20, 'x'); }, {}, reason).size(), 1u << 20);
    EXPECT_EQ(reason, "");
    const auto reason_of = [&](const std::function<std::string()>& work, const ChildLimits& limits) {
        EXPECT_EQ(run_in_child(work, limits, reason), "");
        return reason;
    };
    using std::chrono::seconds;
    EXPECT_EQ(reason_of([]() -> std::string { std::abort(); }, {}), "crashed (signal 6)");
    EXPECT_EQ(reason_of([]() -> std::string { throw 1; }, {}), "failed");
    EXPECT_EQ(reason_of([] { return std::string(100, 'x'); }, {.output_bytes = 99}), "made more than 0 MiB");
    EXPECT_EQ(reason_of(
                  [] {
                      for (std::atomic<uint64_t> i = 0;;) ++i;
                      return std::string();
                  },
                  {.seconds = seconds(1)}),
              "took more than 1 s");
    EXPECT_EQ(reason_of(
                  [] {
                      std::this_thread::sleep_for(seconds(60));
                      return std::string();
                  },
                  {.seconds = seconds(1)}),
              "took more than 1 s");
    EXPECT_EQ(reason_of(
                  [] {
                      std::vector<std::string> all;
                      for (;;) all.emplace_back(1 << 20, 'x');
                      return std::string();
                  },
                  {.more_bytes = 64 << 20}),
              "took more than 64 MiB");
}

}  // namespace
}  // namespace gnomon::test
