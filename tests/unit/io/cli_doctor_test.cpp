// SPDX-License-Identifier: Apache-2.0
// `gnomon doctor` on the device there is, and on drivers that are broken on purpose; `gnomon devices` beside one.
#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CliDoctorTest : public TestFolder {
protected:
    using Variables = std::vector<std::pair<const char*, std::string>>;

    CommandResult run(const std::vector<std::string>& arguments, const Variables& variables = {}) {
        return run_gnomon(folder, arguments, [&] {
            for (const auto& [name, value] : variables) setenv(name, value.c_str(), 1);
        });
    }

    /// A driver's manifest that names a library which is not there.
    std::string broken_manifest() const {
        put_content(folder / "broken.json", R"({"file_format_version": "1.0.0",
            "ICD": {"library_path": "/nonexistent/libgnomon_driver.so", "api_version": "1.3.0"}})");
        return (folder / "broken.json").string();
    }

    /// A copy of the layout "array" with one thing replaced.
    std::string broken_layout(const std::string& from, const std::string& to) const {
        const auto source = std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "comp_shaders" / "layouts" / "array";
        std::string glsl = content_of(source / "layout.glsl");
        EXPECT_THAT(glsl, HasSubstr(from));
        std::filesystem::create_directories(folder / "layout");
        put_content(folder / "layout" / "layout.json", content_of(source / "layout.json"));
        put_content(folder / "layout" / "layout.glsl", glsl.replace(glsl.find(from), from.size(), to));
        return "layout";
    }

    /// Exit code 9, and only the picture is wrong.
    void expect_wrong_picture(const std::string& layout, const std::string& reason) {
        const CommandResult result = run({"doctor", "--layout", layout});
        EXPECT_EQ(result.exit_code, 9);
        EXPECT_THAT(result.out, AllOf(HasSubstr("\nsums      ok "), HasSubstr("\npicture   failed "), HasSubstr(reason)));
        EXPECT_THAT(result.err,
                    AllOf(HasSubstr("gnomon: error: picture failed: "), HasSubstr("; the driver computes wrongly")));
    }
};

TEST_F(CliDoctorTest, PassesOnADeviceThatWorks) {
    GN_SKIP_WITHOUT_DEVICE(run({"devices"}));
    const CommandResult result = run({"doctor"});
    EXPECT_EQ(result.exit_code, 0) << result.out;
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, Not(HasSubstr("failed")));
    const CommandResult machine = run({"doctor", "--json=-"});
    EXPECT_EQ(machine.exit_code, 0);
    const json document = json::parse(machine.out);
    EXPECT_EQ(document["schema"], "gnomon.doctor");
    EXPECT_EQ(document["passed"], true);
    EXPECT_EQ(document["exit_code"], 0);
    std::vector<std::string> names;
    for (const json& check : document["checks"]) {
        EXPECT_EQ(check["passed"], true);
        names.push_back(check["name"]);
        EXPECT_THAT(result.out, HasSubstr(names.back()));
    }
    EXPECT_EQ(names, (std::vector<std::string>{"loader", "features", "driver", "limits", "sums", "picture"}));
}

TEST_F(CliDoctorTest, PassesWithEachLayout) {
    GN_SKIP_WITHOUT_DEVICE(run({"devices"}));
    for (const char* layout : {"array", "linked"}) {
        const CommandResult result = run({"doctor", "--layout", layout});
        EXPECT_EQ(result.exit_code, 0) << result.out;
    }
}

TEST_F(CliDoctorTest, NamesTheLibraryThatAManifestLacks) {
    const std::string manifest = broken_manifest();
    const Variables only_broken = {{"VK_DRIVER_FILES", manifest}, {"VK_ICD_FILENAMES", manifest}};
    const CommandResult result = run({"doctor"}, only_broken);
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_THAT(result.out, AllOf(HasSubstr("loader    failed "), HasSubstr("/nonexistent/libgnomon_driver.so")));
    EXPECT_THAT(result.err, HasSubstr("/nonexistent/libgnomon_driver.so"));
    const json document = json::parse(run({"doctor", "--json=-"}, only_broken).out);
    EXPECT_EQ(document["passed"], false);
    EXPECT_EQ(document["exit_code"], 4);
    EXPECT_EQ(document["checks"].size(), 1u);

    const CommandResult devices = run({"devices", "--json=-"}, only_broken);
    EXPECT_EQ(devices.exit_code, 4);
    EXPECT_THAT(devices.err, HasSubstr("gnomon: warning: the Vulkan loader: "));
    EXPECT_THAT(json::parse(devices.out)["loader_errors"].dump(), HasSubstr("libgnomon_driver.so"));
}

TEST_F(CliDoctorTest, ABrokenManifestBesideADriverIsNamed) {
    GN_SKIP_WITHOUT_DEVICE(run({"devices"}));
    const char* given = std::getenv("VK_DRIVER_FILES");
    const Variables beside = given != nullptr ? Variables{{"VK_DRIVER_FILES", broken_manifest() + ":" + given},
                                                          {"VK_ICD_FILENAMES", broken_manifest() + ":" + given}}
                                              : Variables{{"VK_ADD_DRIVER_FILES", broken_manifest()}};
    const CommandResult devices = run({"devices", "--json=-"}, beside);
    EXPECT_EQ(devices.exit_code, 0) << devices.err;
    EXPECT_THAT(json::parse(devices.out)["loader_errors"].dump(), HasSubstr("libgnomon_driver.so"));
    EXPECT_THAT(json::parse(devices.out)["devices"], Not(IsEmpty()));
    const CommandResult doctor = run({"doctor"}, beside);
    EXPECT_EQ(doctor.exit_code, 0) << doctor.err;
    EXPECT_THAT(doctor.out, HasSubstr("libgnomon_driver.so"));
}

TEST_F(CliDoctorTest, NamesTheFeatureThatADeviceLacks) {
    GN_SKIP_WITHOUT_DEVICE(run({"devices"}));
    const Variables without_shuffles = {{"GNOMON_LIMITS", "shuffles=0"}};
    const CommandResult result = run({"doctor"}, without_shuffles);
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_THAT(result.out, AllOf(HasSubstr("loader    ok "), HasSubstr("\nfeatures  failed "), Not(HasSubstr("\nsums"))));
    EXPECT_THAT(result.err, HasSubstr("lacks subgroup shuffle"));
    EXPECT_THAT(run({"devices"}, without_shuffles).out, HasSubstr("not usable: lacks subgroup shuffle"));
}

TEST_F(CliDoctorTest, FindsAPictureWithoutShadows) {
    GN_SKIP_WITHOUT_DEVICE(run({"devices"}));
    expect_wrong_picture(broken_layout("return it.x < it.y;", "return false;"), "visibility.0");
}

TEST_F(CliDoctorTest, FindsAPictureThatLosesSomeRanges) {
    GN_SKIP_WITHOUT_DEVICE(run({"devices"}));
    expect_wrong_picture(
        broken_layout("    ++it.x;\n", "    ++it.x;\n    if (range.enter > 0.7) range.enter = range.leave = 2.0;\n"),
        "standard errors");
}

TEST_F(CliDoctorTest, DevicesSaysWhatLimitsAndFaultsThereAre) {
    const CommandResult result = run({"devices", "--json=-"});
    GN_SKIP_WITHOUT_DEVICE(result);
    const json device = json::parse(result.out)["devices"][0];
    for (const char* limit : {"buffer_bytes", "storage_range_bytes", "texel_elements", "workgroup_invocations",
                              "subgroup_invocations", "timestamp_bits"})
        EXPECT_TRUE(device["limits"].contains(limit)) << limit;
    EXPECT_EQ(device["driver"], device["driver_name"].get<std::string>() + " " + device["driver_version"].get<std::string>());
    const std::string text = run({"devices"}).out;
    EXPECT_THAT(text, HasSubstr("storage_range_bytes"));
    for (const json& fault : device["faults"]) EXPECT_THAT(text, HasSubstr("known fault: " + fault.get<std::string>()));
    const json lowered = json::parse(run({"devices", "--json=-"}, {{"GNOMON_LIMITS", "storage_range=16777216"}}).out);
    EXPECT_EQ(lowered["devices"][0]["limits"]["storage_range_bytes"], 16777216);
}

}  // namespace
}  // namespace gnomon::test
