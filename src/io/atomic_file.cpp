// SPDX-License-Identifier: Apache-2.0
// Output files that are either whole or absent.
#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <gnomon/error.hpp>
#include <mutex>
#include <new>
#include <set>
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
        case ELOOP:
            return "name a file, or a link that leads to one";
        case ENAMETOOLONG:
            return "give it a shorter name";
        default:
            return "name another file";
    }
}

/// The file that a symbolic link leads to, be it there or not, else the path itself.
fs::path resolve(fs::path path) {
    constexpr int kMostLinks = 40;  // As Linux follows.
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    if (!error) return target;
    const bool leads_to_nothing = fs::status(path, error).type() == fs::file_type::not_found;
    for (int links = 0; leads_to_nothing && fs::is_symlink(fs::symlink_status(path, error)); ++links) {
        if (links == kMostLinks) throw_cannot_write(path, std::generic_category().message(ELOOP), hint_for(ELOOP));
        path = path.parent_path() / fs::read_symlink(path, error);
    }
    return path;
}

// A signal waits for a call that writes, or that waits for the disk, to return: most bytes of one.
constexpr size_t kMostBytesAtOnce = size_t{16} << 20;

constexpr std::string_view kPrefix = ".gnomon-", kSuffix = ".tmp";

bool lock(int descriptor, int flags) {
    int result = -1;
    do {
        result = ::flock(descriptor, LOCK_EX | flags);
    } while (result != 0 && errno == EINTR);
    return result == 0;
}

/// A temporary file is locked as long as somebody writes it, and has its name until it is whole: one that is neither was left
/// behind. Where the file system has no locks, it stays.
void remove_if_left_behind(const fs::path& temporary) {
    const int descriptor = ::open(temporary.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return;
    struct stat locked {
    }, named{};
    const bool left_behind = lock(descriptor, LOCK_NB) && ::fstat(descriptor, &locked) == 0 &&
                             ::lstat(temporary.c_str(), &named) == 0 && locked.st_dev == named.st_dev &&
                             locked.st_ino == named.st_ino && S_ISREG(named.st_mode);
    if (left_behind) ::unlink(temporary.c_str());
    ::close(descriptor);
}

/// Of processes that were killed. Once for each folder: what this process makes it removes itself.
void remove_left_behind(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> done;
    const std::lock_guard guard(mutex);
    if (!done.insert(folder).second) return;
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(kPrefix) && name.ends_with(kSuffix)) remove_if_left_behind(entry->path());
    }
}

// The names of the temporary files that there are, for a signal's handler.
std::array<std::atomic<const char*>, 64> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free, "read by a signal's handler");

void remember_unfinished(const char* name) {
    for (std::atomic<const char*>& place : unfinished) {
        const char* none = nullptr;
        if (place.compare_exchange_strong(none, name)) return;
    }
    assert(false && "more files are being written than there are places for");
}

void forget_unfinished(const char* name) {
    for (std::atomic<const char*>& place : unfinished) {
        const char* known = name;
        if (place.compare_exchange_strong(known, nullptr)) return;
    }
}

// What is said at the end; over a progress bar, where there may be one.
using Message = std::array<char, 256>;
Message interrupted{}, without_memory{};

// This and what is below only calls what may be called in a signal's handler.
void remove_unfinished() {
    for (const std::atomic<const char*>& place : unfinished) {
        if (const char* name = place) ::unlink(name);
    }
}

[[noreturn]] void end(const Message& message, int exit_code) {
    remove_unfinished();
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), std::strlen(message.data()));
    ::_exit(exit_code);
}

void end_by_signal(int signal) {
    constexpr int kInterrupted = 130;
    if (signal == SIGINT || signal == SIGTERM) end(interrupted, kInterrupted);
    remove_unfinished();
    // The process ends by it once this has returned.
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(resolve(path)) {
    if (path_.filename().empty()) throw_cannot_write(path_, "the name of the file is missing", "add a name after the folder");
    struct stat old {};
    const bool replaces = ::stat(path_.c_str(), &old) == 0;
    if (!replaces && errno != ENOENT) fail(errno);
    if (replaces && S_ISDIR(old.st_mode)) throw_cannot_write(path_, "it is a folder", "name a file in it");
    if (replaces && !S_ISREG(old.st_mode)) throw_cannot_write(path_, "it is a device or a pipe", "name a regular file");
    const mode_t mode = replaces ? old.st_mode & 0777u : 0666u;

    remove_left_behind(path_.parent_path());
    // The name is short, whatever the target's, so that it is never too long; O_EXCL settles who owns it.
    const std::string stem = std::string(kPrefix) + std::to_string(::getpid()) + "-";
    for (int number = 0; descriptor_ < 0; ++number) {
        temporary_ = path_.parent_path() / (stem + std::to_string(number) + std::string(kSuffix));
        remember_unfinished(temporary_.c_str());
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        const int error = errno;
        if (descriptor_ < 0) forget_unfinished(temporary_.c_str());
        if (descriptor_ < 0 && error != EEXIST) fail(error);
        // Before it had its lock, another process may have removed it.
        struct stat made {};
        if (descriptor_ >= 0 && lock(descriptor_, 0) && ::fstat(descriptor_, &made) == 0 && made.st_nlink == 0) {
            remove();
            descriptor_ = -1;
        }
    }
    if (replaces && ::fchmod(descriptor_, mode) != 0) {
        const int error = errno;
        remove();
        fail(error);
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) remove();
}

void AtomicFile::remove() {
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
    forget_unfinished(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> data) {
    while (!data.empty()) {
        const ssize_t written =
            ::pwrite(descriptor_, data.data(), std::min(data.size(), kMostBytesAtOnce), static_cast<off_t>(position_));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(errno);
        position_ += static_cast<uint64_t>(written);
        bytes_ = std::max(bytes_, position_);
        data = data.subspan(static_cast<size_t>(written));
    }
}

void AtomicFile::commit() {
    if (error_ != 0) fail(error_);
    // fsync() finds little to do then.
    for (uint64_t at = 0; at < bytes_; at += kMostBytesAtOnce) {
        const unsigned flags = SYNC_FILE_RANGE_WAIT_BEFORE | SYNC_FILE_RANGE_WRITE | SYNC_FILE_RANGE_WAIT_AFTER;
        const bool synced = ::sync_file_range(descriptor_, static_cast<off_t>(at), kMostBytesAtOnce, flags) == 0;
        if (!synced && errno != ENOSYS) fail(errno);
    }
    if (::fsync(descriptor_) != 0) fail(errno);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
    forget_unfinished(temporary_.c_str());
    ::close(descriptor_);
    descriptor_ = -1;
}

void AtomicFile::fail(int error) {
    error_ = error;
    throw_cannot_write(path_, std::generic_category().message(error), hint_for(error));
}

void end_without_memory() { end(without_memory, static_cast<int>(ErrorKind::out_of_memory)); }

void end_cleanly(const char* program, const char* hint) {
    const char* over = ::isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "";
    std::snprintf(interrupted.data(), interrupted.size(), "%s%s: error: interrupted; run it again\n", over, program);
    std::snprintf(without_memory.data(), without_memory.size(), "%s%s: error: out of memory, on the host; %s\n", over, program,
                  hint);
    // Destructors, of JSON for one, may need memory, and may not throw.
    std::set_terminate([] {
        try {
            if (const std::exception_ptr current = std::current_exception()) std::rethrow_exception(current);
        } catch (const std::bad_alloc&) {
            end_without_memory();
        } catch (...) {
        }
        std::abort();
    });
    for (const int signal :
         {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGALRM, SIGTERM, SIGXCPU, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler != SIG_DFL) continue;
        action.sa_handler = end_by_signal;
        action.sa_flags = SA_RESTART;
        sigaction(signal, &action, nullptr);
    }
}

void check_writable(const fs::path& path) { const AtomicFile probe(path); }

void write_file(const fs::path& path, std::string_view content) {
    AtomicFile file(path);
    file.write(std::as_bytes(std::span(content)));
    file.commit();
}

}  // namespace gnomon::io
