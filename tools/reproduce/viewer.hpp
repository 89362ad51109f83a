// SPDX-License-Identifier: Apache-2.0
// The pictures of a report: to be flipped, zoomed and compared (page/viewer.js).
#pragma once

#include <string>
#include <vector>

#include "reproduce/figure.hpp"
#include "reproduce/measure.hpp"

namespace gnomon::reproduce {

/// Both references and all runs at a setting, with differences and FLIP.
std::string picture_viewer(const Experiment& experiment, const SettingResult& result);

/// Ranges per texel of light 0 of all runs that have them, on one scale.
std::string heat_map_viewer(const Experiment& experiment, const SettingResult& result);

}  // namespace gnomon::reproduce
