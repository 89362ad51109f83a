// SPDX-License-Identifier: Apache-2.0
// `gnomon layouts`, and a layout of one's own from there to the picture.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class CliLayoutsTest : public TestFolder {
protected:
    CommandResult layouts(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "layouts");
        return run_gnomon(folder, arguments);
    }

    CommandResult render(const std::string& layout, const std::string& output, const std::string& method = "exact") {
        const std::string path = std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/scenes/two-cubes.gltf";
        return run_gnomon(folder, {"render", path, "-o", output, "--size=32x24", "--spp=4", "--shadow-res=128", "--method",
                                   method, "--layout", layout, "--json", output + ".json"});
    }
};

TEST_F(CliLayoutsTest, Lists) {
    const CommandResult text = layouts({});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("\npaged\n"));
    std::map<std::string, json> by_name;
    const json document = json::parse(layouts({"--json", "-"}).out);
    for (const json& layout : document["layouts"]) by_name[layout["name"]] = layout;
    EXPECT_EQ(by_name.at("array")["bytes"], "16 ranges + 8 lists");
    EXPECT_EQ(by_name.at("array")["bytes_with_exit"], "20 ranges + 8 lists");
    EXPECT_EQ(by_name.at("array")["passes"], json({"count", "scan", "fill"}));
    EXPECT_EQ(by_name.at("linked")["bytes"], "4 lists + 20 ranges");
    EXPECT_EQ(by_name.at("sorted-time")["passes"], json({"count", "scan", "fill", "finish"}));
    EXPECT_EQ(by_name.at("array-counter")["passes"], json({"count", "size", "prepare", "fill"}));
    EXPECT_EQ(by_name.at("paged")["bytes"], "12 lists + 68 pages");
    EXPECT_EQ(by_name.at("jagged")["bytes"], "1024 slots + 8 lists + 8 tiles");
    EXPECT_EQ(by_name.at("bits")["bytes"], "40 triangles + 8 tiles");
    EXPECT_EQ(by_name.at("null")["bytes"], "0");
    EXPECT_EQ(by_name.at("no-depth")["methods"], json({"exact"}));
    EXPECT_FALSE(by_name.at("fixed")["lossless"]);
    EXPECT_TRUE(by_name.at("paged")["lossless"]);
}

TEST_F(CliLayoutsTest, OneOfMyOwn) {
    GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
    const CommandResult made = layouts({"new", "mine/", "--from", "paged"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(json::parse(content_of(folder / "mine" / "layout.json"))["name"], "mine");
    EXPECT_EQ(render("mine", "a.exr").exit_code, 0);
    EXPECT_EQ(render("paged", "b.exr").exit_code, 0);
    EXPECT_EQ(run_gnomon(folder, {"compare", "--hash", "a.exr", "b.exr"}).exit_code, 0);
    EXPECT_EQ(json::parse(content_of(folder / "a.exr.json"))["effective"]["layout"], "mine");
}

// Names of sizes and buffers stay.
TEST_F(CliLayoutsTest, NewNamesTheLayoutWhereverItsNameIs) {
    ASSERT_EQ(layouts({"new", "mine", "--from", "paged"}).exit_code, 0);
    json manifest = json::parse(content_of(folder / "mine" / "layout.json"));
    EXPECT_EQ(manifest["name"], "mine");
    EXPECT_EQ(manifest["sizes"][1]["name"], "pages");
    manifest.erase("name");
    manifest["summary"] = "of \"name\": \\";
    std::string text = manifest.dump();
    put_content(folder / "mine" / "layout.json", text.insert(text.size() - 1, ", \"name\" : \"a\\\"b\""));
    ASSERT_EQ(layouts({"new", "other", "--from", "mine/"}).exit_code, 0);
    const json other = json::parse(content_of(folder / "other" / "layout.json"));
    EXPECT_EQ(other["name"], "other");
    manifest["name"] = "other";
    EXPECT_EQ(other, manifest);
}

TEST_F(CliLayoutsTest, NewDoesNotReplace) {
    put_content(folder / "mine", "a file");
    const CommandResult there = layouts({"new", "mine"});
    EXPECT_EQ(there.exit_code, 3);
    EXPECT_THAT(there.err, HasSubstr("there is something of that name, mine"));
    EXPECT_EQ(content_of(folder / "mine"), "a file");
    EXPECT_EQ(layouts({"new", "no/such/mine"}).exit_code, 3);
    EXPECT_EQ(layouts({"new"}).exit_code, 2);
    const CommandResult unknown = layouts({"new", "other", "--from", "heap"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "other"));
}

TEST_F(CliLayoutsTest, LostRangesAreExitCode7) {
    GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
    const CommandResult result = render("null", "a.exr");
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_THAT(result.err, HasSubstr("the layout null lost "));
    const json counts = json::parse(content_of(folder / "a.exr.json"))["counts"];
    EXPECT_EQ(counts["lost.0"], counts["ranges.0"]);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.exr"));
    const CommandResult other = render("no-depth", "b.exr", "dtr");
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.err, HasSubstr("--method exact"));
}

TEST_F(CliLayoutsTest, Check) {
    GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
    const CommandResult right = layouts({"check", "no-depth"});
    EXPECT_EQ(right.exit_code, 0) << right.err;
    EXPECT_THAT(right.out, HasSubstr("exact, three lights"));
    EXPECT_THAT(right.out, Not(HasSubstr("failed")));
    ASSERT_EQ(layouts({"new", "mine", "--from", "no-depth"}).exit_code, 0);
    std::string text = content_of(folder / "mine" / "layout.glsl");
    put_content(folder / "mine" / "layout.glsl", text.insert(text.find("range.leave"), "0.9 * "));
    const CommandResult wrong = layouts({"check", "mine", "--fail-fast", "--json", "a.json"});
    EXPECT_EQ(wrong.exit_code, 9);
    EXPECT_THAT(wrong.err, HasSubstr("exact, sun failed: light 0, texel "));
    EXPECT_THAT(wrong.err, HasSubstr("ranges; not contained is triangle "));
    EXPECT_FALSE(json::parse(content_of(folder / "a.json"))["checks"][0]["passed"]);
    EXPECT_EQ(layouts({"check", "heap"}).exit_code, 2);
}

// Many times that: with the label long.
class CliLayoutsCheckTest : public CliLayoutsTest {
protected:
    void SetUp() override { GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"})); }

    /// A copy of a layout with something in it replaced.
    void mistake(const std::string& layout, const std::string& file, const std::string& from, const std::string& to) {
        std::filesystem::remove_all(folder / "mine");
        ASSERT_EQ(layouts({"new", "mine", "--from", layout}).exit_code, 0);
        std::string text = content_of(folder / "mine" / file);
        ASSERT_THAT(text, HasSubstr(from));
        put_content(folder / "mine" / file, text.replace(text.find(from), from.size(), to));
    }
};

TEST_F(CliLayoutsCheckTest, PassesWhatIsRight) {
    for (const char* layout : {"paged", "no-depth", "fixed"}) {
        const CommandResult result = layouts({"check", layout});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.out, Not(HasSubstr("failed")));
        EXPECT_THAT(result.out, HasSubstr("exact, three lights"));
    }
}

TEST_F(CliLayoutsCheckTest, NamesWhatIsWrong) {
    const struct {
        const char *layout, *file, *from, *to, *what;
    } mistakes[] = {
        // Ranges that are not there, or others.
        {"array", "layout.glsl", "return it.x < it.y;", "return it.x + 1u < it.y;", "ranges; lost is triangle "},
        {"array", "layout.glsl", "Iterator(first_ranges(list), ", "Iterator(first_ranges(list) + 1u, ",
         "ranges; lost is triangle "},
        {"array", "layout.glsl", "end_ranges(list))", "end_ranges(list) - 1u)", "texels outside of a light's view have ranges"},
        {"array", "layout.glsl", "Iterator(first_ranges(list), ", "Iterator(0u, ",
         "texels outside of a light's view have ranges"},
        {"array", "layout.glsl", "    ++cursor;\n", "", "light 0, texel "},
        {"array", "layout.glsl", "    ++it.x;\n", "    it.x += 2u;\n", "ranges; lost is triangle "},
        {"array", "layout.glsl", "set_range(cursor, range)", "range.depth += 1.0;\n    set_range(cursor, range)",
         ", instead of triangle "},
        {"array", "layout.glsl", "set_range(cursor, range)", "range.depth = 0.0;\n    set_range(cursor, range)",
         ", instead of triangle "},
        {"array", "layout.glsl", "set_range(cursor, range)", "range.entry &= 255u;\n    set_range(cursor, range)",
         "there is none of triangle "},
        {"array", "layout.glsl", "set_range(cursor, range)", "range.enter += 0.001;\n    set_range(cursor, range)",
         ", instead of triangle "},
        {"array", "layout.glsl", "set_range(cursor, range)", "if (range.depth > 0.0) set_range(cursor, range)",
         "light 0, texel "},
        {"array", "layout.glsl", "set_range(cursor, range)", "if (list.texel != 63u) set_range(cursor, range)",
         "light 0, texel "},
        {"array-soa", "layout.glsl", "range.enter, range.leave", "range.leave, range.enter",
         "ranges; there is none of triangle "},
        {"array-soa", "layout.glsl", "    set_depths(cursor, range.depth);\n", "", "ranges; there is none of triangle "},
        {"array-soa", "layout.glsl", "    set_exits(cursor, range.exit_depth);\n", "", "ranges; there is none of triangle "},
        {"array-counter", "layout.json", "    \"prepare\": \"list\",\n", "", "beyond the end of buffer 'ranges'"},
        {"linked", "layout.json", ", \"initial\": \"none\"", "", "texels outside of a light's view have ranges"},
        {"linked", "layout.glsl", "set_links(node, exchange_heads(list.index, node))", "exchange_heads(list.index, node)", ""},
        {"linked", "layout.glsl", "set_links(node, exchange_heads(list.index, node))",
         "set_links(node, kNone);\n    set_heads(list.index, node)", "ranges; lost is triangle "},
        {"paged", "layout.glsl", "- 1u, page)", ", page)", "beyond the end of buffer 'links'"},
        {"paged", "layout.glsl", "it.x = turns ? next : it.x + 1u;", "it.x = it.x + 1u;", "light 0, "},
        {"paged", "layout.glsl", "it.x % PAGE == PAGE - 1u &&", "it.x % PAGE == PAGE - 2u &&",
         "beyond the end of buffer 'links'"},
        {"jagged", "layout.glsl", "cursor += kTileTexels;", "cursor += kTileTexels - 1u;", "light 0, texel "},
        {"jagged", "layout.glsl", "+ list.texel, size_ranges", "+ list.texel % 63u, size_ranges", "light 0, texel "},
        {"sorted-depth", "layout.glsl", "!(nearest_of(range) < query.limit)", "range.depth > 0.5 * query.limit", "pixel "},
        {"sorted-depth", "layout.glsl", "heap_sort(first_ranges(list), ", "heap_sort(first_ranges(list) + 1u, ", "pixel "},
        {"sorted-depth", "layout.json", "    \"finish\": \"list\",\n", "", "pixel "},
        {"sorted-time", "layout.glsl", "range.enter > query.t", "range.enter > 0.5 * query.t", "pixel "},
        {"sorted-time", "layout.glsl", "fetch_ranges(place).x", "-fetch_ranges(place).x", "pixel "},
        {"no-depth", "layout.glsl", "leave_step(range.leave", "leave_step(0.9 * range.leave",
         "ranges; not contained is triangle "},
        {"no-depth", "layout.glsl", "enter_step(range.enter", "enter_step(0.1 + range.enter",
         "ranges; not contained is triangle "},
        {"no-depth", "layout.glsl", "-kFarthest, range.y", "0.0, range.y", "ranges; not contained is triangle "},
        {"no-depth", "layout.json", "\"lossless\": false", "\"lossless\": true", "there is none of triangle "},
        {"fixed", "layout.glsl", "count_lost(cursor - K)", "count_lost(1u)", "are lost, and "},
        {"fixed", "layout.json", "\"lossless\": false", "\"lossless\": true", "ranges; lost is triangle "},
        {"null", "layout.glsl", "if (cursor > 0u) count_lost(cursor);", "", "are lost, and 0 counted"},
        // Places that are not a list's, or no places.
        {"array", "layout.glsl", "{ return first_ranges(list); }", "{ return first_ranges(list) + 1u; }",
         "beyond the end of buffer 'ranges'"},
        {"array", "layout.glsl", "set_range(cursor, range)", "set_range(cursor + 100000000u, range)",
         "beyond the end of buffer 'ranges'"},
        {"array", "layout.glsl", "fetch_range(it.x)", "fetch_range(it.x + 100000000u)", "beyond the end of buffer 'ranges'"},
        {"array", "layout.glsl", "fetch_range(it.x)", "fetch_range(it.x - 1u)",
         "beyond the end of buffer 'ranges', one of element 4294967295"},
        {"linked", "layout.glsl", "allocate_ranges(1u)", "allocate_ranges(2u)", "beyond the end of buffer '"},
        {"paged", "layout.glsl", "(count + PAGE - 1u) / PAGE", "count / PAGE", "beyond the end of buffer '"},
        {"paged", "layout.json", "\"elements\": \"PAGE\" },", "\"elements\": 2 },", "beyond the end of buffer 'ranges'"},
        {"array-counter", "layout.glsl", "allocate_places(count))", "allocate_places(count + 1u))",
         "beyond the end of buffer 'ranges'"},
        {"jagged", "layout.glsl", "{ return longest; }", "{ return longest - min(longest, 1u); }",
         "beyond the end of buffer 'ranges'"},
        {"fixed", "layout.glsl", "min(cursor, K)", "cursor", ""},
        {"fixed", "layout.glsl", "if (cursor < K)", "if (cursor <= K)", ""},
        // Walks without an end.
        {"array", "layout.glsl", "    ++it.x;\n", "", "ranges, some of them twice"},
        {"linked", "layout.glsl", "    it = fetch_links(it);\n", "", "ranges, some of them twice"},
        {"linked", "layout.glsl", "return it != kNone;", "return true;", ""},
    };
    for (const auto& m : mistakes) {
        SCOPED_TRACE(std::string(m.layout) + ": " + m.to);
        mistake(m.layout, m.file, m.from, m.to);
        const CommandResult result = layouts({"check", "mine", "--fail-fast"});
        EXPECT_EQ(result.exit_code, 9);
        EXPECT_THAT(result.err, HasSubstr(" failed: "));
        EXPECT_THAT(result.err, HasSubstr(m.what));
    }
}

}  // namespace gnomon::test
