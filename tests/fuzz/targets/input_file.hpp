// SPDX-License-Identifier: Apache-2.0
// The bytes of one run, as a file in memory.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace gnomon::fuzz {

/// A regular file without a folder, for what reads by path. Its content is replaced run by run.
class InputFile {
public:
    InputFile() : descriptor_(memfd_create("input", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(descriptor_)) {}
    ~InputFile() { close(descriptor_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::string& path_with(const uint8_t* data, size_t bytes) const {
        const bool written = ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, data, bytes, 0) == ssize_t(bytes);
        if (!written) std::abort();
        return path_;
    }

private:
    int descriptor_;
    std::string path_;
};

}  // namespace gnomon::fuzz
