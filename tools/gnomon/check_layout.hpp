// SPDX-License-Identifier: Apache-2.0
// Does a layout hold what was put into it?
#pragma once

#include <functional>
#include <gnomon/render.hpp>
#include <string>

namespace gnomon::cli {

struct LayoutCheck {
    std::string name;  ///< What was tried: a method, lights, memory.
    bool passed = false;
    std::string text;  ///< What was compared, or what is wrong, and where.
};

/// Render the scene of the check (check_scene.hpp) with the layout and with `array`, by each method that the layout serves,
/// with each kind of light, in bands and by pages, and compare all ranges of all texels and the pictures. What the layout does
/// not initialise is poisoned, and its accesses are checked. `done` is called for each, and says whether to go on. Errors: as
/// of find_layout and Renderer::render.
void check_layout(Renderer& renderer, const std::string& name_or_folder, const std::function<bool(const LayoutCheck&)>& done);

}  // namespace gnomon::cli
