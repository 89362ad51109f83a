// SPDX-License-Identifier: Apache-2.0
// Methods: named ways to answer "does the light reach this hit?". They share everything but the light's side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon {

struct Method {
    /// How many cells of time a light's S-buffer has.
    enum class LightCells {
        segments,  ///< One per segment: a range lasts as long as its triangle stays.
        finer,     ///< Whatever is fast: ranges may be cut where a cell ends.
    };

    std::string name;
    std::string summary;
    std::string source;                ///< Paper and section.
    std::vector<std::string> rasters;  ///< Stages raster/<name> whose ranges the test understands; the first is the default.
    std::string shadow_stage;          ///< The test, compiled for each layout.
    LightCells light_cells = LightCells::finer;
    uint32_t ranges_per_prism = 1;  ///< Most that one prism has in one list.
    bool exit_depth = false;        ///< A range has a depth at its exit.
};

/// All methods, the default first.
const std::vector<Method>& methods();

/// Errors: ErrorKind::usage, naming those that exist.
const Method& find_method(const std::string& name);

/// The stage raster/<name> that `option` ("auto" or a name) asks for. Errors: ErrorKind::usage, naming what the method can use.
std::string choose_raster(const Method& method, const std::string& option);

}  // namespace gnomon
