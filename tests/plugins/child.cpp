// SPDX-License-Identifier: MIT
#include "child.h"

#include "loading.h"

#include <gtest/gtest.h>

#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace plumb::test {
namespace {

/// Writes one line a event to a pipe.
class Teller : public ::testing::EmptyTestEventListener {
public:
    explicit Teller(int lines) : lines_(lines) {}

    void tell(Told about, std::string text) const {
        std::replace(text.begin(), text.end(), '\n', ' ');
        text.insert(text.begin(), about);
        text += '\n';
        if (write(lines_, text.data(), text.size()) < 0) std::_Exit(1);
    }

private:
    void OnTestStart(const ::testing::TestInfo& test) override {
        tell(kTellsBegin, std::string(test.test_suite_name()) + "." + test.name());
    }
    void OnTestPartResult(const ::testing::TestPartResult& part) override {
        if (part.skipped()) return tell(kTellsSkipped, part.message());
        if (part.failed()) tell(kTellsFailure, part.message());
    }
    void OnTestEnd(const ::testing::TestInfo&) override { tell(kTellsEnd, ""); }

    int lines_;
};

std::string filter_of(const std::string& wanted, const std::vector<std::string>& done) {
    // The full name of a test is All/Suite.Test/plugin; users write Suite.Test.
    std::string filter = "All/" + wanted + (wanted.back() == '*' ? "" : "/*") + "-";
    for (const std::string& name : done) filter += name + ":";
    return filter;
}

[[noreturn]] void run_tests(int lines, const std::string& plugin_file, const std::string& filter) {
    prctl(PR_SET_PDEATHSIG,
          SIGKILL);  // a plugin that hangs does not outlive a parent that is stopped
    choose_plugins({plugin_file});
    auto* teller = new Teller(lines);
    const std::string why_not = refusal(plugin_file);
    if (!why_not.empty()) {
        teller->tell(kTellsRefusal, why_not);
        std::_Exit(1);
    }
    const PluginTable& table = plugin(plugin_file);
    int argc = 1;
    char name[] = "plumb_check_collider";
    char* argv[] = {name, nullptr};
    ::testing::InitGoogleTest(&argc, argv);
    GTEST_FLAG_SET(filter, filter);
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    teller->tell(kTellsPlugin, std::string(table.name) + " (" + table.backend_version + ", " +
                                   table.precision + " precision)");
    listeners.Append(teller);
    std::_Exit(RUN_ALL_TESTS());
}

}  // namespace

Child start_child(const std::string& plugin_file, const std::string& filter,
                  const std::vector<std::string>& done, const std::optional<KindPair>& pair,
                  unsigned limit) {
    int ends[2];
    if (pipe(ends) != 0) return {};
    std::fflush(nullptr);
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        if (pair) choose_pair(*pair);
        alarm(limit);  // 0: never
        run_tests(ends[1], plugin_file, filter_of(filter, done));
    }
    close(ends[1]);
    return {pid, ends[0]};
}

}  // namespace plumb::test
