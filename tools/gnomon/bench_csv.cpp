// SPDX-License-Identifier: Apache-2.0
#include <spdlog/fmt/fmt.h>

#include "bench_report.hpp"

namespace gnomon::cli {

namespace {

// As RFC 4180 has it.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

std::string bench_csv(const BenchResults& results) {
    std::string text = "scene,layout,again";
    for (const Axis& axis : results.axes) text += "," + axis.name;
    text += ",metric,repetition,milliseconds\n";
    for (const BenchGroup& group : results.groups) {
        std::string axes;
        for (const auto& [name, value] : group.axes) axes += "," + field(value);
        for (const BenchCase& measured : group.cases) {
            for (const std::string& metric : bench_metrics()) {
                const auto found = measured.samples.find(metric);
                if (found == measured.samples.end()) continue;
                for (size_t i = 0; i < found->second.size(); ++i)
                    text += fmt::format("{},{},{}{},{},{},{}\n", field(group.scene), field(measured.layout.name),
                                        measured.layout.again ? 1 : 0, axes, metric, i, found->second[i]);
            }
        }
    }
    return text;
}

}  // namespace gnomon::cli
