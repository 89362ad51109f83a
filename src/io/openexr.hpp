// SPDX-License-Identifier: Apache-2.0
// What reading and writing any kind of OpenEXR file share.
#pragma once

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <filesystem>
#include <functional>
#include <gnomon/error.hpp>
#include <map>
#include <string>

#include "io/atomic_file.hpp"

namespace gnomon::io {

/// Bytes of pixels that a byte of the file can hold at most, so that a header which promises more is damaged.
uint64_t most_compression(Imf::Compression compression);

[[noreturn]] void throw_cannot_read(const std::filesystem::path& path, const std::string& reason, const std::string& hint);

/// Put texts into a header, and get them back but "type", which is OpenEXR's own, and added by it where the file has none.
void set_text_attributes(Imf::Header& header, const std::map<std::string, std::string>& attributes);
std::map<std::string, std::string> text_attributes(const Imf::Header& header);

/// Write a whole file with OpenEXR's classes. Errors: as AtomicFile.
void write_openexr(const std::filesystem::path& path, const std::function<void(Imf::OStream&)>& write);

/// Call what reads the file, at most so many pixels wide and high. Errors: ErrorKind::input where it is missing, no regular
/// file, or OpenEXR finds it damaged.
void read_openexr(const std::filesystem::path& path, int most_width, int most_height, const std::function<void()>& read);

}  // namespace gnomon::io
