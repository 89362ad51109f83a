// SPDX-License-Identifier: Apache-2.0
// `gnomon compare`: how far one image is from another, or the renders of several methods are from a reference.
#include <algorithm>
#include <gnomon/error.hpp>
#include <limits>
#include <memory>

#include "command.hpp"
#include "compare.hpp"
#include "options.hpp"

namespace gnomon::cli {

namespace {

bool is_json(const std::string& path) { return path.ends_with(".json") || path.ends_with(".JSON"); }

/// Options of what is not done are errors.
void refuse(const CLI::App& command, std::initializer_list<const char*> options, const std::string& where_they_belong) {
    for (const char* option : options)
        if (command.count(option) > 0)
            throw Error(ErrorKind::usage, std::string(option) + " is for " + where_they_belong, option, "leave it out");
}

int compare(const CLI::App& command, const CompareOptions& options) {
    if (options.hash) {
        refuse(command,
               {"--again", "--threshold", "--metric", "--exposure", "--diff", "--diff-png", "--flip-png", "--by", "--after",
                "--to"},
               "comparisons, not hashes");
        return compare_hashes(options);
    }
    if (std::any_of(options.files.begin(), options.files.end(), is_json)) {
        refuse(command, {"--again", "--threshold", "--diff", "--diff-png", "--flip-png"}, "two images");
        if (is_json(options.files.back()))
            throw Error(ErrorKind::usage, "the last file is the reference, an image", options.files.back(),
                        "give the JSONs of renders and then their reference, .exr");
        return compare_curves(options);
    }
    refuse(command, {"--by", "--after", "--to"}, "the JSONs of renders");
    warn_if_unused(command, "--metric", "--threshold");
    if (options.files.size() != 2)
        throw Error(ErrorKind::usage, std::string("two images are compared, not ") + std::to_string(options.files.size()),
                    "command line", "give an image and its reference, or the JSONs of renders and their reference");
    return compare_images(options);
}

/// An option whose values are numbers above 0, separated by commas.
CLI::Option* add_numbers(CLI::App& command, const std::string& name, std::vector<double>& numbers, const std::string& type,
                         const std::string& description) {
    const auto parse = [name, &numbers](const std::vector<std::string>& texts) {
        constexpr double kLeast = std::numeric_limits<double>::min(), kMost = std::numeric_limits<double>::max();
        for (const std::string& text : texts) numbers.push_back(parse_number(text, name, kLeast, kMost));
    };
    return command.add_option_function<std::vector<std::string>>(name, parse, description)
        ->type_name(type)
        ->delimiter(',')
        ->allow_extra_args(false);
}

}  // namespace

void add_compare(CLI::App& app, Invocation& invocation) {
    CLI::App* command =
        add_command(app, invocation, "compare",
                    "Say how far image A is from the reference B, channel by channel; or, of several renders of\n"
                    "each method, the error after the same seconds and the seconds to the same error");
    const std::string pair = "Options for two images", renders = "Options for renders";
    auto options = std::make_shared<CompareOptions>();
    command
        ->add_option("FILES", options->files,
                     "A.exr B.exr, or RENDER.json... B.exr with the files of render --json; images for --hash")
        ->required()
        ->type_name("");
    command
        ->add_option("--channels", options->channels, "Only these, separated by commas [all; of renders R, G, B, visibility]")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option(
            "--metric", options->metric,
            "What the threshold is for: rmse, max, psnr, relmse, flip (its mean), ssim; of renders: rmse, relmse, flip")
        ->type_name("NAME")
        ->check(CLI::IsMember({"rmse", "max", "psnr", "relmse", "flip", "ssim"}).description(""))
        ->capture_default_str();
    command
        ->add_option_function<std::string>(
            "--exposure",
            [options](const std::string& text) { options->exposure = parse_number(text, "--exposure", -100.0, 100.0); },
            "Pictures are shown brighter by 2^EV: --diff-png, FLIP and SSIM")
        ->type_name("EV")
        ->default_str("0");
    command->add_flag("--hash", options->hash,
                      "Only a hash of the size, names and bits of the channels of each image, one a line; exit code 8 if they\n"
                      "are not all the same");
    command->add_option("--json", options->json, "Write it as JSON; - for stdout, instead of the table")
        ->type_name("FILE.json");
    command
        ->add_option_function<std::string>(
            "--threshold",
            [options](const std::string& text) {
                options->threshold = parse_number(text, "--threshold", 0.0, std::numeric_limits<double>::max());
            },
            "Exit code 8 if a channel or the picture is above it (for psnr and ssim: below it)")
        ->type_name("VALUE")
        ->group(pair);
    command
        ->add_option("--again", options->again,
                     "A with another seed: tells how much of an error is noise, and its spread over seeds")
        ->type_name("A2.exr")
        ->group(pair);
    command->add_option("--diff", options->diff, "Image of A - B")->type_name("OUT.exr")->group(pair);
    command->add_option("--diff-png", options->diff_png, "Image of |A - B|, sRGB 8 bit")->type_name("OUT.png")->group(pair);
    command->add_option("--flip-png", options->flip_png, "FLIP of each pixel, 0 black, 1 white")
        ->type_name("OUT.png")
        ->group(pair);
    command->add_option("--by", options->by, "Settings that tell methods apart, as in method,layout [method]")
        ->type_name("SETTING,...")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->group(renders);
    add_numbers(*command, "--after", options->after, "SECONDS,...",
                "The errors after these [those of the first method's renders]")
        ->group(renders);
    add_numbers(*command, "--to", options->to, "ERROR,...", "The seconds to these [those of the first method's renders]")
        ->group(renders);
    command->callback(
        [&invocation, command, options] { invocation.run = [command, options] { return compare(*command, *options); }; });
}

}  // namespace gnomon::cli
