// SPDX-License-Identifier: Apache-2.0
// What a frame was rendered with and what it cost, as JSON and as the text attributes of an EXR header.
#include "io/report.hpp"

#include <algorithm>
#include <gnomon/version.hpp>

namespace gnomon::io {

Json document(const std::string& kind) {
    return {{"schema", "gnomon." + kind}, {"schema_version", 1}, {"version", GNOMON_VERSION}};
}

Json settings_json(const RenderSettings& settings) {
    Json json = {
        {"width", settings.width},
        {"height", settings.height},
        {"spp", settings.spp},
        {"seed", settings.seed},
        {"camera", settings.camera},
        {"shadow_res", settings.shadow_res},
        {"method", settings.method},
        {"layout", settings.layout},
        {"raster", settings.raster},
        {"pages", settings.pages},
        {"closed_meshes", settings.closed_meshes},
        {"static_once", settings.static_once},
        {"memory_budget", settings.memory_budget},
    };
    if (settings.light_cells > 0) json["light_cells"] = settings.light_cells;
    for (const auto& [name, value] : settings.parameters) {
        std::string key = name;
        std::replace(key.begin(), key.end(), '-', '_');
        json[key] = value;
    }
    return json;
}

Json render_json(const Frame& frame, const Json& settings, const std::vector<std::string>& outputs,
                 const std::vector<std::string>& warnings) {
    const FrameStats& stats = frame.stats;
    Json stages = Json::array();
    for (const FrameStats::Stage& stage : stats.stages)
        stages.push_back({{"name", stage.name},
                          {"seconds", stats.timed ? Json(stage.seconds) : Json()},
                          {"map_seconds", stats.timed ? Json(stage.map_seconds) : Json()},
                          {"dispatches", stage.dispatches}});

    Json json = document("render");
    json["device"] = stats.device;
    json["driver"] = stats.driver;
    json["settings"] = settings;
    json["effective"] = frame.effective;
    json["stages"] = stages;
    json["buffers"] = stats.buffer_bytes;
    json["peak_bytes"] = stats.peak_bytes;
    json["counts"] = stats.counts;
    json["submissions"] = stats.submissions;
    json["longest_dispatch"] = stats.longest_dispatch;
    json["wall_seconds"] = stats.wall_seconds;
    json["outputs"] = outputs;
    json["warnings"] = warnings;
    return json;
}

std::map<std::string, std::string> exr_attributes(const Json& settings, const std::map<std::string, std::string>& effective) {
    std::map<std::string, std::string> attributes;
    for (const auto& [name, value] : settings.items())
        attributes["gnomon:" + name] = value.is_string() ? value.get<std::string>() : to_text(value, -1);
    for (const auto& [name, value] : effective) attributes["gnomon:effective." + name] = value;
    return attributes;
}

std::string to_text(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

}  // namespace gnomon::io
