// SPDX-License-Identifier: Apache-2.0
// `gnomon compare` of several renders of each method.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "io/exr.hpp"
#include "test_folder.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// Renders that are everywhere as far from a black reference as their error.
class CliCompareCurvesTest : public TestFolder {
protected:
    CliCompareCurvesTest() {
        write_image("black.exr", 0.0f, {});
        render("tsm_4", "tsm", 1.0, 0.5f, 4);
        render("tsm_16", "tsm", 4.0, 0.25f, 16);
        render("exact_8", "exact", 8.0, 0.125f, 8);
        render("exact_2", "exact", 2.0, 0.25f, 2);
    }

    void write_image(const std::string& name, float value, const std::map<std::string, std::string>& attributes) {
        const std::vector<float> values(16 * 16, value);
        io::write_exr(folder / name, 16, 16,
                      std::vector<Channel>{{"R", values}, {"Z", values}, {"visibility.0", std::vector<float>(16 * 16)}},
                      attributes);
    }

    void render(const std::string& name, const std::string& method, double seconds, float error, int spp, int seed = 7) {
        const json settings = {{"method", method}, {"spp", spp}, {"seed", seed}};
        const json document = {{"schema", "gnomon.render"},   {"device", "cpu"},         {"settings", settings},
                               {"effective", json::object()}, {"wall_seconds", seconds}, {"outputs", {name + ".exr"}}};
        put_content(folder / (name + ".json"), document.dump());
        write_image(name + ".exr", error,
                    {{"gnomon:method", method}, {"gnomon:spp", std::to_string(spp)}, {"gnomon:seed", std::to_string(seed)}});
    }

    CommandResult compare(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "compare");
        return run_gnomon(folder, arguments);
    }

    CommandResult compare_all(std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"tsm_4.json", "tsm_16.json", "exact_8.json", "exact_2.json", "black.exr"});
        return compare(std::move(options));
    }
};

// At 4 s exact is half way between its renders, of 2 and 8 s, in log(seconds): sqrt(0.25 * 0.125).
TEST_F(CliCompareCurvesTest, TablesOnStdout) {
    const CommandResult result = compare_all();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "gnomon: warning: channel visibility.0 is left out: tsm_4.json has no error in it\n");
    EXPECT_EQ(result.out,
              "rmse of R against black.exr\n"
              "error after seconds                    tsm                 exact\n"
              "1                                 0.5 +- 0      before the first\n"
              "4                                0.25 +- 0           0.1768 +- 0\n"
              "seconds to error                       tsm                 exact\n"
              "0.5                                 1 +- 0      before the first\n"
              "0.25                                4 +- 0                2 +- 0\n");
}

TEST_F(CliCompareCurvesTest, ADifferenceOfDriverIsNamed) {
    const auto set_driver = [&](const char* name, const char* driver) {
        json document = json::parse(content_of(folder / name));
        document["driver"] = driver;
        put_content(folder / name, document.dump());
    };
    set_driver("exact_2.json", "maker 1.2");
    EXPECT_THAT(compare_all().err, Not(HasSubstr("by the driver")));
    set_driver("tsm_4.json", "maker 1.3");
    const CommandResult result = compare_all({"--json=-"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("tsm_4.json was rendered by the driver maker 1.3, exact_2.json by maker 1.2"));
    const json methods = json::parse(result.out)["channels"][0]["methods"];
    EXPECT_EQ(methods[0]["renders"][0]["driver"], "maker 1.3");
    EXPECT_EQ(methods[0]["renders"][1]["driver"], nullptr);
}

TEST_F(CliCompareCurvesTest, PlacesThatAreAskedFor) {
    const CommandResult result = compare_all({"--after=2,100", "--to=0.2,0.01", "--channels=Z", "--json=-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const json document = json::parse(result.out);
    EXPECT_EQ(document["schema"], "gnomon.error_curves");
    EXPECT_EQ(document["channels"].size(), 1u);
    EXPECT_EQ(document["channels"][0]["name"], "Z");
    const json tsm = document["channels"][0]["methods"][0], exact = document["channels"][0]["methods"][1];
    EXPECT_EQ(tsm["method"], "tsm");
    EXPECT_NEAR(tsm["error_after"][0]["error"].get<double>(), std::sqrt(0.125), 1e-12);
    EXPECT_EQ(tsm["error_after"][1]["where"], "after_last");
    EXPECT_EQ(tsm["error_after"][1]["error"], nullptr);
    EXPECT_EQ(tsm["seconds_to"][0]["where"], "after_last");
    EXPECT_NEAR(exact["seconds_to"][0]["seconds"].get<double>(), 2.0 * std::pow(4.0, std::log2(1.25)), 1e-9);
    EXPECT_EQ(exact["renders"][0]["render"], "exact_8.json");
}

TEST_F(CliCompareCurvesTest, SettingsTellMethodsApart) {
    const json document = json::parse(compare_all({"--by=method,spp,bias", "--json=-", "--channels=R"}).out);
    const json& methods = document["channels"][0]["methods"];
    ASSERT_EQ(methods.size(), 4u);
    EXPECT_EQ(methods[1]["method"], "tsm 16 -");
}

// The same settings with another seed: not a point, but noise. The standard error of 0.25 against 0.5 everywhere is 0.
TEST_F(CliCompareCurvesTest, SecondRenderIsNoPoint) {
    render("tsm_4_again", "tsm", 1.1, 0.25f, 4, 8);
    const CommandResult result = compare({"tsm_4.json", "tsm_4_again.json", "black.exr", "--json=-", "--channels=R"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["channels"][0]["methods"][0]["renders"].size(), 1u);
}

TEST_F(CliCompareCurvesTest, ImagesAreFoundBesideTheirDocuments) {
    std::filesystem::create_directory(folder / "moved");
    for (const char* name : {"tsm_4.exr", "tsm_4.json"}) std::filesystem::rename(folder / name, folder / "moved" / name);
    EXPECT_EQ(compare({"moved/tsm_4.json", "black.exr"}).exit_code, 0);
}

TEST_F(CliCompareCurvesTest, UnfairComparisonsAreNamed) {
    write_image("seed7.exr", 0.0f, {{"gnomon:seed", "7"}});
    EXPECT_THAT(compare({"tsm_4.json", "seed7.exr"}).err, HasSubstr("tsm_4.exr and the reference have seed 7"));
}

TEST_F(CliCompareCurvesTest, UsageErrorsExitWith2) {
    for (const auto& [arguments, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"tsm_4.json", "tsm_16.json"}, "the last file is the reference"},
             {{"tsm_4.json", "black.exr", "--diff=d.exr"}, "--diff is for two images"},
             {{"tsm_4.json", "black.exr", "--again=a.exr"}, "--again is for two images"},
             {{"tsm_4.json", "black.exr", "--metric=ssim"}, "there is no standard error of ssim"},
             {{"tsm_4.json", "black.exr", "--after=0"}, "0 is not from"},
             {{"tsm_4.json", "black.exr", "--to=x"}, "'x' is not a number"},
             {{"tsm_4.exr", "black.exr", "--after=1"}, "--after is for the JSONs of renders"},
             {{"tsm_4.exr", "tsm_16.exr", "black.exr"}, "two images are compared, not 3"},
             {{"tsm_4.exr"}, "two images are compared, not 1"}}) {
        const CommandResult result = compare(arguments);
        EXPECT_EQ(result.exit_code, 2) << text;
        EXPECT_THAT(result.err, HasSubstr(text));
    }
}

TEST_F(CliCompareCurvesTest, BadInputExitsWith3) {
    put_content(folder / "broken.json", "{");
    put_content(folder / "deep.json", R"({"schema": "gnomon.render", "settings": {"method": )" + std::string(80'000, '[') +
                                          std::string(80'000, ']') + "}}");
    std::filesystem::create_directory(folder / "folder.json");
    ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
    put_content(folder / "other.json", R"({"schema": "gnomon.compare"})");
    put_content(folder / "empty.json", R"({"schema": "gnomon.render", "settings": {}})");
    render("stale", "tsm", 1.0, 0.5f, 4);
    write_image("stale.exr", 0.5f, {{"gnomon:method", "exact"}, {"gnomon:spp", "4"}, {"gnomon:seed", "7"}});
    render("same_time", "tsm", 1.0, 0.4f, 5);
    render("no_time", "tsm", 0.0, 0.4f, 5);
    render("equal", "tsm", 1.0, 0.0f, 4);
    for (const auto& [arguments, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"none.json"}, "there is no such file, none.json"},
             {{"broken.json"}, "not valid JSON"},
             {{"deep.json"}, "nested more than 64 deep, deep.json"},
             {{"folder.json"}, "it is not a regular file, folder.json"},
             {{"pipe.json"}, "it is not a regular file, pipe.json"},
             {{"other.json"}, "its schema is \"gnomon.compare\", other.json"},
             {{"empty.json"}, "'device' not found"},
             {{"stale.json"}, "gnomon:method is not tsm, stale.exr"},
             {{"tsm_4.json", "same_time.json"}, "two renders took 1.0"},
             {{"no_time.json"}, "0.000000 seconds cannot be a point"},
             {{"equal.json"}, "no channel in which all renders have an error"},
             {{"tsm_4.json", "--metric=flip"}, "FLIP needs the channels R, G and B"},
             {{"tsm_4.json", "--channels=Y"}, "there is no channel Y"}}) {
        std::vector<std::string> all = arguments;
        all.push_back("black.exr");
        const CommandResult result = compare(all);
        EXPECT_EQ(result.exit_code, 3) << text;
        EXPECT_EQ(result.out, "") << text;
        EXPECT_THAT(result.err, HasSubstr(text));
    }
}

}  // namespace gnomon::test
