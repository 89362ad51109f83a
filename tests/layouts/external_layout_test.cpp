// SPDX-License-Identifier: Apache-2.0
// Layouts from a folder: compiled at run time they give the bits of the built-in ones, and what is wrong with one is said with
// its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/error.hpp>
#include <gnomon/render.hpp>

#include "layouts/layout.hpp"
#include "methods/method.hpp"
#include "support/paths.hpp"
#include "support/two_cubes.hpp"
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
        for (const std::string& layout : layout_names()) {
            SCOPED_TRACE(method.name + ", " + layout);
            copy_layout(layout);
            const Frame frame = render();
            EXPECT_EQ(frame.effective.at("layout"), "own");
            expect_same_frame(frame, render(layout));
        }
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
    expect_input_error({"layout does not compile", "syntax error", path("layout.glsl:4"), "CONTRIBUTING.md"});
}

TEST_F(ExternalLayoutTest, NamesAMissingFunction) {
    for (const std::string name : {"layout_count", "layout_cursor", "layout_begin", "layout_more", "layout_next"}) {
        copy_layout("array");
        edit("layout.glsl", " " + name + "(", " other(");
        expect_input_error({"layout does not compile", "'" + name + "'", path("layout.glsl"), "CONTRIBUTING.md, A new layout"});
    }
    // Declared only.
    copy_layout("array");
    edit("layout.glsl", "bool layout_more(ListIterator it) { return it.x < it.y; }", "bool layout_more(ListIterator it);");
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
    expect_input_error({"not a layout's manifest", path("layout.json")});
    copy_layout("array");
    edit("layout.json", "rgba32_float", "rgb8");
    expect_input_error({"'format' is 'rgb8'", path("layout.json")});
}

TEST_F(ExternalLayoutTest, MustDeclareTheBuffersOfItsManifest) {
    copy_layout("array");
    edit("layout.json", "\"Ranges\"", "\"Stays\"");
    expect_input_error({"declares no 'Stays'", "raster/conservative", path("layout.json")});
    copy_layout("array");
    edit("layout.json", "\"texel\": \"ranges\", ", "");
    expect_input_error({"no buffer for 'ranges'", "sample/shadow", path("layout.json")});
    copy_layout("array");
    edit("layout.json", "rgba32_float", "rgba32_uint");
    expect_input_error({"'ranges' is of another kind or format", path("layout.json")});
    copy_layout("array");
    edit("layout.glsl", "binding = 17", "set = 1, binding = 17");
    expect_input_error({"not what a layout may declare", path("layout.glsl")});
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

}  // namespace
}  // namespace gnomon::test
