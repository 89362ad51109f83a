// SPDX-License-Identifier: Apache-2.0
// What a frame was rendered with and what it cost, as JSON and as the text attributes of an EXR header.
#pragma once

#include <gnomon/render.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gnomon::io {

using Json = nlohmann::ordered_json;

/// The start of every JSON document of gnomon: "schema": "gnomon.<kind>", "schema_version": 1, "version": gnomon's own. Fields
/// may be added under the same schema version; what a field means changes only with it.
Json document(const std::string& kind);

/// What a picture depends on, by member name; the image's size is "width" and "height".
Json settings_json(const RenderSettings& settings);

/// The document "gnomon.render" of one frame:
///   device        string
///   driver        string, its name and version
///   settings      object, as given
///   effective     {name: string}, what was really used where the settings leave a choice
///   stages        [{name, seconds, map_seconds, dispatches}], seconds on the device, and those of them that went into what the
///                 lights' shadow tests read; in the order in which the stages ran first; null where the device does not tell
///   buffers       {name: bytes}, the largest size of each
///   peak_bytes    most device memory at one time
///   counts        {name: number}: triangles, prisms, ranges, samples, hits, shadow_tests, ...; what was not counted is not
///                 there: camera_tests, ranges_visited and ranges_tested without RenderSettings::count_ranges
///   submissions   of work to the device, and the seconds of the
///   longest_dispatch  that ran as one
///   wall_seconds  on the host, for the frame without reading the scene and writing files
///   outputs       [path], the image files of the frame
///   warnings      [string], one line each
Json render_json(const Frame& frame, const Json& settings, const std::vector<std::string>& outputs,
                 const std::vector<std::string>& warnings);

/// The settings as text attributes: "gnomon:<name>" for each member, numbers in the fewest digits that give them back; and
/// "gnomon:effective.<name>" for each of Frame::effective.
std::map<std::string, std::string> exr_attributes(const Json& settings, const std::map<std::string, std::string>& effective);

/// A JSON document as text; indent -1: on one line. Bytes that are not UTF-8 (they come from file names) become U+FFFD; numbers
/// that are not finite become null.
std::string to_text(const Json& json, int indent = 2);

}  // namespace gnomon::io
