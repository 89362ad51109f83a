// SPDX-License-Identifier: Apache-2.0
// Methods: named ways to answer "does the light reach this hit?". They share everything but the light's side.
#pragma once

#include <functional>
#include <gnomon/render.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "layouts/layout.hpp"
#include "stages/pages.hpp"
#include "stages/shadow_map.hpp"
#include "views/view.hpp"

namespace gnomon {

/// A number that a method can be given: RenderSettings::parameters[name].
struct Parameter {
    std::string name;
    std::string unit;
    std::string summary;
    std::string initial;  ///< What is taken when it is not given.
    double least = 0.0;
    double most = 0.0;
    bool whole = false;  ///< Only whole numbers.
};

class LayoutWatch;
struct Method;

/// A face of a light of a frame, for its shadow map to be made.
struct LightContext {
    gpu::Device& device;
    Programs& programs;
    const Geometry& geometry;
    const RenderSettings& settings;
    const Method& method;
    const View& view;  ///< The face's.
    uint32_t light_ix = 0;
    bool still = false;  ///< Nothing moves.
    uint64_t bytes = 0;  ///< Its share of the memory budget.
    Layout layout;       ///< Of the S-buffer, where the method has one; likewise the stage that finds its ranges.
    std::string raster;
    LayoutWatch* watch = nullptr;  ///< Of a layout that is watched.
    const View* camera = nullptr;  ///< The camera's view.
    const Pages* asked = nullptr;  ///< The pages of the S-buffer, where not all are made.

    std::optional<double> parameter(const std::string& name) const;
};

struct Method {
    std::string name;
    std::string summary;
    std::string source;  ///< Paper and section.
    /// Stages raster/<name> whose ranges the test understands, the default first; none: no S-buffer.
    std::vector<std::string> rasters = {};
    std::string shadow_stage;      ///< The test; compiled for each layout where there is an S-buffer.
    std::string layout = "array";  ///< Of the S-buffer, where the settings leave it open.
    bool exit_depth = false;       ///< A range has a depth at its exit.
    bool fractional = false;       ///< Visibility is a share of the light, not a bit.
    bool windowed = true;          ///< Its map can be made for a part of the light's view alone.
    bool any_texels = false;       ///< Its picture does not depend on the texels' size: pages may be split.
    bool any_cells = false;        ///< Nor on the cells of time: ranges may be cut where one ends.
    bool one_sided = false;        ///< Of closed shells it needs only the faces that look away from the light.
    std::vector<Parameter> parameters = {};

    /// In how many cells of time the light's prisms are listed.
    std::function<uint32_t(const LightContext&)> light_cells;
    /// Of the window that the bins hold. The context and the bins outlive the map.
    std::function<std::unique_ptr<ShadowMap>(const LightContext&, const Bins&)> make_map;

    bool has_s_buffer() const { return !rasters.empty(); }
    /// It has an S-buffer, and this layout gives it what it asks of ranges.
    bool takes(const Layout& layout_of_it) const { return has_s_buffer() && !(exit_depth && layout_of_it.only_contains()); }
};

/// All methods, the default first.
const std::vector<Method>& methods();

/// Errors: ErrorKind::usage, naming those that exist.
const Method& find_method(std::string_view name);

/// The stage raster/<name> that `option` ("auto" or a name) asks for. Errors: ErrorKind::usage, naming what the method can use.
std::string choose_raster(const Method& method, const std::string& option);

/// Errors: ErrorKind::usage, where so many cells of time are not 0 and cannot be those of the method's S-buffer.
void check_cells(const Method& method, uint32_t cells, uint32_t segments);

/// As text, with six significant digits.
std::string number_text(double value);

/// Errors: ErrorKind::usage, for a parameter that the method does not have, or out of its range.
void check_parameters(const Method& method, const std::map<std::string, double>& parameters);

}  // namespace gnomon
