// SPDX-License-Identifier: Apache-2.0
// The values of options, from text. Every function names the option in its error, which is of ErrorKind::usage.
#pragma once

#include <cstdint>
#include <filesystem>
#include <gnomon/scene.hpp>
#include <optional>
#include <string>

namespace gnomon::cli {

struct Size {
    uint32_t width = 0;
    uint32_t height = 0;
};

/// Seconds on the animation clock.
struct Shutter {
    double open = 0.0;
    double close = 0.0;
};

/// Numbers of frames, both included.
struct FrameRange {
    uint32_t first = 0;
    uint32_t last = 0;
};

/// A whole number in decimal digits, min to max.
uint32_t parse_count(const std::string& text, const std::string& option, uint32_t min, uint32_t max);

/// A finite number, min to max.
double parse_number(const std::string& text, const std::string& option, double min, double max);

/// "1280x720", pixels, each side 1 to 16384.
Size parse_size(const std::string& text, const std::string& option);

/// "OPEN:CLOSE", finite, not closing before it opens.
Shutter parse_shutter(const std::string& text, const std::string& option);

/// "A-B", A not above B.
FrameRange parse_frames(const std::string& text, const std::string& option);

/// "512M", "1.5GiB", "2000000": K M G T and KiB to TiB are powers of 1024, KB MB GB TB of 1000; upper or lower case.
uint64_t parse_bytes(const std::string& text, const std::string& option);

/// Height of the ground in metres; none for "auto", which puts it below the scene.
std::optional<float> parse_ground(const std::string& text, const std::string& option);

/// Throws where the file name does not end in `ending` (".exr"), in upper or lower case.
void check_ending(const std::filesystem::path& path, const std::string& ending, const std::string& option);

/// The path with the run of # in its file name replaced by the number, padded with zeros to the length of the run.
/// Errors: the file name has no such run, or has several.
std::filesystem::path numbered_path(const std::filesystem::path& path, uint32_t number, const std::string& option);

/// The file of one of several lights: FILE.light<i>.ENDING; of the only one the path.
std::filesystem::path light_path(const std::filesystem::path& path, size_t light, size_t light_count);

/// The camera of this name or, if there is none, of this index. Errors: no such camera, or several of this name.
uint32_t choose_camera(const Scene& scene, const std::string& text);

}  // namespace gnomon::cli
