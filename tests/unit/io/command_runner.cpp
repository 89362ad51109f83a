// SPDX-License-Identifier: Apache-2.0
// Runs the built commands and keeps what it says.
#include "command_runner.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {

CommandResult run_command(const std::string& command, const std::filesystem::path& folder,
                          const std::vector<std::string>& arguments, const std::function<void()>& prepare,
                          const std::function<void(int)>& while_running) {
    const std::filesystem::path out = folder / ".stdout";
    const std::filesystem::path err = folder / ".stderr";
    std::vector<std::string> words = {command};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) {
        const int out_descriptor = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int err_descriptor = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(out_descriptor, STDOUT_FILENO);
        dup2(err_descriptor, STDERR_FILENO);
        if (chdir(folder.c_str()) != 0) _exit(127);
        if (prepare) prepare();
        execv(argv[0], argv.data());
        _exit(127);
    }
    if (while_running) while_running(child);
    int status = 0;
    waitpid(child, &status, 0);
    CommandResult result;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = content_of(out);
    result.err = content_of(err);
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return result;
}

CommandResult run_gnomon(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                         const std::function<void()>& prepare, const std::function<void(int)>& while_running) {
    return run_command(GN_PATH(GNOMON_COMMAND), folder, arguments, prepare, while_running);
}

bool device_is_required() {
    const char* value = std::getenv("GNOMON_REQUIRE_DEVICE");
    return value != nullptr && std::string(value) == "1";
}

}  // namespace gnomon::test
