// SPDX-License-Identifier: Apache-2.0
// Which measurements belong together.
#include "report/settings.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace gnomon::report {
namespace {

constexpr size_t kNoAxis = ~size_t{0};

std::string title_of(const BenchFile& file, const std::string& scene, const std::vector<std::string>& values, size_t without) {
    std::string title = scene;
    for (size_t i = 0; i < file.axes.size(); ++i)
        if (i != without && file.axes[i].values.size() > 1) title += fmt::format(", {} {}", file.axes[i].name, values[i]);
    return title;
}

}  // namespace

std::string Setting::title() const { return title_of(*file, scene, values, kNoAxis); }
std::string Sweep::title() const { return title_of(*file, scene, values, axis); }

std::vector<Setting> settings_of(const BenchFile& file) {
    std::vector<Setting> settings;
    for (const Case& c : file.cases) {
        auto found = std::find_if(settings.begin(), settings.end(),
                                  [&](const Setting& s) { return s.scene == c.scene && s.values == c.values; });
        if (found == settings.end()) {
            const bool is_first =
                std::none_of(settings.begin(), settings.end(), [&](const Setting& s) { return s.scene == c.scene; });
            found = settings.insert(settings.end(), {&file, c.scene, c.values, {}, is_first});
        }
        found->cases.push_back(&c);
    }
    return settings;
}

std::vector<Sweep> sweeps_of(const BenchFile& file) {
    std::vector<Sweep> sweeps;
    for (size_t axis = 0; axis < file.axes.size(); ++axis) {
        const std::vector<std::string>& along = file.axes[axis].values;
        if (along.size() < 2) continue;
        const auto first = static_cast<std::ptrdiff_t>(sweeps.size());
        for (const Case& c : file.cases) {
            if (c.again) continue;
            const auto place = std::find(along.begin(), along.end(), c.values[axis]);
            if (place == along.end()) continue;
            std::vector<std::string> values = c.values;
            values[axis].clear();
            auto found = std::find_if(sweeps.begin() + first, sweeps.end(),
                                      [&](const Sweep& s) { return s.scene == c.scene && s.values == values; });
            if (found == sweeps.end()) found = sweeps.insert(sweeps.end(), {&file, axis, c.scene, values, {}, false});
            std::vector<const Case*>& cases = found->layouts[c.layout];
            cases.resize(along.size());
            cases[static_cast<size_t>(place - along.begin())] = &c;
        }
    }
    std::erase_if(sweeps, [](const Sweep& sweep) {
        return std::none_of(sweep.layouts.begin(), sweep.layouts.end(), [](const auto& layout) {
            return layout.second.size() - std::count(layout.second.begin(), layout.second.end(), nullptr) > 1;
        });
    });
    for (auto sweep = sweeps.begin(); sweep != sweeps.end(); ++sweep)
        sweep->is_first = std::none_of(sweeps.begin(), sweep,
                                       [&](const Sweep& s) { return s.scene == sweep->scene && s.axis == sweep->axis; });
    return sweeps;
}

std::vector<double> numbers_of(const std::vector<std::string>& values) {
    std::vector<double> numbers;
    for (const std::string& text : values) {
        double number = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        const bool is_number =
            error == std::errc() && end == text.data() + text.size() && std::isfinite(number) && number > 0.0;
        if (!is_number || (!numbers.empty() && number <= numbers.back())) return {};
        numbers.push_back(number);
    }
    return numbers;
}

std::vector<size_t> pareto_front(const std::vector<Cost>& costs) {
    std::vector<size_t> order(costs.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return std::pair(costs[a].bytes, costs[a].ms) < std::pair(costs[b].bytes, costs[b].ms);
    });
    std::vector<size_t> front;
    for (const size_t i : order) {
        const bool equal =
            !front.empty() && costs[front.back()].bytes == costs[i].bytes && costs[front.back()].ms == costs[i].ms;
        if (front.empty() || equal || costs[i].ms < costs[front.back()].ms) front.push_back(i);
    }
    return front;
}

std::vector<const Case*> cases_with_bytes(const Setting& setting) {
    std::vector<const Case*> cases;
    for (const Case* c : setting.cases)
        if (!c->again && c->count("map_bytes")) cases.push_back(c);
    return cases;
}

std::set<const Case*> front_of(const std::vector<const Case*>& cases) {
    std::vector<const Case*> whole;
    std::vector<Cost> costs;
    for (const Case* c : cases) {
        if (answers_less(*c)) continue;
        whole.push_back(c);
        costs.push_back({*c->count("map_bytes"), c->stage("query")->median});
    }
    std::set<const Case*> front;
    for (const size_t i : pareto_front(costs)) front.insert(whole[i]);
    return front;
}

std::vector<std::string> layouts_of(const std::vector<BenchFile>& files) {
    std::vector<std::string> layouts;
    for (const BenchFile& file : files)
        for (const Case& c : file.cases)
            if (std::find(layouts.begin(), layouts.end(), c.layout) == layouts.end()) layouts.push_back(c.layout);
    return layouts;
}

bool answers_less(const Case& c) {
    return c.layout == kNullLayout || c.count("lost").value_or(0.0) > 0.0 || !c.same_picture.value_or(true);
}

}  // namespace gnomon::report
