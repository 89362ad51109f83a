// SPDX-License-Identifier: Apache-2.0
// The list of figures.
#include "reproduce/figure.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

namespace gnomon::reproduce {

std::string paper_of(const std::string& figure_name) {
    if (figure_name.starts_with("2015"))
        return "Andersson et al. 2015, Filtered Stochastic Shadow Mapping using a Layered Approach";
    if (figure_name.starts_with("2017"))
        return "Hong and Oh 2017, Efficient motion blurred shadows using a temporal shadow map";
    return "Hong and Oh 2018, Motion-Blurred Shadows Utilizing a Depth-Time Ranges Shadow Map";
}

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all = [] {
        std::vector<Figure> list;
        for (const auto& of_paper : {figures_2015(), figures_2017(), figures_2018()})
            list.insert(list.end(), of_paper.begin(), of_paper.end());
        return list;
    }();
    return all;
}

const Figure& find_figure(const std::string& name) {
    std::string known;
    for (const Figure& figure : figures()) {
        if (figure.name == name) return figure;
        known += (known.empty() ? "" : ", ") + figure.name;
    }
    throw Error(ErrorKind::usage, "there is no figure '" + name + "'", "FIGURE", "use all, or some of " + known);
}

}  // namespace gnomon::reproduce
