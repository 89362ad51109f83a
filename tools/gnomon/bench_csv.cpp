// SPDX-License-Identifier: Apache-2.0
#include <spdlog/fmt/fmt.h>

#include "bench_report.hpp"
#include "text/csv_field.hpp"

namespace gnomon::cli {

std::string bench_csv(const BenchResults& results) {
    std::string text = "scene,layout,again";
    for (const Axis& axis : results.axes) text += "," + axis.name;
    text += ",metric,repetition,milliseconds\n";
    for (const BenchGroup& group : results.groups) {
        std::string axes;
        for (const auto& [name, value] : group.axes) axes += "," + csv_field(value);
        for (const BenchCase& measured : group.cases) {
            for (const std::string& metric : bench_metrics()) {
                const auto found = measured.samples.find(metric);
                if (found == measured.samples.end()) continue;
                for (size_t i = 0; i < found->second.size(); ++i)
                    text += fmt::format("{},{},{}{},{},{},{}\n", csv_field(group.scene), csv_field(measured.layout.name),
                                        measured.layout.again ? 1 : 0, axes, metric, i, found->second[i]);
            }
        }
    }
    return text;
}

}  // namespace gnomon::cli
