// SPDX-License-Identifier: Apache-2.0
#include "methods/method.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <sstream>

#include "methods/depth_map.hpp"
#include "methods/dsm.hpp"
#include "methods/fssm.hpp"
#include "methods/ranges.hpp"
#include "stages/cells.hpp"

namespace gnomon {
namespace {

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

// A range lasts as long as its triangle stays.
uint32_t segment_cells(const LightContext& light) { return light.geometry.segment_count; }

// Ranges may be cut where a cell ends: whatever is fast.
uint32_t finer_cells(const LightContext& light) {
    return light_cells(light.geometry.segment_count, light.still, light.settings.light_cells);
}

// Its prisms are listed as the camera's are, since its view is sampled as the camera's image is.
Method depth_map_method(const std::string& name, const std::string& summary, const std::string& source, DepthMapKind kind) {
    return {.name = name,
            .summary = summary,
            .source = source,
            .shadow_stage = "methods/depth_map/shadow",
            .parameters = depth_map_parameters(kind),
            .light_cells =
                [kind](const LightContext& light) {
                    return camera_cells(map_sampling(light, kind).spp, light.geometry.segment_count, light.still);
                },
            .make_map = [kind](const LightContext& light,
                               const Bins& bins) { return std::make_unique<DepthMap>(light, bins, kind); }};
}

}  // namespace

std::optional<double> LightContext::parameter(const std::string& name) const {
    const auto found = settings.parameters.find(name);
    return found == settings.parameters.end() ? std::nullopt : std::optional<double>(found->second);
}

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        {.name = "exact",
         .summary = "conservative ranges; their triangles are tested at the hit's own place and time",
         .source = "",
         .rasters = {"conservative"},
         .shadow_stage = "sample/shadow",
         .any_texels = true,
         .any_cells = true,
         .one_sided = true,
         .light_cells = finer_cells,
         .make_map = make_s_buffer},
        {.name = "dtr",
         .summary = "ranges of triangulated prisms at the texels' centres; depth is linear between entry and exit",
         .source = "Hong and Oh 2018",
         .rasters = {"prism", "analytic"},
         .shadow_stage = "methods/dtr/shadow",
         .layout = "linked",
         .exit_depth = true,
         .parameters = dtr_parameters(true),
         .light_cells = segment_cells,
         .make_map = make_dtr_map},
        {.name = "dtr-analytic",
         .summary = "ranges at the texels' centres; depth is linear between entry and exit",
         .source = "Hong and Oh 2018, 3.3, with analytic ranges",
         .rasters = {"analytic"},
         .shadow_stage = "methods/dtr/shadow",
         .exit_depth = true,
         .parameters = dtr_parameters(false),
         .light_cells = segment_cells,
         .make_map = make_dtr_map},
        {.name = "temporal",
         .summary = "dtr; texels that one triangle covers for the whole shutter, nearest, have no ranges but its name",
         .source = "Hong and Oh 2017, Extension",
         .rasters = {"prism"},
         .shadow_stage = "methods/temporal/shadow",
         .layout = "linked",
         .exit_depth = true,
         .parameters = dtr_parameters(true),
         .light_cells = segment_cells,
         .make_map = make_temporal_map},
        depth_map_method("tsm", "a time-dependent shadow map: one depth per texel and stratum of time, constant bias",
                         "Akenine-Moller et al. 2007, 5", DepthMapKind::stochastic),
        depth_map_method("tsm-dynamic-bias", "tsm, its depths moved to the hit's time", "Andersson et al. 2015, 5.1, eq. 12",
                         DepthMapKind::dynamic_bias),
        {.name = "dsm",
         .summary = "a deep shadow map: visibility as a function of depth alone; wrong where receivers move",
         .source = "Lokovic and Veach 2000; Andersson et al. 2015, 2",
         .shadow_stage = "methods/dsm/shadow",
         .fractional = true,
         .parameters = dsm_parameters(),
         .light_cells =
             [](const LightContext& light) {
                 return camera_cells(dsm_sampling(light).spp, light.geometry.segment_count, light.still);
             },
         .make_map = make_deep_shadow_map},
        {.name = "fssm",
         .summary = "layers of a stochastic map, moved along their mean motion and filtered; shares by the variance test",
         .source = "Andersson et al. 2015, 4 and 5",
         .shadow_stage = "methods/fssm/shadow",
         .fractional = true,
         .windowed = false,  // A tile's layers come from a window of texels around it, and lookups go to its neighbours.
         .parameters = fssm_parameters(),
         .light_cells =
             [](const LightContext& light) {
                 return camera_cells(map_sampling(light, DepthMapKind::stochastic).spp, light.geometry.segment_count,
                                     light.still);
             },
         .make_map = [](const LightContext& light, const Bins& bins) { return std::make_unique<Fssm>(light, bins); }},
        depth_map_method("accumulate", "hard shadow maps of many times; a hit is tested against that of the nearest",
                         "Haeberli and Akeley 1990", DepthMapKind::slices),
    };
    return all;
}

const Method& find_method(std::string_view name) {
    std::vector<std::string> known;
    for (const Method& method : methods()) {
        if (method.name == name) return method;
        known.push_back(method.name);
    }
    throw Error(ErrorKind::usage, "no method '" + std::string(name) + "'", "--method", "use one of " + join(known));
}

std::string choose_raster(const Method& method, const std::string& option) {
    if (!method.has_s_buffer()) {
        if (option == "auto") return "";
        throw Error(ErrorKind::usage, "method " + method.name + " has no ranges", "--raster", "leave it out");
    }
    if (option == "auto") return method.rasters.front();
    if (std::find(method.rasters.begin(), method.rasters.end(), option) != method.rasters.end()) return option;
    throw Error(ErrorKind::usage, "method " + method.name + " cannot use the ranges of raster '" + option + "'", "--raster",
                "use auto or " + join(method.rasters));
}

void check_cells(const Method& method, uint32_t cells, uint32_t segments) {
    if (cells == 0) return;
    if (!method.any_cells)
        throw Error(ErrorKind::usage, "the cells of time of method " + method.name + " are its own", "--cells", "leave it out");
    if (cells % segments != 0 || cells > kMostSegments) {
        throw Error(ErrorKind::usage,
                    std::to_string(cells) + " cells of time for " + std::to_string(segments) + " segments of motion", "--cells",
                    "use a multiple of these, at most " + std::to_string(kMostSegments));
    }
}

std::string number_text(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

void check_parameters(const Method& method, const std::map<std::string, double>& parameters) {
    for (const auto& [name, value] : parameters) {
        std::vector<std::string> known;
        const Parameter* found = nullptr;
        for (const Parameter& parameter : method.parameters) {
            if (parameter.name == name) found = &parameter;
            known.push_back("--" + parameter.name);
        }
        if (found == nullptr) {
            throw Error(ErrorKind::usage, "method " + method.name + " has no parameter '" + name + "'", "--" + name,
                        known.empty() ? "it has none" : "it has " + join(known));
        }
        if (!(value >= found->least && value <= found->most) || (found->whole && value != std::floor(value))) {
            throw Error(ErrorKind::usage, name + " is " + number_text(value), "--" + name,
                        std::string("use ") + (found->whole ? "a whole number " : "") + "from " + number_text(found->least) +
                            " to " + number_text(found->most) + " " + found->unit);
        }
    }
}

}  // namespace gnomon
