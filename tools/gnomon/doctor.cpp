// SPDX-License-Identifier: Apache-2.0
// `gnomon doctor`: does the device work, and compute what is right?
#include <spdlog/spdlog.h>

#include <gnomon/error.hpp>
#include <iostream>
#include <memory>

#include "command.hpp"
#include "gpu/gpu.hpp"
#include "known_picture.hpp"
#include "stages/scan.hpp"

namespace gnomon::cli {

namespace {

struct DoctorOptions {
    std::string device;
    std::string layout = "auto";
    std::string json;
};

struct Outcome {
    std::string text;
    int exit_code = kDone;
};

struct Check {
    std::string name;
    Outcome outcome;
};

constexpr const char* kWrong = "; the driver computes wrongly: update it, or choose another --device";

Outcome check_loader() {
    const size_t count = list_devices().size();
    const std::vector<std::string> errors = loader_errors();
    const std::string reason = errors.empty() ? "" : fmt::format("; the Vulkan loader says: {}", fmt::join(errors, ", "));
    if (count == 0)
        return {"no Vulkan device" + reason + "; install a Vulkan driver, or repair what the loader names",
                static_cast<int>(ErrorKind::no_device)};
    return {fmt::format("{} Vulkan device{}{}", count, count == 1 ? "" : "s", reason)};
}

Outcome check_limits(const DeviceDescription& device) {
    std::string text;
    for (const auto& [name, value] : device.limits) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
    return {text};
}

/// Prefix sums of 0, 1, 2, ...: i (i - 1) / 2. They read what they wrote, through both kinds of buffers, and use shuffles.
Outcome check_sums(gpu::Device& device) {
    constexpr uint32_t kCount = 90'001;  // The total has 32 bits.
    std::vector<uint32_t> values(scan_bytes(kCount) / sizeof(uint32_t));
    for (uint32_t i = 0; i < kCount; ++i) values[i] = i;
    Programs programs(device);
    const gpu::Buffer buffer = gpu::upload_new(device, "values", values);
    const gpu::Buffer sums = device.allocate("sums", scan_bytes(kCount));
    record_scan(device, programs, buffer, kCount, sums);
    const std::vector<uint32_t> found = gpu::download_vector<uint32_t>(device, sums, kCount + 1);
    for (uint64_t i = 0; i <= kCount; ++i) {
        const uint64_t expected = i == 0 ? 0 : i * (i - 1) / 2;
        if (found[i] != expected)
            return {fmt::format("the sum of the first {} numbers is {}, and should be {}", i, found[i], expected) + kWrong,
                    kWrongResult};
    }
    return {fmt::format("{} prefix sums are right", kCount + 1)};
}

Outcome check_picture(const DoctorOptions& options) {
    constexpr double kMost = 5.0;
    KnownPicture picture;
    picture.settings.layout = options.layout;
    Renderer renderer(options.device);
    const WorstMean worst = worst_mean(renderer.render(picture.scene, picture.poses, picture.settings));
    const std::string text = fmt::format(
        "the mean of {} over pixels {}, {} to {}, {} is {:.6g}, expected is {:.6g}: {:.2g} standard errors", worst.channel,
        worst.left, worst.top, worst.right - 1, worst.bottom - 1, worst.value, worst.expected, worst.standard_errors);
    if (worst.standard_errors > kMost) return {text + kWrong, kWrongResult};
    return {"all means are right; at worst " + text};
}

/// Runs checks in turn, up to the first that fails, and prints a line for each.
class Doctor {
public:
    explicit Doctor(bool prints) : prints_(prints) {}

    template <class Run>
    void check(const std::string& name, Run run) {
        if (exit_code() != kDone) return;
        if (prints_) std::cout << fmt::format("{:<9} ", name) << std::flush;  // A driver may crash.
        Outcome outcome;
        try {
            outcome = run();
        } catch (const Error& error) {
            outcome = {error.what(), error.exit_code()};
        }
        const bool passed = outcome.exit_code == kDone;
        if (prints_) print_line(fmt::format("{:<7} {}", passed ? "ok" : "failed", outcome.text));
        if (!passed) spdlog::error("{} failed: {}", name, outcome.text);
        checks_.push_back({name, std::move(outcome)});
    }

    int exit_code() const { return checks_.empty() ? kDone : checks_.back().outcome.exit_code; }

    /// The document "gnomon.doctor": checks in the order in which they ran, up to the first that failed.
    io::Json json() const {
        io::Json json = io::document("doctor");
        json["checks"] = io::Json::array();
        for (const Check& check : checks_)
            json["checks"].push_back(
                {{"name", check.name}, {"passed", check.outcome.exit_code == kDone}, {"text", check.outcome.text}});
        json["passed"] = exit_code() == kDone;
        json["exit_code"] = exit_code();
        return json;
    }

private:
    bool prints_;
    std::vector<Check> checks_;
};

int run_doctor(const DoctorOptions& options) {
    Doctor doctor(options.json != "-");
    std::unique_ptr<gpu::Device> device;
    doctor.check("loader", check_loader);
    doctor.check("features", [&]() -> Outcome {
        device = std::make_unique<gpu::Device>(options.device, false);
        return {fmt::format("{} ({}) has all that gnomon needs", device->description().name, device->description().type)};
    });
    doctor.check("driver", [&]() -> Outcome {
        const DeviceDescription& used = device->description();
        return {fmt::format("{}, Vulkan {}; {} known faults, see gnomon devices", used.driver, used.vulkan,
                            used.faults.empty() ? "no" : std::to_string(used.faults.size()))};
    });
    doctor.check("limits", [&] { return check_limits(device->description()); });
    doctor.check("sums", [&] { return check_sums(*device); });
    device.reset();
    doctor.check("picture", [&] { return check_picture(options); });
    if (!options.json.empty()) write_json(options.json, doctor.json());
    return doctor.exit_code();
}

}  // namespace

void add_doctor(CLI::App& app, Invocation& invocation) {
    CLI::App* command = add_command(app, invocation, "doctor",
                                    "Try whether a device works and computes what is right, in seconds; exit code 0 if so, 4\n"
                                    "if there is no usable one, 9 if a result is wrong, and others as of any command");
    auto options = std::make_shared<DoctorOptions>();
    command->add_option("--device", options->device, "Which Vulkan device [the first hardware device, else a CPU]")
        ->type_name("NAME|INDEX|cpu|gpu");
    command->add_option("--layout", options->layout, "S-buffer layout for the picture")
        ->type_name("NAME|FOLDER")
        ->capture_default_str();
    command->add_option("--json", options->json, "Write it as JSON; - for stdout, instead of the text")->type_name("FILE.json");
    command->callback([&invocation, options] { invocation.run = [options] { return run_doctor(*options); }; });
}

}  // namespace gnomon::cli
