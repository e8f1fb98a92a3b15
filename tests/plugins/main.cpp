// SPDX-License-Identifier: MIT
/// plumb_check_collider: the conformance suite of collision plugins.
///
///     plumb_check_collider NAME|FILE.so [--limit S] [--filter TEST]
///                                                    a verdict on one plugin
///     plumb_check_collider --table [NAME|FILE.so…]   what each can do, in Markdown
///     plumb_check_collider --gtest_…                 GoogleTest on all of Plumb's
#include "ability_table.h"
#include "loading.h"
#include "verdict.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace plumb::test {
namespace {

constexpr const char* kUsage =
    "plumb_check_collider NAME|FILE.so [--limit SECONDS] [--filter TEST]\n"
    "Runs the conformance suite on one collision plugin. A name is looked for in "
    "PLUMB_PLUGIN_PATH\n"
    "and among the installed plugins; a test may take 60 s unless a limit is given; TEST is a "
    "name\n"
    "as the verdict prints it, and may end with *. Exit codes: 0 conforms, 1 does not, 2 usage,\n"
    "4 cannot be used.\n"
    "plumb_check_collider --table [NAME|FILE.so...]\n"
    "Prints what each plugin was seen to do with each pair of shapes; all of Plumb's unless "
    "named.\n";

int usage() {
    std::fputs(kUsage, stderr);
    return 2;
}

int verdict(int argc, char** argv) {
    CheckOptions options;
    for (int i = 1; i < argc; ++i) {
        const bool has_value = i + 1 < argc;
        if (std::strcmp(argv[i], "--limit") == 0 && has_value)
            options.limit = std::atoi(argv[++i]);
        else if (std::strcmp(argv[i], "--filter") == 0 && has_value)
            options.filter = argv[++i];
        else if (argv[i][0] == '-' || !options.plugin.empty())
            return usage();
        else
            options.plugin = argv[i];
    }
    if (options.plugin.empty() || options.filter.empty() || options.limit < 1) return usage();
    switch (check_plugin(options)) {
        case Verdict::conforms:
            return 0;
        case Verdict::does_not:
            return 1;
        default:
            return 4;
    }
}

int table(int argc, char** argv) {
    std::vector<std::string> names(argv + 2, argv + argc);
    return print_ability_table(names.empty() ? plugin_names() : names) ? 0 : 1;
}

int program(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], "--table") == 0) return table(argc, argv);
    if (argc > 1 && std::strncmp(argv[1], "--gtest", 7) != 0) return verdict(argc, argv);
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}

}  // namespace
}  // namespace plumb::test

int main(int argc, char** argv) { return plumb::test::program(argc, argv); }
