// SPDX-License-Identifier: Apache-2.0
// `gnomon devices`: the Vulkan devices of this machine, and which one would be used.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <gnomon/error.hpp>
#include <gnomon/render.hpp>
#include <memory>

#include "command.hpp"

namespace gnomon::cli {

namespace {

/// The document "gnomon.devices".
io::Json devices_json(const std::vector<DeviceDescription>& devices, const std::vector<std::string>& errors) {
    io::Json json = io::document("devices");
    json["loader_errors"] = errors;
    json["devices"] = io::Json::array();
    for (const DeviceDescription& device : devices) {
        io::Json limits = io::Json::object();
        for (const auto& [name, value] : device.limits) limits[name] = value;
        json["devices"].push_back({{"index", device.index},
                                   {"name", device.name},
                                   {"type", device.type},
                                   {"driver", device.driver},
                                   {"driver_name", device.driver_name},
                                   {"driver_version", device.driver_version},
                                   {"vulkan", device.vulkan},
                                   {"heap_bytes", device.heap_bytes},
                                   {"limits", limits},
                                   {"faults", device.faults},
                                   {"missing", device.missing},
                                   {"usable", device.missing.empty()},
                                   {"chosen", device.chosen}});
    }
    return json;
}

void print_devices(const std::vector<DeviceDescription>& devices) {
    for (const DeviceDescription& device : devices) {
        const double gibibytes = static_cast<double>(device.heap_bytes) / (1024.0 * 1024.0 * 1024.0);
        print_line(fmt::format("{} {:>2}  {}  ({}, {:.1f} GiB)  {}", device.chosen ? '*' : ' ', device.index, device.name,
                               device.type, gibibytes, device.driver));
        if (!device.missing.empty()) print_line(fmt::format("      not usable: lacks {}", fmt::join(device.missing, ", ")));
        print_line(fmt::format("      Vulkan {}", device.vulkan));
        for (const auto& [name, value] : device.limits) print_line(fmt::format("      {:<26} {:>12}", name, value));
        for (const std::string& fault : device.faults) print_line("      known fault: " + fault);
    }
    if (std::any_of(devices.begin(), devices.end(), [](const DeviceDescription& device) { return device.chosen; }))
        print_line("* would be used");
}

}  // namespace

void add_devices(CLI::App& app, Invocation& invocation) {
    CLI::App* command = add_command(app, invocation, "devices", "List the Vulkan devices, and which one would be used");
    auto json = std::make_shared<std::string>();
    command->add_option("--json", *json, "Write it as JSON; - for stdout, instead of the text")->type_name("FILE.json");
    command->callback([&invocation, json] {
        invocation.run = [json] {
            const std::vector<DeviceDescription> devices = list_devices();
            const std::vector<std::string> errors = loader_errors();
            for (const std::string& error : errors) spdlog::warn("the Vulkan loader: {}", error);
            if (!json->empty()) write_json(*json, devices_json(devices, errors));
            if (*json != "-") print_devices(devices);
            if (std::none_of(devices.begin(), devices.end(), [](const DeviceDescription& d) { return d.missing.empty(); }))
                throw Error(
                    ErrorKind::no_device, "no usable Vulkan device", fmt::format("{} found", devices.size()),
                    "repair what the loader names, or install a Vulkan 1.3 driver, such as Mesa's lavapipe for the CPU");
            return static_cast<int>(kDone);
        };
    });
}

}  // namespace gnomon::cli
