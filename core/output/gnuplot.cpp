// SPDX-License-Identifier: MIT
#include "output/gnuplot.h"

#include "output/error.h"
#include "output/file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace plumb {
namespace {

/// What the child does with its files before it runs: silent, in the folder, its complaints kept.
class FileActions {
public:
    FileActions(const std::string& folder, const std::string& log) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, log.c_str(),
                                         O_WRONLY | O_CREAT | O_TRUNC, 0644);
    }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;

    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

int status_of(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return -1;
    }
    return status;
}

/// The last line that says something: gnuplot repeats the command before it says what is wrong.
std::string last_words(const std::string& log) {
    try {
        std::string text = read_file(log);
        text.erase(text.find_last_not_of(" \n\r\t") + 1);
        const std::size_t newline = text.rfind('\n');
        return newline == std::string::npos ? text : text.substr(newline + 1);
    } catch (const OutputError&) {
        return "";
    }
}

}  // namespace

std::string run_gnuplot(const std::string& program, const std::string& folder,
                        const std::string& script) {
    const std::string log = script + ".log";
    const std::filesystem::path log_path = std::filesystem::path(folder) / log;
    // -d: the user's own settings shall not change a chart.
    std::array<std::string, 3> words{program, "-d", "./" + script};
    std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
    const std::string remedy = "; \"gnuplot " + script + "\" in " + folder + " draws it";

    pid_t child = 0;
    const FileActions actions(folder, log);
    const int error =
        posix_spawnp(&child, program.c_str(), actions.get(), nullptr, arguments.data(), environ);
    const int status = error == 0 ? status_of(child) : 0;
    const std::string said = last_words(log_path.string());
    std::error_code ignored;
    std::filesystem::remove(log_path, ignored);

    if (error == ENOENT) return "The chart was not drawn: there is no gnuplot here" + remedy + ".";
    if (error != 0)
        return std::string("The chart was not drawn: gnuplot could not be started: ") +
               std::strerror(error) + remedy + ".";
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return "The chart was not drawn whole: gnuplot failed" +
               (said.empty() ? said : " (" + said + ")") + remedy + ".";
    return "";
}

}  // namespace plumb
