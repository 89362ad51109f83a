// SPDX-License-Identifier: Apache-2.0
#include "methods/method.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

namespace gnomon {
namespace {

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}  // namespace

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        {.name = "exact",
         .summary = "conservative ranges; their triangles are tested at the hit's own place and time",
         .source = "",
         .rasters = {"conservative"},
         .shadow_stage = "sample/shadow"},
        {.name = "dtr-analytic",
         .summary = "ranges at the texels' centres; depth is linear between entry and exit",
         .source = "Hong and Oh 2018, 3.3, with analytic ranges",
         .rasters = {"analytic"},
         .shadow_stage = "methods/dtr_analytic/shadow",
         .light_cells = Method::LightCells::segments,
         .ranges_per_prism = 4,
         .exit_depth = true},
    };
    return all;
}

const Method& find_method(const std::string& name) {
    std::vector<std::string> known;
    for (const Method& method : methods()) {
        if (method.name == name) return method;
        known.push_back(method.name);
    }
    throw Error(ErrorKind::usage, "no method '" + name + "'", "--method", "use one of " + join(known));
}

std::string choose_raster(const Method& method, const std::string& option) {
    if (option == "auto") return method.rasters.front();
    if (std::find(method.rasters.begin(), method.rasters.end(), option) != method.rasters.end()) return option;
    throw Error(ErrorKind::usage, "method " + method.name + " cannot use the ranges of raster '" + option + "'", "--raster",
                "use auto or " + join(method.rasters));
}

}  // namespace gnomon
