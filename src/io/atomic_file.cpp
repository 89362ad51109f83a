// SPDX-License-Identifier: Apache-2.0
// Output files that are either whole or absent.
#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <gnomon/error.hpp>
#include <string>
#include <system_error>

namespace gnomon::io {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void throw_cannot_write(const fs::path& path, const std::string& reason, const std::string& hint) {
    throw Error(ErrorKind::input, "cannot write the file: " + reason, path.string(), hint);
}

std::string hint_for(int error) {
    switch (error) {
        case ENOENT:
        case ENOTDIR:
            return "create the folder first, or name another";
        case EACCES:
        case EPERM:
        case EROFS:
            return "name a folder that you may write to";
        case ENOSPC:
        case EDQUOT:
            return "free some space, or name a folder on another disk";
        case EFBIG:
            return "raise the limit on the size of files (ulimit -f), or write a smaller image";
        case ENAMETOOLONG:
            return "give it a shorter name";
        default:
            return "name another file";
    }
}

/// The file that a symbolic link leads to, else the path itself.
fs::path resolve(const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    return error ? path : target;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(resolve(path)) {
    if (path_.filename().empty()) throw_cannot_write(path_, "the name of the file is missing", "add a name after the folder");
    std::error_code error;
    const fs::file_type type = fs::status(path_, error).type();
    if (type == fs::file_type::none) fail(error.value());
    if (type == fs::file_type::directory) throw_cannot_write(path_, "it is a folder", "name a file in it");
    if (type != fs::file_type::not_found && type != fs::file_type::regular)
        throw_cannot_write(path_, "it is a device or a pipe", "name a regular file");

    // The name is short, whatever the target's, so that it is never too long; O_EXCL settles who owns it.
    const std::string stem = ".gnomon-" + std::to_string(::getpid()) + "-";
    for (int number = 0; descriptor_ < 0; ++number) {
        temporary_ = path_.parent_path() / (stem + std::to_string(number) + ".tmp");
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST) fail(errno);
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> data) {
    while (!data.empty()) {
        const ssize_t written = ::pwrite(descriptor_, data.data(), data.size(), static_cast<off_t>(position_));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(errno);
        position_ += static_cast<uint64_t>(written);
        data = data.subspan(static_cast<size_t>(written));
    }
}

void AtomicFile::commit() {
    if (error_ != 0) fail(error_);
    if (::fsync(descriptor_) != 0) fail(errno);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
    ::close(descriptor_);
    descriptor_ = -1;
}

void AtomicFile::fail(int error) {
    error_ = error;
    throw_cannot_write(path_, std::generic_category().message(error), hint_for(error));
}

void check_writable(const fs::path& path) { const AtomicFile probe(path); }

void write_file(const fs::path& path, std::string_view content) {
    AtomicFile file(path);
    file.write(std::as_bytes(std::span(content)));
    file.commit();
}

}  // namespace gnomon::io
