// SPDX-License-Identifier: Apache-2.0
// The registry of methods, and what it says to settings that do not go together.
#include "methods/method.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <gnomon/error.hpp>
#include <set>

#include "layouts/layout.hpp"
#include "stages/cells.hpp"
#include "stages/programs.hpp"
#include "support/tested_layouts.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

template <class Statement>
void expect_usage_error(const std::vector<std::string>& parts, Statement statement) {
    try {
        statement();
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        for (const std::string& part : parts) EXPECT_THAT(error.what(), HasSubstr(part));
    }
}

TEST(MethodTest, NamesAreUniqueAndStagesExist) {
    std::set<std::string> names;
    for (const Method& method : methods()) {
        EXPECT_TRUE(names.insert(method.name).second) << method.name;
        EXPECT_EQ(find_method(method.name).name, method.name);
        if (!method.has_s_buffer()) {
            EXPECT_FALSE(find_shader(method.shadow_stage).spirv.empty()) << method.name;
            continue;
        }
        for (const std::string& layout : tested_layouts()) {
            if (!is_compiled(find_layout(layout))) continue;
            EXPECT_FALSE(find_shader(method.shadow_stage + "@" + layout).spirv.empty());
            for (const std::string& raster : method.rasters)
                EXPECT_FALSE(find_shader("raster/" + raster + "@" + layout).spirv.empty());
        }
    }
    EXPECT_EQ(methods().front().name, RenderSettings().method);
}

TEST(MethodTest, UnknownOneNamesThoseThatExist) {
    expect_usage_error({"no method 'dtr-analytical'", "--method", "exact", "dtr-analytic"},
                       [] { find_method("dtr-analytical"); });
}

TEST(MethodTest, RasterIsTheMethodsOwn) {
    EXPECT_EQ(choose_raster(find_method("exact"), "auto"), "conservative");
    EXPECT_EQ(choose_raster(find_method("exact"), "conservative"), "conservative");
    EXPECT_EQ(choose_raster(find_method("dtr-analytic"), "auto"), "analytic");
    expect_usage_error({"exact", "'analytic'", "--raster", "conservative"},
                       [] { choose_raster(find_method("exact"), "analytic"); });
    expect_usage_error({"dtr-analytic", "'conservative'", "--raster", "use auto or analytic"},
                       [] { choose_raster(find_method("dtr-analytic"), "conservative"); });
    expect_usage_error({"'prism'"}, [] { choose_raster(find_method("exact"), "prism"); });
}

TEST(MethodTest, LightCellsAreAMultipleOfTheSegments) {
    EXPECT_GT(light_cells(1, false), 1u);
    EXPECT_EQ(light_cells(7, false) % 7, 0u);
    EXPECT_EQ(light_cells(3, true), 3u);
}

TEST(MethodTest, ParametersAreTheMethodsOwn) {
    check_parameters(find_method("exact"), {});
    check_parameters(find_method("tsm"), {{"map-spp", 8.0}, {"bias", 0.25}});
    expect_usage_error({"method exact has no parameter 'bias'", "--bias", "none"}, [] {
        check_parameters(find_method("exact"), {{"bias", 0.1}});
    });
    expect_usage_error({"method tsm has no parameter 'layers'", "--layers", "--map-spp, --bias"}, [] {
        check_parameters(find_method("tsm"), {{"layers", 4.0}});
    });
    expect_usage_error({"map-spp is 1.5", "--map-spp", "a whole number from 1 to 4096"}, [] {
        check_parameters(find_method("tsm"), {{"map-spp", 1.5}});
    });
    expect_usage_error({"bias is -1", "from 0", "metres"}, [] { check_parameters(find_method("tsm"), {{"bias", -1.0}}); });
    expect_usage_error({"bias is nan"}, [] { check_parameters(find_method("tsm"), {{"bias", std::nan("")}}); });
    expect_usage_error({"method tsm has no ranges", "--raster"}, [] { choose_raster(find_method("tsm"), "analytic"); });
}

TEST(MethodTest, OnlyExitDepthsCostMemory) {
    const auto range_bytes = [](const Layout& layout) {
        uint32_t bytes = 0;
        for (const LayoutBuffer& b : layout.buffers)
            bytes += b.per == LayoutBuffer::Per::size && b.size == 0 && layout.has(b) ? b.element_bytes : 0;
        return bytes;
    };
    for (const char* name : {"array", "linked"}) {
        const Layout layout = find_layout(name);
        EXPECT_EQ(range_bytes(with_ranges(layout, true)), range_bytes(with_ranges(layout, false)) + 4) << name;
    }
    expect_usage_error({"no S-buffer layout 'heap'", "array", "linked"}, [] { find_layout("heap"); });
}

}  // namespace
}  // namespace gnomon::test
