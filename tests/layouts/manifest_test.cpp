// SPDX-License-Identifier: Apache-2.0
// What a layout's manifest says, and the GLSL that it stands for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "layouts/interface.hpp"
#include "unit/io/throws.hpp"

namespace gnomon::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

uint64_t value_of(const std::string& text) {
    return Length(text).value([](const std::string& name) -> uint64_t { return name == "lists" ? 100 : name == "k" ? 3 : 7; });
}

TEST(LengthTest, Values) {
    EXPECT_EQ(value_of("12"), 12u);
    EXPECT_EQ(value_of("2 * lists + 3"), 203u);
    EXPECT_EQ(value_of("3 + 2 * lists"), 203u);
    EXPECT_EQ(value_of("(3 + 2) * lists"), 500u);
    EXPECT_EQ(value_of("lists - k - 7"), 90u);
    EXPECT_EQ(value_of("lists / k / 4"), 8u);
    EXPECT_EQ(value_of("max(lists, k) + min(lists, k * 5)"), 115u);
    EXPECT_EQ(value_of("ranges"), 7u);
    EXPECT_EQ(value_of("  k*k "), 9u);
}

TEST(LengthTest, Limits) {
    constexpr uint64_t kMost = std::numeric_limits<uint64_t>::max();
    EXPECT_EQ(value_of("k - lists"), 0u);
    EXPECT_EQ(value_of("lists / (k - 3)"), 0u);
    EXPECT_EQ(value_of("18446744073709551615 + lists"), kMost);
    EXPECT_EQ(value_of("18446744073709551615 * lists"), kMost);
    EXPECT_EQ(value_of("18446744073709551615 * 0"), 0u);
}

TEST(LengthTest, Names) { EXPECT_THAT(Length("a + b * max(a, c2)").names(), ElementsAre("a", "b", "c2")); }

TEST(LengthTest, Errors) {
    const auto reason = [](const std::string& text) -> std::string {
        try {
            Length length(text);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(reason(""), "the end at character 1 stands where a number or a name is expected");
    EXPECT_EQ(reason("2 * "), "the end at character 5 stands where a number or a name is expected");
    EXPECT_EQ(reason("2 lists"), "'l' at character 3 is not expected");
    EXPECT_EQ(reason("(2"), "the end at character 3 stands where ')' is expected");
    EXPECT_EQ(reason("max(2)"), "')' at character 6 stands where ',' is expected");
    EXPECT_EQ(reason("a.b"), "'.' at character 2 is not expected");
    EXPECT_THAT(reason("18446744073709551616"), HasSubstr("too large"));
    EXPECT_THAT(reason(std::string(100'000, '(')), HasSubstr("nested too deeply"));
    EXPECT_THAT(reason("-1"), HasSubstr("'-' at character 1"));
}

constexpr const char* kManifest = R"({
    "name": "all", "iterator": "uvec4", "texels": "morton", "constants": { "PAGE": 4 }, "counters": ["lost"], "prepare": "tile",
    "sizes": [
        { "name": "ranges", "as": "offsets" },
        { "name": "pages", "as": "allocated" },
        { "name": "longest", "per": "tile", "as": "values" }
    ],
    "buffers": [
        { "name": "heads", "type": "uint", "per": "list", "initial": "none" },
        { "name": "nodes", "type": "vec4", "per": "pages", "elements": "PAGE" },
        { "name": "table", "type": "uvec2", "length": "2 * ranges + PAGE" },
        { "name": "exits", "type": "float", "per": "ranges", "when": "exit", "initial": 0.5 }
    ]
})";

TEST(ManifestTest, SaysWhatThereIs) {
    const Layout layout = parse_layout(kManifest, "layout.json");
    EXPECT_EQ(layout.sizes.size(), 3u);
    EXPECT_EQ(layout.sizes[0].as, LayoutSize::As::offsets);
    EXPECT_EQ(layout.sizes[2].per, LayoutSize::Per::tile);
    EXPECT_EQ(layout.sizes[2].line, 6u);
    EXPECT_TRUE(layout.keeps_counts());
    EXPECT_TRUE(layout.counts_up());
    EXPECT_EQ(layout.prepare, Layout::Pass::tile);
    EXPECT_EQ(layout.finish, Layout::Pass::none);
    ASSERT_EQ(layout.buffers.size(), 4u);
    EXPECT_EQ(layout.buffers[0].initial, 0xffffffffu);
    EXPECT_EQ(layout.buffers[1].elements, 4u);
    EXPECT_EQ(layout.buffers[1].size, 1u);
    EXPECT_EQ(layout.buffers[2].per, LayoutBuffer::Per::band);
    EXPECT_EQ(layout.buffers[3].initial, 0x3f000000u);
    EXPECT_FALSE(layout.has(layout.buffers[3]));
}

TEST(ManifestTest, OnlyRangesHaveASizeWhereNoneIsNamed) {
    const Layout layout = parse_layout(R"({ "name": "null", "buffers": [] })", "layout.json");
    ASSERT_EQ(layout.sizes.size(), 1u);
    EXPECT_EQ(layout.sizes[0].name, "ranges");
    EXPECT_FALSE(layout.keeps_counts());
    EXPECT_FALSE(layout.counts_up());
}

TEST(ManifestTest, ElementsMayBeSmall) {
    const auto layout = [](const std::string& buffer) {
        return parse_layout(R"({ "name": "small", "buffers": [{ "name": "b", "per": "list", )" + buffer + "}] }",
                            "layout.json");
    };
    const LayoutBuffer pair = layout(R"("type": "u8vec2", "initial": 18)").buffers[0];
    EXPECT_EQ(pair.type, "uvec2");
    EXPECT_EQ(pair.element_bytes, 2u);
    EXPECT_EQ(component_bits(pair), 8u);
    EXPECT_EQ(pair.initial, 0x12121212u);
    const LayoutBuffer four = layout(R"("type": "u16vec4", "initial": 513)").buffers[0];
    EXPECT_EQ(four.element_bytes, 8u);
    EXPECT_EQ(component_bits(four), 16u);
    EXPECT_EQ(four.initial, 0x02010201u);
    EXPECT_EQ(component_bits(layout(R"("type": "vec4")").buffers[0]), 32u);
    EXPECT_EQ(layout(R"("type": "uint8", "initial": "none")").buffers[0].initial, 0xffffffffu);
    EXPECT_GNOMON_ERROR(layout(R"("type": "uint8", "initial": 256)"), ErrorKind::input,
                        "'buffers/0/initial' is more than 8 bits hold");
    EXPECT_GNOMON_ERROR(layout(R"("type": "u16vec2", "initial": 65536)"), ErrorKind::input, "is more than 16 bits hold");

    const std::string text = layout_interface(layout(R"("type": "u16vec2")"));
    EXPECT_THAT(text, HasSubstr("GL_EXT_shader_16bit_storage"));
    EXPECT_THAT(text, Not(HasSubstr("GL_EXT_shader_8bit_storage")));
    EXPECT_THAT(text, HasSubstr("void set_b(uint i, uvec2 value)"));
    EXPECT_THAT(text, Not(HasSubstr("add_b")));
}

// They are listed, not computed: no counts of lists are needed for them.
TEST(ManifestTest, TrianglesAreOfTiles) {
    constexpr const char* kShared = R"({ "name": "shared", "sizes": [{ "name": "triangles", "as": "offsets" }],
        "buffers": [{ "name": "listed", "type": "uvec2", "per": "triangles" }] })";
    const Layout layout = parse_layout(kShared, "layout.json");
    ASSERT_EQ(layout.sizes.size(), 2u);
    EXPECT_TRUE(layout.sizes[1].listed);
    EXPECT_EQ(layout.sizes[1].per, LayoutSize::Per::tile);
    EXPECT_TRUE(layout.lists_triangles());
    EXPECT_FALSE(layout.keeps_counts());
    EXPECT_FALSE(parse_layout(kManifest, "layout.json").lists_triangles());
    const std::string text = layout_interface(layout);
    EXPECT_THAT(text, HasSubstr("uint first_triangles(Tile of)"));
    EXPECT_THAT(text, HasSubstr("#define LAYOUT_TILE_SIZES\n"));
    EXPECT_GNOMON_ERROR(parse_layout(R"({ "name": "a", "buffers": [],
        "sizes": [{ "name": "triangles", "per": "list", "as": "values" }] })",
                                     "layout.json"),
                        ErrorKind::input, "of the triangles is not 'tile'");
}

TEST(InterfaceTest, Accessors) {
    const std::string text = layout_interface(parse_layout(kManifest, "layout.json"));
    for (const char* part : {"#define Iterator uvec4\n",
                             "#define LAYOUT_COUNTS\n",
                             "#define LAYOUT_MORTON\n",
                             "#define LAYOUT_PREPARES_TILES 1\n",
                             "#define LAYOUT_FINISHES_TILES 0\n",
                             "const uint PAGE = 4u;\n",
                             "uint first_ranges(List of)",
                             "uint end_ranges(List of)",
                             "uint allocate_pages(uint n)",
                             "uint size_longest(Tile of)",
                             "void count_lost(uint n)",
                             "buffer Written_heads { uint heads_elements[]; }",
                             "heads_elements[i - part_first_tile() * kTileTexels]",
                             "nodes_elements[i - params.place_first[1] * 4u]",
                             "table_elements[i - 0u]",
                             "uint exchange_heads(uint i, uint value)",
                             "uint length_table() { return READ_COUNT(table); }",
                             "READ_VEC4(25, nodes)",
                             "defined(LAYOUT_WRITE) && defined(GN_RANGE_EXIT)",
                             "#define LAYOUT_LIST_SIZES VISIT(pages, 1u)\n",
                             "#define LAYOUT_TILE_SIZES VISIT(longest, 2u)\n"})
        EXPECT_THAT(text, HasSubstr(part));
    EXPECT_THAT(text, Not(HasSubstr("@")));
    EXPECT_THAT(text, Not(HasSubstr("exchange_nodes")));
}

}  // namespace
}  // namespace gnomon::test
