// SPDX-License-Identifier: MIT
#include "verdict.h"

#include "child.h"
#include "loading.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace plumb::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kMostLosses = 3;  ///< deaths and hangs after which the rest is not run
constexpr std::size_t kMostSentences = 3;

/// What came of all tests so far.
struct Tally {
    std::string plugin;   ///< name and version, as its table says
    std::string refusal;  ///< of the host; empty where the plugin can be used
    std::vector<std::string> done;
    int passed = 0, failed = 0, skipped = 0, losses = 0;
};

/// The test that runs.
struct Current {
    std::string name;  ///< empty between tests
    std::vector<std::string> sentences;
    std::string skipped;
};

/// "Suite.Test" of "All/Suite.Test/plugin".
std::string short_name(const std::string& name) {
    const std::size_t begin = name.find('/') + 1;
    return name.substr(begin, name.rfind('/') - begin);
}

void print_line(const char* verdict, const std::string& test, const std::string& said = {}) {
    std::printf("  %-14s %s%s%s\n", verdict, test.c_str(), said.empty() ? "" : ": ", said.c_str());
    std::fflush(stdout);
}

void end_test(Tally& tally, Current& test) {
    const std::string name = short_name(test.name);
    if (!test.sentences.empty()) {
        ++tally.failed;
        print_line("FAILED", name);
        for (std::size_t i = 0; i < std::min(test.sentences.size(), kMostSentences); ++i)
            std::printf("      %s\n", test.sentences[i].c_str());
        if (test.sentences.size() > kMostSentences)
            std::printf("      and %zu more\n", test.sentences.size() - kMostSentences);
    } else if (!test.skipped.empty()) {
        ++tally.skipped;
        print_line("does not apply", name, test.skipped);
    } else {
        ++tally.passed;
        print_line("passed", name);
    }
    tally.done.push_back(test.name);
    test = {};
}

void lose_test(Tally& tally, Current& test, const char* verdict, const std::string& why) {
    ++tally.failed;
    ++tally.losses;
    print_line(verdict, test.name.empty() ? "outside of any test" : short_name(test.name), why);
    if (!test.name.empty()) tally.done.push_back(test.name);
    test = {};
}

void hear(Tally& tally, Current& test, const std::string& line) {
    const std::string text = line.substr(1);
    switch (line[0]) {
        case kTellsRefusal:
            tally.refusal = text;
            break;
        case kTellsPlugin:
            if (tally.plugin.empty()) std::printf("%s\n", text.c_str());
            tally.plugin = text;
            break;
        case kTellsBegin:
            test = {text, {}, {}};
            break;
        case kTellsFailure:
            test.sentences.push_back(text);
            break;
        case kTellsSkipped:
            test.skipped = text;
            break;
        case kTellsEnd:
            end_test(tally, test);
            break;
        default:
            break;
    }
}

/// Reads what the child tells until it is done; false when a test took longer than the limit.
bool listen(Tally& tally, Current& test, const Child& child, int limit) {
    std::string text;
    auto deadline = Clock::now() + std::chrono::seconds(limit);
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd ready{child.lines, POLLIN, 0};
        if (left <= 0 || poll(&ready, 1, static_cast<int>(left)) == 0) return false;
        char piece[4096];
        const ssize_t got = read(child.lines, piece, sizeof piece);
        if (got <= 0) return true;
        text.append(piece, static_cast<std::size_t>(got));
        for (std::size_t end; (end = text.find('\n')) != std::string::npos;) {
            hear(tally, test, text.substr(0, end));
            text.erase(0, end + 1);
            deadline = Clock::now() + std::chrono::seconds(limit);
        }
    }
}

/// One child, from start to end; false when nothing is left to run.
bool run_child(Tally& tally, const CheckOptions& options, const std::string& file) {
    const Child child = start_child(file, options.filter, tally.done);
    if (child.pid < 0) {
        std::printf("  the suite cannot be started: %s\n", std::strerror(errno));
        ++tally.failed;
        return false;
    }
    Current test;
    const bool in_time = listen(tally, test, child, options.limit);
    if (!in_time) kill(child.pid, SIGKILL);
    close(child.lines);
    int status = 0;
    waitpid(child.pid, &status, 0);
    const std::string name = tally.plugin.empty() ? options.plugin : tally.plugin;
    if (!tally.refusal.empty()) return false;
    if (!in_time) {
        lose_test(tally, test, "HUNG",
                  name + " did not answer within " + std::to_string(options.limit) + " s");
        return true;
    }
    if (WIFSIGNALED(status)) {
        lose_test(tally, test, "DIED", name + " ended the process: " + strsignal(WTERMSIG(status)));
        return true;
    }
    if (!test.name.empty() || (WEXITSTATUS(status) != 0 && tally.failed == 0))
        lose_test(tally, test, "DIED", name + " ended the process");
    return false;
}

}  // namespace

Verdict check_plugin(const CheckOptions& options) {
    const std::string file = plugin_file(options.plugin);
    if (file.empty()) {
        std::fprintf(stderr, "plumb: there is no collision plugin %s\n", options.plugin.c_str());
        return Verdict::refused;
    }
    Tally tally;
    while (run_child(tally, options, file) && tally.losses < kMostLosses) {
    }
    if (!tally.refusal.empty()) {
        std::fprintf(stderr, "plumb: collider %s was refused: %s\n", file.c_str(),
                     tally.refusal.c_str());
        return Verdict::refused;
    }
    if (tally.losses == kMostLosses)
        std::printf("  the rest was not run: %d tests were lost\n", tally.losses);
    const bool good = tally.failed == 0 && tally.passed > 0;
    const std::string name = tally.plugin.substr(0, tally.plugin.find(" ("));
    std::printf("%s: %s; %d passed, %d failed, %d do not apply\n",
                (name.empty() ? options.plugin : name).c_str(),
                good ? "conforms" : "does not conform", tally.passed, tally.failed, tally.skipped);
    return good ? Verdict::conforms : Verdict::does_not;
}

}  // namespace plumb::test
