// SPDX-License-Identifier: Apache-2.0
// The values of options, from text.
#include "options.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <gnomon/error.hpp>
#include <limits>
#include <string_view>
#include <system_error>

namespace gnomon::cli {

namespace {

constexpr uint32_t kMaxSide_px = 16384;
constexpr uint32_t kMostFrames = 100'000;  // Over an hour; their files are all checked before the first is rendered.

/// The whole of the text as a number, in the C locale whatever the user's.
template <class T>
std::optional<T> number_from(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

[[noreturn]] void throw_usage(const std::string& what, const std::string& option, const std::string& hint) {
    throw Error(ErrorKind::usage, what, option, hint);
}

/// What stands before and after the first separator; both empty where there is none.
std::pair<std::string_view, std::string_view> split(std::string_view text, char separator) {
    const size_t at = text.find(separator);
    if (at == std::string_view::npos) return {};
    return {text.substr(0, at), text.substr(at + 1)};
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

/// What one of a unit is in bytes; 0 where it is no unit.
double unit_bytes(const std::string& text) {
    const std::string unit = upper(text);
    if (unit.empty() || unit == "B") return 1.0;
    const size_t power = std::string_view("KMGT").find(unit[0]);
    if (power == std::string_view::npos) return 0.0;
    const std::string_view rest = std::string_view(unit).substr(1);
    if (rest.empty() || rest == "IB") return std::exp2(10.0 * static_cast<double>(power + 1));
    return rest == "B" ? std::pow(1000.0, static_cast<double>(power + 1)) : 0.0;
}

}  // namespace

uint32_t parse_count(const std::string& text, const std::string& option, uint32_t min, uint32_t max) {
    const auto value = number_from<uint32_t>(text);
    if (!value || *value < min || *value > max)
        throw_usage(fmt::format("'{}' is not a whole number from {} to {}", text, min, max), option, "give one in this range");
    return *value;
}

double parse_number(const std::string& text, const std::string& option, double min, double max) {
    const auto value = number_from<double>(text);
    if (!value || !std::isfinite(*value))
        throw_usage(fmt::format("'{}' is not a number", text), option, "give a finite number");
    if (*value < min || *value > max)
        throw_usage(fmt::format("{} is not from {} to {}", text, min, max), option, "give a number in this range");
    return *value;
}

Size parse_size(const std::string& text, const std::string& option) {
    const auto [width_text, height_text] = split(text, 'x');
    const auto width = number_from<uint32_t>(width_text);
    const auto height = number_from<uint32_t>(height_text);
    const auto is_side = [](const std::optional<uint32_t>& side) { return side && *side >= 1 && *side <= kMaxSide_px; };
    if (!is_side(width) || !is_side(height))
        throw_usage(fmt::format("'{}' is not a size", text), option,
                    fmt::format("give WIDTHxHEIGHT, each 1 to {} pixels, as in 1280x720", kMaxSide_px));
    return {*width, *height};
}

Shutter parse_shutter(const std::string& text, const std::string& option) {
    const auto [open_text, close_text] = split(text, ':');
    const auto open = number_from<double>(open_text);
    const auto close = number_from<double>(close_text);
    if (!open || !close || !std::isfinite(*open) || !std::isfinite(*close))
        throw_usage(fmt::format("'{}' is not a shutter", text), option, "give OPEN:CLOSE in seconds, as in 0:0.02");
    if (*close < *open)
        throw_usage(fmt::format("the shutter closes before it opens, at {} before {}", close_text, open_text), option,
                    "give OPEN:CLOSE with CLOSE at or after OPEN");
    return {*open, *close};
}

FrameRange parse_frames(const std::string& text, const std::string& option) {
    const auto [first_text, last_text] = split(text, '-');
    const auto first = number_from<uint32_t>(first_text);
    const auto last = number_from<uint32_t>(last_text);
    if (!first || !last || *last < *first)
        throw_usage(fmt::format("'{}' is not a range of frames", text), option, "give FIRST-LAST, both included, as in 0-47");
    if (*last - *first >= kMostFrames)
        throw_usage(fmt::format("{} frames are more than {}", uint64_t{*last} - *first + 1, kMostFrames), option,
                    "render them in parts");
    return {*first, *last};
}

uint64_t parse_bytes(const std::string& text, const std::string& option) {
    const size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
    const auto value = number_from<double>(std::string_view(text).substr(0, digits));
    const double bytes = value ? std::floor(*value * unit_bytes(text.substr(digits))) : 0.0;
    if (!(bytes >= 1.0) || bytes >= std::exp2(63.0))
        throw_usage(fmt::format("'{}' is not an amount of memory", text), option,
                    "give bytes, or a number with K, M, G or T, as in 512M or 1.5GiB");
    return static_cast<uint64_t>(bytes);
}

std::optional<float> parse_ground(const std::string& text, const std::string& option) {
    if (text == "auto") return std::nullopt;
    const auto height = number_from<float>(text);
    if (!height || !std::isfinite(*height))
        throw_usage(fmt::format("'{}' is not a height", text), option, "give auto, or a height in metres");
    return height;
}

void check_ending(const std::filesystem::path& path, const std::string& ending, const std::string& option) {
    if (upper(path.extension().string()) != upper(ending))
        throw_usage(fmt::format("the file name '{}' does not end in {}", path.string(), ending), option,
                    "give a name that does");
}

std::filesystem::path numbered_path(const std::filesystem::path& path, uint32_t number, const std::string& option) {
    const std::string name = path.filename().string();
    const size_t begin = name.find('#');
    const size_t end = std::min(name.find_first_not_of('#', std::min(begin, name.size())), name.size());
    if (begin == std::string::npos || name.find('#', end) != std::string::npos)
        throw_usage(fmt::format("the file name '{}' does not say where the number of the frame goes", name), option,
                    "put #### into it once, as in frame_####.exr");
    return path.parent_path() / (name.substr(0, begin) + fmt::format("{:0{}}", number, end - begin) + name.substr(end));
}

std::filesystem::path light_path(const std::filesystem::path& path, size_t light, size_t light_count) {
    if (light_count == 1) return path;
    std::filesystem::path result = path;
    return result.replace_extension(".light" + std::to_string(light) + path.extension().string());
}

uint32_t choose_camera(const Scene& scene, const std::string& text) {
    const std::string option = "--camera";
    if (scene.cameras.empty())
        throw_usage(fmt::format("there is no camera '{}'", text), option, "leave the option out: the scene has no cameras");
    const auto has_name = [&](const Camera& camera) { return camera.name == text; };
    const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(), has_name);
    if (named != scene.cameras.end()) {
        if (std::find_if(named + 1, scene.cameras.end(), has_name) != scene.cameras.end())
            throw_usage(fmt::format("several cameras have the name '{}'", text), option, "give an index (see gnomon info)");
        return static_cast<uint32_t>(named - scene.cameras.begin());
    }
    const auto index = number_from<uint32_t>(text);
    if (index && *index < scene.cameras.size()) return *index;
    std::string known;
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        known += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, scene.cameras[i].name);
    throw_usage(fmt::format("there is no camera '{}'", text), option, "the scene has " + known);
}

}  // namespace gnomon::cli
