// SPDX-License-Identifier: Apache-2.0
// `gnomon report` as its users see it, on measurements that were made up by hand (bench.json).
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Names = std::set<std::string>;

class CliReportTest : public TestFolder {
protected:
    CliReportTest() { put_content(folder / "bench.json", content_of(GN_PATH(GNOMON_BENCH_JSON))); }

    CommandResult report(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "report");
        return run_gnomon(folder, arguments);
    }

    /// bench.json, changed, as another file.
    void put_changed(const std::string& name, const std::function<void(json&)>& change) {
        json document = json::parse(content_of(folder / "bench.json"));
        change(document);
        put_content(folder / name, document.dump());
    }

    std::string page_of(const std::vector<std::string>& files) {
        std::vector<std::string> arguments = files;
        arguments.insert(arguments.end(), {"-o", "page.html"});
        const CommandResult result = report(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.out + result.err, "");
        return content_of(folder / "page.html");
    }
};

TEST_F(CliReportTest, PageHasAllSections) {
    const std::string page = page_of({"bench.json"});
    for (const char* id : {"verdicts", "stages", "axes", "bytes", "counts", "lists", "texels", "skipped", "meanings"}) {
        EXPECT_THAT(page, HasSubstr("id=\"" + std::string(id) + "\"")) << id;
        EXPECT_THAT(page, HasSubstr("href=\"#" + std::string(id) + "\"")) << id;
    }
    for (const char* fact :
         {"Device &lt;b&gt;1&lt;/b&gt;", "0123abc", "2026-11-27T12:00:00", "gnomon bench --layout array,linked,small,null"})
        EXPECT_THAT(page, HasSubstr(fact));
    for (const char* sentence :
         {"The A/A row is the baseline, measured a second time as if it were another layout: its 2 ratios lie between 1.010 "
          "and 1.010, and 0 of "
          "them came out as faster or slower.",
          "The least median of the query, of 3 settings: array in 3.",
          "From shadow-res 256 to 512 the query of array goes from 4 to 8 ms.", "array and small are on the Pareto front",
          "2.50 ranges per texel in the mean and 5 at most",
          "Not counted, since ranges were lost or the picture is another: linked.", "timed out after 60 s &amp; gave nothing",
          "A query of small has the fewest sectors"})
        EXPECT_THAT(page, HasSubstr(sentence));
    for (const char* plot :
         {"plot ratios", "plot bars", "plot curves", "plot front", "plot counts", "plot lengths", "plot texels"})
        EXPECT_THAT(page, HasSubstr(plot));
    for (const char* outside : {"http://", "https://", "src=\"/", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << "a page needs nothing else: " << outside;
}

TEST_F(CliReportTest, NamesAreHarmless) {
    const std::string page = page_of({"bench.json"});
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&quot;scene&quot;)&lt;/script&gt;"));
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(page, Not(HasSubstr("<b>1</b>")));
    ASSERT_EQ(report({"bench.json", "--svg", "figures", "--markdown", "tables.md", "--latex", "tables.tex"}).exit_code, 0);
    EXPECT_THAT(content_of(folder / "tables.md"), Not(HasSubstr("<script>")));
    EXPECT_THAT(content_of(folder / "tables.tex"), HasSubstr("\\textless{}script\\textgreater{}alert"));
    for (const auto& entry : std::filesystem::directory_iterator(folder / "figures")) {
        const std::string name = entry.path().filename().string();
        EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-."), std::string::npos) << name;
        EXPECT_THAT(content_of(entry.path()), Not(HasSubstr("<script>"))) << name;
    }
}

TEST_F(CliReportTest, FiguresStandAlone) {
    ASSERT_EQ(report({"bench.json", "--svg", "a/figures"}).exit_code, 0);
    Names kinds;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a" / "figures")) {
        const std::string name = entry.path().filename().string(), svg = content_of(entry.path());
        kinds.insert(name.substr(0, name.find('-')));
        EXPECT_THAT(svg, StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\"")) << name;
        EXPECT_THAT(svg, Not(HasSubstr("var("))) << name;
    }
    EXPECT_EQ(kinds, (Names{"ratios", "stages", "query", "build", "front", "counts", "lengths", "texels"}));
}

TEST_F(CliReportTest, TablesStandAlone) {
    ASSERT_EQ(report({"bench.json", "--csv", "tables"}).exit_code, 0);
    Names files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "tables"))
        files.insert(entry.path().filename().string());
    EXPECT_EQ(files, (Names{"summary.csv", "verdicts-query.csv", "verdicts-build.csv", "times.csv", "bytes.csv", "counts.csv",
                            "skipped.csv"}));
    const std::string verdicts = content_of(folder / "tables" / "verdicts-query.csv");
    EXPECT_THAT(verdicts,
                StartsWith("layout,scene,shadow-res,ratio,low,high,pairs,verdict\r\n"
                           "\"array, again\",cubes,256,1.01,0.99,1.015,3,same\r\nlinked,cubes,256,2,1.8,8.5,3,slower\r\n"));
    EXPECT_THAT(verdicts, HasSubstr("linked,\"<script>alert(\"\"scene\"\")</script>\",256,2,,,3,undecided\r\n"));
    const CommandResult markdown = report({"bench.json", "--markdown", "-"});
    EXPECT_THAT(markdown.out, HasSubstr("| linked | cubes | 256 | 2.000 | 1.800 | 8.500 | 3 | slower |"));
}

TEST_F(CliReportTest, SeveralFilesAreToldApart) {
    put_changed("other.json", [](json& document) { document["context"]["device"] = "Other & co"; });
    const std::string page = page_of({"bench.json", "other.json"});
    EXPECT_THAT(page, HasSubstr("id=\"files\""));
    EXPECT_THAT(page, HasSubstr("cubes, shadow-res 256, query (Other &amp; co)"));
    // The same device twice: they are told apart by their names.
    put_content(folder / "again.json", content_of(folder / "bench.json"));
    EXPECT_THAT(page_of({"bench.json", "again.json"}), HasSubstr("cubes, shadow-res 256, query (again)"));
}

TEST_F(CliReportTest, WhatIsNotThereIsSaid) {
    put_changed("bare.json", [](json& document) {
        document["gnomon"]["comparisons"] = json::array();
        document["gnomon"]["skipped"] = json::array();
        document["gnomon"]["axes"][1]["values"] = {"256"};
        json& cases = document["gnomon"]["cases"];
        cases.erase(cases.begin() + 2, cases.end());
        for (json& c : cases) {
            c["counts"] = json::object();
            for (const char* member : {"lengths", "texels", "floor"}) c.erase(member);
        }
    });
    const std::string page = page_of({"bare.json"});
    for (const char* text :
         {"Nothing was compared.", "No axis has more than one value.", "The bytes of the maps were not counted.",
          "Nothing was counted in this run.", "The lengths of lists were not counted", "Ranges per texel were not counted",
          "No case was skipped.", "was not measured a second time"})
        EXPECT_THAT(page, HasSubstr(text));
}

TEST_F(CliReportTest, BadInputExitsWith3AndSaysWhatIsMissing) {
    using Change = std::function<void(json&)>;
    const auto first_case = [](const std::function<void(json&)>& change) {
        return Change([change](json& document) { change(document["gnomon"]["cases"][0]); });
    };
    const std::vector<std::pair<Change, std::string>> changes = {
        {[](json& d) { d.erase("gnomon"); }, "the document has no \"gnomon\""},
        {[](json& d) { d.erase("context"); }, "the document has no \"context\""},
        {[](json& d) { d["gnomon"]["format"] = 2; }, "gnomon.format is 2, and this gnomon reads 1"},
        {[](json& d) { d["gnomon"].erase("skipped"); }, "gnomon has no \"skipped\""},
        {[](json& d) { d["gnomon"]["cases"] = 1; }, "gnomon.cases is not an array"},
        {[](json& d) { d["gnomon"]["cases"][1]["name"] = d["gnomon"]["cases"][0]["name"]; },
         "gnomon.cases[1] has the name of another"},
        {[](json& d) { d["gnomon"]["comparisons"][0]["case"] = "x"; },
         "gnomon.comparisons[0] is of \"x\", which is none of the cases"},
        {[](json& d) { d["gnomon"]["comparisons"][0]["verdict"] = "best"; },
         "gnomon.comparisons[0].verdict is \"best\", not faster"},
        {first_case([](json& c) { c.erase("layout"); }), "gnomon.cases[0] has no \"layout\""},
        {first_case([](json& c) { c["again"] = "no"; }), "gnomon.cases[0].again is neither true nor false"},
        {first_case([](json& c) { c["stages"].erase("query"); }), "gnomon.cases[0].stages has no \"query\""},
        {first_case([](json& c) { c["stages"]["query"]["median"] = -1; }), "gnomon.cases[0].stages.query.median is below 0"},
        {first_case([](json& c) { c["stages"]["query"]["q1"] = "x"; }), "gnomon.cases[0].stages.query.q1 is not a number"},
        {first_case([](json& c) { c["counts"]["lost"] = 1e300; }), "gnomon.cases[0].counts.lost is above"},
        {first_case([](json& c) { c["axes"] = json::object(); }), "gnomon.cases[0].axes has no \"shadow-res\""},
        {first_case([](json& c) { c["texels"]["width"] = 4; }), "gnomon.cases[0].texels.ranges has 6 numbers for 4x2"},
        {first_case([](json& c) { c["texels"]["width"] = 1 << 20; }), "gnomon.cases[0].texels is not from 1x1 to 1024x1024"},
        {first_case([](json& c) { c["lengths"][1]["from"] = 7; }), "gnomon.cases[0].lengths[1] ends before it begins"},
        {first_case([](json& c) { c["scene"] = std::string(1000, 's'); }), "gnomon.cases[0].scene has more than 200 bytes"}};
    for (const auto& [change, text] : changes) {
        put_changed("bad.json", change);
        const CommandResult result = report({"bench.json", "bad.json", "-o", "page.html"});
        EXPECT_EQ(result.exit_code, 3) << text;
        EXPECT_THAT(result.err, HasSubstr("gnomon: error: "));
        EXPECT_THAT(result.err, HasSubstr(text));
        EXPECT_THAT(result.err, HasSubstr(", bad.json; "));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
    for (const auto& [content, text] : std::vector<std::pair<std::string, std::string>>{
             {"", "not valid JSON"},
             {"{\"gnomon\": ", "not valid JSON"},
             {"[]", "the document is not an object"},
             {std::string(100, '[') + std::string(100, ']'), "nested more than 64 deep"}}) {
        put_content(folder / "bad.json", content);
        const CommandResult result = report({"bad.json", "-o", "page.html"});
        EXPECT_EQ(result.exit_code, 3) << text;
        EXPECT_THAT(result.err, HasSubstr(text));
    }
    EXPECT_THAT(report({"none.json", "-o", "page.html"}).err, HasSubstr("there is no such file, none.json"));
    EXPECT_EQ(report({"bench.json", "-o", "none/page.html"}).exit_code, 3);
    EXPECT_EQ(report({"bench.json", "--csv", "bench.json"}).exit_code, 3);
    EXPECT_EQ(names(), (Names{"bad.json", "bench.json"}));
}

TEST_F(CliReportTest, UsageErrorsExitWith2) {
    for (const auto& [arguments, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{}, "FILES"},
             {{"bench.json"}, "nothing is to be written"},
             {{"bench.json", "-o", ""}, "-o"},
             {{"bench.json", "-o", "a.html", "--pdf", "a"}, "--pdf"},
             {std::vector<std::string>(17, "bench.json"), "nothing is to be written"}}) {
        const CommandResult result = report(arguments);
        EXPECT_EQ(result.exit_code, 2) << text;
        EXPECT_THAT(result.err, HasSubstr(text));
    }
    std::vector<std::string> many(17, "bench.json");
    many.insert(many.end(), {"-o", "a.html"});
    EXPECT_EQ(report(many).exit_code, 2);
    EXPECT_EQ(names(), Names{"bench.json"});
}

}  // namespace
}  // namespace gnomon::test
