// SPDX-License-Identifier: Apache-2.0
// What the subcommands share: how they are registered, what they return, where their results go.
#include "command.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <iostream>
#include <memory>

#include "io/atomic_file.hpp"
#include "text/printable.hpp"

namespace gnomon::cli {

namespace {

/// A message's text: what libraries put into it and names from files are one line, whatever they hold.
class PrintableText : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& to) override {
        const std::string text = printable({message.payload.data(), message.payload.size()});
        to.append(text.data(), text.data() + text.size());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<PrintableText>(); }
};

}  // namespace

CLI::App* add_command(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& description) {
    CLI::App* command = app.add_subcommand(name, description);
    CLI::Option* quiet = command->add_flag("--quiet", invocation.quiet, "Only errors on stderr");
    command->add_flag("--verbose", invocation.verbose, "More on stderr")->excludes(quiet);
    return command;
}

void warn_if_unused(const CLI::App& command, const std::string& option, const std::string& needed) {
    if (command.count(option) > 0 && command.count(needed) == 0) spdlog::warn("{} has no effect without {}", option, needed);
}

void start_log() {
    const char* no_color = std::getenv("NO_COLOR");
    const bool plain = no_color != nullptr && *no_color != '\0';
    auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(plain ? spdlog::color_mode::never
                                                                            : spdlog::color_mode::automatic);
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("gnomon", sink));
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<PrintableText>('*').set_pattern("gnomon: %^%l%$: %*");
    spdlog::set_formatter(std::move(formatter));
}

void log_device(const DeviceDescription& device, bool was_named) {
    if (device.type == "cpu" && !was_named) {
        spdlog::warn("no hardware device: rendering on the CPU, with {}", device.name);
    } else {
        spdlog::debug("device: {} ({}), {}", device.name, device.type, device.driver);
    }
}

void write_json(const std::string& target, const io::Json& json, int indent) {
    const std::string text = io::to_text(json, indent) + "\n";
    if (target == "-") {
        std::cout << text;
    } else {
        io::write_file(target, text);
    }
}

void print_line(const std::string& text) { std::cout << printable(text) << '\n'; }

void print_row(const std::string& label, const std::string& value) { print_line(fmt::format("{:<16} {}", label, value)); }

}  // namespace gnomon::cli
