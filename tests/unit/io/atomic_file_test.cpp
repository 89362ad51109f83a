// SPDX-License-Identifier: Apache-2.0
// Output files: whole or absent, and errors that say why.
#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <new>

#include "test_folder.hpp"
#include "throws.hpp"

namespace {

// Of one call.
size_t most_written = 0, most_synced = 0;

}  // namespace

// In place of libc's.
extern "C" {

ssize_t pwrite(int descriptor, const void* data, size_t bytes, off_t at) {
    most_written = std::max(most_written, bytes);
    return syscall(SYS_pwrite64, descriptor, data, bytes, at);
}

int sync_file_range(int descriptor, off_t at, off_t bytes, unsigned flags) {
    most_synced = std::max(most_synced, static_cast<size_t>(bytes));
    return static_cast<int>(syscall(SYS_sync_file_range, descriptor, at, bytes, flags));
}
}

namespace gnomon::test {

using io::AtomicFile;
using Names = std::set<std::string>;

class AtomicFileTest : public TestFolder {};

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// Files of this process are at most so long, as long as this lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST_F(AtomicFileTest, HasItsNameOnlyAfterCommit) {
    AtomicFile file(folder / "a.txt");
    file.write(bytes_of("hello"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
    file.commit();
    EXPECT_EQ(content_of(folder / "a.txt"), "hello");
    EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommitAndKeepsTheOldFile) {
    put_content(folder / "a.txt", "old");
    {
        AtomicFile file(folder / "a.txt");
        file.write(bytes_of("new"));
    }
    EXPECT_EQ(content_of(folder / "a.txt"), "old");
    EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFileTest, WritesWhereItSeeks) {
    AtomicFile file(folder / "a.txt");
    file.write(bytes_of("0123456789"));
    EXPECT_EQ(file.position(), 10u);
    file.seek(2);
    file.write(bytes_of("ab"));
    EXPECT_EQ(file.position(), 4u);
    file.commit();
    EXPECT_EQ(content_of(folder / "a.txt"), "01ab456789");
}

TEST_F(AtomicFileTest, HasTheModeOfAnyNewFile) {
    const mode_t mask = umask(027);
    io::write_file(folder / "a.txt", "x");
    umask(mask);
    struct stat status {};
    ASSERT_EQ(stat((folder / "a.txt").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

TEST_F(AtomicFileTest, TwoFilesInOneFolderDoNotMeet) {
    AtomicFile first(folder / "a.txt");
    AtomicFile second(folder / "b.txt");
    first.write(bytes_of("a"));
    second.write(bytes_of("b"));
    first.commit();
    second.commit();
    EXPECT_EQ(content_of(folder / "a.txt"), "a");
    EXPECT_EQ(content_of(folder / "b.txt"), "b");
}

TEST_F(AtomicFileTest, FollowsASymbolicLink) {
    put_content(folder / "target", "old");
    std::filesystem::create_symlink("target", folder / "link");
    io::write_file(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(content_of(folder / "target"), "new");
}

TEST_F(AtomicFileTest, MakesWhatADanglingLinkLeadsTo) {
    std::filesystem::create_directory(folder / "sub");
    std::filesystem::create_symlink("sub/other", folder / "link");
    std::filesystem::create_symlink("../target", folder / "sub" / "other");
    io::write_file(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "sub" / "other"));
    EXPECT_EQ(content_of(folder / "target"), "new");
    std::filesystem::create_symlink("none/target", folder / "nowhere");
    EXPECT_GNOMON_ERROR(io::write_file(folder / "nowhere", "new"), ErrorKind::input, "create the folder first");
    std::filesystem::create_symlink("loop", folder / "loop");
    EXPECT_GNOMON_ERROR(io::write_file(folder / "loop", "new"), ErrorKind::input, "symbolic links");
    EXPECT_EQ(names(), (Names{"link", "loop", "nowhere", "sub", "target"}));
}

TEST_F(AtomicFileTest, AFileThatReplacesAnotherHasItsMode) {
    for (const mode_t mode : {0600u, 0640u, 0666u, 0400u}) {
        put_content(folder / "a.txt", "old");
        ASSERT_EQ(chmod((folder / "a.txt").c_str(), mode), 0);
        io::write_file(folder / "a.txt", "new");
        struct stat status {};
        ASSERT_EQ(stat((folder / "a.txt").c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 07777u, mode);
        EXPECT_EQ(content_of(folder / "a.txt"), "new");
        std::filesystem::remove(folder / "a.txt");
    }
}

TEST_F(AtomicFileTest, SignalsThatEndTheProcessLeaveNothing) {
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGALRM, SIGUSR1}) {
        const pid_t child = fork();
        if (child == 0) {
            const rlimit no_core{0, 0};
            setrlimit(RLIMIT_CORE, &no_core);
            io::end_cleanly("test", "");
            AtomicFile first(folder / "a.txt"), second(folder / "b.txt");
            first.write(bytes_of("part"));
            std::raise(signal);
            _exit(0);
        }
        int status = 0;
        waitpid(child, &status, 0);
        if (signal == SIGINT || signal == SIGTERM) {
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << signal;
        } else {
            EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal;
        }
        EXPECT_EQ(names(), Names{}) << signal;
    }
}

// Each in a process of its own: what a process has made it removes itself.
TEST_F(AtomicFileTest, WhatAKilledProcessLeftIsRemovedByTheNext) {
    const auto run_child = [](const auto& work) {
        const pid_t child = fork();
        if (child == 0) {
            work();
            _exit(0);
        }
        return child;
    };
    const auto end_of = [](pid_t child) {
        int status = 0;
        waitpid(child, &status, 0);
        return status;
    };
    const auto write_and_wait = [&] {
        AtomicFile file(folder / "a.txt");
        file.write(bytes_of("part"));
        pause();
    };
    const auto wait_for_files = [&](size_t count) {
        while (names().size() < count) usleep(1000);
    };
    const pid_t killed = run_child(write_and_wait);
    wait_for_files(1);
    kill(killed, SIGKILL);
    end_of(killed);
    const Names left = names();
    ASSERT_EQ(left.size(), 1u);
    ASSERT_TRUE(left.begin()->starts_with(".gnomon-"));
    put_content(folder / ".gnomon-notes.txt", "somebody's");

    // It is removed; the file of a process that lives is not.
    const pid_t alive = run_child(write_and_wait);
    wait_for_files(2);
    while (names().contains(*left.begin()) || names().size() < 2) usleep(1000);
    EXPECT_EQ(end_of(run_child([&] { io::write_file(folder / "b.txt", "whole"); })), 0);
    EXPECT_EQ(names().size(), 3u);
    kill(alive, SIGKILL);
    end_of(alive);
    EXPECT_EQ(end_of(run_child([&] { io::check_writable(folder / "b.txt"); })), 0);
    EXPECT_EQ(names(), (Names{".gnomon-notes.txt", "b.txt"}));
}

TEST_F(AtomicFileTest, WithoutMemoryADestructorEndsTheProcessCleanly) {
    const pid_t child = fork();
    if (child == 0) {
        io::end_cleanly("test", "use less");
        AtomicFile file(folder / "a.txt");
        const auto allocate = [] { throw std::bad_alloc(); };
        [&]() noexcept { allocate(); }();
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 5) << status;
    EXPECT_EQ(names(), Names{});
}

TEST_F(AtomicFileTest, SignalsThatAreIgnoredStaySo) {
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGHUP, SIG_IGN);  // As by nohup.
        io::end_cleanly("test", "");
        AtomicFile file(folder / "a.txt");
        std::raise(SIGHUP);
        file.commit();
        _exit(7);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7);
    EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFileTest, AcceptsTheLongestName) {
    const std::string longest(255, 'n');
    io::write_file(folder / longest, "x");
    EXPECT_EQ(names(), Names{longest});
    EXPECT_GNOMON_ERROR(io::write_file(folder / (longest + "n"), "x"), ErrorKind::input, "shorter name");
}

TEST_F(AtomicFileTest, FullDiskIsAnErrorAndLeavesNothing) {
    put_content(folder / "a.txt", "old");
    const FileSizeLimit limit(4096);
    EXPECT_GNOMON_ERROR(io::write_file(folder / "a.txt", std::string(10000, 'x')), ErrorKind::input,
                        (folder / "a.txt").string() + "; raise the limit");
    EXPECT_EQ(content_of(folder / "a.txt"), "old");
    EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFileTest, CommitRemembersAFailedWriteThatACallerSwallowed) {
    AtomicFile file(folder / "a.txt");
    {
        const FileSizeLimit limit(16);
        EXPECT_THROW(file.write(bytes_of(std::string(100, 'x'))), Error);
    }
    file.seek(0);
    file.write(bytes_of("fits"));
    EXPECT_THROW(file.commit(), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
}

TEST_F(AtomicFileTest, NoCallTakesLongerThanASignalMayWait) {
    constexpr size_t kMost_bytes = size_t{32} << 20;
    std::string content(2 * kMost_bytes, 'x');
    content.back() = 'y';
    most_written = most_synced = 0;
    io::write_file(folder / "a.txt", content);
    EXPECT_TRUE(content_of(folder / "a.txt") == content);
    EXPECT_GT(most_written, 0u);
    EXPECT_LE(most_written, kMost_bytes);
    EXPECT_GT(most_synced, 0u);
    EXPECT_LE(most_synced, kMost_bytes);
}

TEST_F(AtomicFileTest, CheckWritableSaysWhatIsWrongAndLeavesNothing) {
    io::check_writable(folder / "a.txt");
    EXPECT_EQ(names(), Names{});
    std::filesystem::create_directory(folder / "sub");
    put_content(folder / "file", "");
    EXPECT_GNOMON_ERROR(io::check_writable(folder / "none" / "a.txt"), ErrorKind::input, "create the folder first");
    EXPECT_GNOMON_ERROR(io::check_writable(folder / "file" / "a.txt"), ErrorKind::input, "create the folder first");
    EXPECT_GNOMON_ERROR(io::check_writable(folder / "sub"), ErrorKind::input, "it is a folder");
    EXPECT_GNOMON_ERROR(io::check_writable(""), ErrorKind::input, "name of the file is missing");
    EXPECT_GNOMON_ERROR(io::check_writable("/dev/full"), ErrorKind::input, "it is a device or a pipe");
    EXPECT_EQ(names(), (Names{"file", "sub"}));
}

TEST_F(AtomicFileTest, FolderWithoutWritePermissionIsAnError) {
    if (geteuid() == 0) GTEST_SKIP() << "skipped: permissions do not bind root";
    std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_GNOMON_ERROR(io::check_writable(folder / "a.txt"), ErrorKind::input, "name a folder that you may write to");
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

}  // namespace gnomon::test
