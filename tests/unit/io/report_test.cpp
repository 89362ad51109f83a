// SPDX-License-Identifier: Apache-2.0
// The JSON documents and the attributes of an EXR header.
#include "io/report.hpp"

#include <gmock/gmock.h>

#include <gnomon/version.hpp>
#include <limits>

namespace gnomon::test {

using io::Json;

TEST(Report, RenderDocument) {
    Frame frame;
    frame.effective = {{"raster", "conservative"}};
    FrameStats& stats = frame.stats;
    stats.stages = {{"setup", 0.5, 2, 0.125}, {"bin", 0.25, 1}};
    stats.buffer_bytes = {{"prisms", 4096}};
    stats.peak_bytes = 1ull << 40;
    stats.counts = {{"ranges", 123}};
    stats.wall_seconds = 1.5;
    stats.submissions = 7;
    stats.longest_dispatch = 0.25;
    stats.device = "llvmpipe";
    stats.driver = "llvmpipe Mesa 22.3.6";
    const Json json = io::render_json(frame, {{"spp", 16}}, {"a.exr", "a.png"}, {"no camera"});
    EXPECT_EQ(json, Json::parse(R"({
        "schema": "gnomon.render", "schema_version": 1, "version": ")" GNOMON_VERSION R"(", "device": "llvmpipe",
        "driver": "llvmpipe Mesa 22.3.6", "settings": {"spp": 16}, "effective": {"raster": "conservative"},
        "stages": [{"name": "setup", "seconds": 0.5, "map_seconds": 0.125, "dispatches": 2},
                   {"name": "bin", "seconds": 0.25, "map_seconds": 0.0, "dispatches": 1}],
        "buffers": {"prisms": 4096}, "peak_bytes": 1099511627776, "counts": {"ranges": 123}, "submissions": 7,
        "longest_dispatch": 0.25, "wall_seconds": 1.5,
        "outputs": ["a.exr", "a.png"], "warnings": ["no camera"]})"));
}

TEST(Report, NothingMeansEmptyListsAndObjects) {
    const Json json = io::render_json({}, Json::object(), {}, {});
    EXPECT_TRUE(json["stages"].is_array());
    EXPECT_TRUE(json["effective"].is_object());
    EXPECT_TRUE(json["buffers"].is_object());
    EXPECT_TRUE(json["counts"].is_object());
    EXPECT_TRUE(json["outputs"].is_array());
    EXPECT_TRUE(json["warnings"].is_array());
}

TEST(Report, EverySettingIsThere) {
    RenderSettings settings{.width = 1,
                            .height = 2,
                            .spp = 3,
                            .seed = 4,
                            .camera = 5,
                            .shadow_res = 6,
                            .method = "m",
                            .layout = "l",
                            .raster = "r",
                            .memory_budget = 7,
                            .keep_samples = true};
    EXPECT_EQ(io::settings_json(settings), Json::parse(R"({"width": 1, "height": 2, "spp": 3, "seed": 4, "camera": 5,
        "shadow_res": 6, "method": "m", "layout": "l", "raster": "r", "pages": "auto", "closed_meshes": true, "static_once": true,
        "memory_budget": 7})"));
}

TEST(Report, AttributesAreText) {
    const auto attributes = io::exr_attributes({{"spp", 16}, {"method", "exact"}, {"shutter_close", 0.0208333}, {"on", true}},
                                               {{"raster", "analytic"}});
    const std::map<std::string, std::string> expected = {{"gnomon:spp", "16"},
                                                         {"gnomon:method", "exact"},
                                                         {"gnomon:shutter_close", "0.0208333"},
                                                         {"gnomon:on", "true"},
                                                         {"gnomon:effective.raster", "analytic"}};
    EXPECT_EQ(attributes, expected);
}

TEST(Report, TextIsAlwaysValidJson) {
    const std::string text = io::to_text({{"name", "a\xff\n"}, {"psnr", std::numeric_limits<double>::infinity()}}, -1);
    EXPECT_EQ(text, "{\"name\":\"a\xef\xbf\xbd\\n\",\"psnr\":null}");
}

}  // namespace gnomon::test
