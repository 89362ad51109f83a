// SPDX-License-Identifier: Apache-2.0
// An S-buffer as a deep OpenEXR image: a sample of a pixel is a range of a texel.
//
// Scanlines, ZIPS compression, channels of 32-bit floats:
//   Z, ZBack                  metres along the axis of the light's view, the nearer and the farther of the range's two depths;
//                             the same where the method keeps only one
//   time.enter, time.exit     of the shutter, 0 to 1
//   triangle                  its number in the scene
//   A                         1
//   depth.enter, depth.exit   which depth is which; only where the method keeps both
// The samples of a pixel are in the order of LightRanges. The faces of a light are one below the other.
#pragma once

#include <filesystem>
#include <gnomon/render.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::io {

/// Above this, numbers of triangles are not exact in a float.
inline constexpr uint64_t kMostDumpedTriangles = uint64_t{1} << 24;

/// Same arguments, same bytes. Errors: as AtomicFile; ErrorKind::input for triangles whose number is not exact.
void write_sbuffer(const std::filesystem::path& path, const LightRanges& light,
                   const std::map<std::string, std::string>& attributes);

/// A sample as it is in the file, damaged or not.
struct FileRange {
    float z = 0.0f, z_back = 0.0f;
    float enter = 0.0f, exit = 0.0f;  ///< Times.
    float triangle = 0.0f;
    float alpha = 0.0f;
    float enter_depth = 0.0f, exit_depth = 0.0f;  ///< Z and ZBack, where the file has no such channels.
};

/// Reads a file row by row. Errors, of all members: ErrorKind::input where the file is missing, damaged, no deep image of
/// scanlines, or lacks a channel.
class SBufferFile {
public:
    explicit SBufferFile(const std::filesystem::path& path);
    ~SBufferFile();
    SBufferFile(SBufferFile&&) noexcept;

    struct Row {
        std::vector<uint32_t> counts;   ///< Of each texel.
        std::vector<FileRange> ranges;  ///< One texel's behind the other's.
    };

    const std::filesystem::path& path() const;
    uint32_t width() const;
    uint32_t height() const;
    bool exit_depths() const;  ///< It has the channels depth.enter and depth.exit.
    const std::map<std::string, std::string>& attributes() const;
    Row row(uint32_t y) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon::io
