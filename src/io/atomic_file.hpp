// SPDX-License-Identifier: Apache-2.0
// Output files that are either whole or absent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace gnomon::io {

/// A file that is written under a temporary name in the folder of `path` and takes its own name in commit(). Without a commit
/// nothing is left behind, and what was there under `path` before stays as it was. What a process that was killed left in the
/// folder is removed by the next one that writes there. A file that replaces another has its mode.
/// A symbolic link is followed, not replaced, as by whatever opens a file to write: where it leads to nothing yet, that is
/// made. Errors, of all members: ErrorKind::input with the system's reason: no such folder, not writable, no space left, `path`
/// is a folder or a device.
class AtomicFile {
public:
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Write at the current position and move it.
    void write(std::span<const std::byte> data);
    void seek(uint64_t position) { position_ = position; }
    uint64_t position() const { return position_; }

    /// Bring the data to the disk, then give the file its name. Fails if any write before has failed.
    void commit();

private:
    [[noreturn]] void fail(int error);
    void remove();

    std::filesystem::path path_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    int error_ = 0;  // Of the first write that failed: a caller in between may have swallowed the exception.
    uint64_t position_ = 0;
    uint64_t bytes_ = 0;  // Of the file so far.
};

/// From now on signals that end the process by default, as SIGQUIT or SIGXCPU, remove the temporary files first. SIGINT and
/// SIGTERM then say on stderr that `program` was interrupted, and end it at once with exit code 130, whatever it is doing.
/// Signals that are ignored stay so. Where std::terminate is called because there is no memory, end_without_memory() is, with
/// `hint` as what to do. To be called once.
void end_cleanly(const char* program, const char* hint);

/// Remove the temporary files, say on stderr that the host is out of memory, and end with exit code 5: with none to be had.
[[noreturn]] void end_without_memory();

/// Throws the error that writing `path` would end in, as far as that can be known before. Leaves no file behind.
void check_writable(const std::filesystem::path& path);

/// Write a whole file. Errors: as AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace gnomon::io
