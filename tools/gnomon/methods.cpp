// SPDX-License-Identifier: Apache-2.0
// `gnomon methods`: the methods, where they are from, and the parameters that each has.
#include "methods/method.hpp"

#include <spdlog/fmt/fmt.h>

#include <iostream>
#include <memory>

#include "command.hpp"

namespace gnomon::cli {

namespace {

/// The document "gnomon.methods".
io::Json methods_json() {
    io::Json json = io::document("methods");
    json["methods"] = io::Json::array();
    for (const Method& method : methods()) {
        io::Json entry = {{"name", method.name},
                          {"summary", method.summary},
                          {"source", method.source},
                          {"rasters", method.rasters},
                          {"parameters", io::Json::array()}};
        for (const Parameter& p : method.parameters) {
            entry["parameters"].push_back({{"name", p.name},
                                           {"unit", p.unit},
                                           {"summary", p.summary},
                                           {"initial", p.initial},
                                           {"least", p.least},
                                           {"most", p.most},
                                           {"whole", p.whole}});
        }
        json["methods"].push_back(std::move(entry));
    }
    return json;
}

void print_methods() {
    for (const Method& method : methods()) {
        std::cout << fmt::format("{}\n    {}\n", method.name, method.summary);
        if (!method.source.empty()) std::cout << fmt::format("    from: {}\n", method.source);
        for (const Parameter& p : method.parameters) {
            std::cout << fmt::format("    --{} {} to {} {} [{}]\n        {}\n", p.name, p.least, p.most, p.unit, p.initial,
                                     p.summary);
        }
    }
}

}  // namespace

void add_methods(CLI::App& app, Invocation& invocation) {
    CLI::App* command = add_command(app, invocation, "methods", "List the methods of --method and their parameters");
    auto json = std::make_shared<std::string>();
    command->add_option("--json", *json, "Write it as JSON; - for stdout, instead of the text")->type_name("FILE.json");
    command->callback([&invocation, json] {
        invocation.run = [json] {
            if (!json->empty()) write_json(*json, methods_json());
            if (*json != "-") print_methods();
            return static_cast<int>(kDone);
        };
    });
}

}  // namespace gnomon::cli
