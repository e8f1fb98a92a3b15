// SPDX-License-Identifier: MIT
/// The `plumb` program: results on stdout, all else on stderr, one clear sentence for each failure.
#include "app/usage.h"
#include "app/verbs.h"
#include "host/collider_call.h"
#include "host/log.h"
#include "output/error.h"
#include "scene/error.h"
#include "scene/nearest.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace plumb::app {
namespace {

struct Registered {
    const char* name;
    const char* description;
    Verb (*add)(CLI::App&);
};

constexpr std::array kVerbs{
    Registered{"run", "simulate a scene and write what came of it", add_run},
    Registered{"colliders", "list the collision plugins and what they can do", add_colliders},
    Registered{"effects", "tell which effects a scene calls for, why, and what each costs",
               add_effects},
    Registered{"check", "validate a scene without running it", add_check},
    Registered{"compare", "measure the contact sets of several colliders against each other",
               add_compare},
    Registered{"cost", "measure what accuracy costs in time, of known cases and of scenes",
               add_cost},
    Registered{"tune", "find the cheapest settings of a scene that reach an error", add_tune},
    Registered{"export", "make a replay, picture or table of a recording", add_export},
};

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 internal error (of compare: the colliders differ), 2 usage, 3 bad "
    "scene or recording,\n"
    "4 collider missing or unable, 5 diverged (the last good frames are kept), 6 cannot write,\n"
    "130 interrupted (outputs are completed).";

int complain(int code, const std::string& sentence) {
    logger()->error(sentence);
    return code;
}

/// "" where it is one of the levels, otherwise why it is not.
std::string bad_level(const std::string& level) {
    static const std::vector<std::string> levels{"trace", "debug", "info", "warn", "error", "off"};
    if (std::find(levels.begin(), levels.end(), level) != levels.end()) return "";
    return "unknown level \"" + level + '"' + advice(level, levels);
}

/// What of the messages is written, for every verb.
void add_log_level(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "--log-level",
            [](const std::string& level) { logger()->set_level(spdlog::level::from_str(level)); },
            "least level of the messages on stderr: trace, debug, info, warn, error or off; info "
            "unless told")
        ->check(bad_level)
        ->type_name("LEVEL");
}

/// Results that did not get through are no results, also where they tell that colliders differ.
int finished(int code) {
    const bool written = std::fflush(stdout) == 0 && !std::ferror(stdout);
    if (written || (code != kDone && code != kDiffer)) return code;
    return complain(kCannotWrite, "stdout: cannot be written: the disk may be full");
}

int guarded(const Verb& verb) {
    try {
        return finished(verb());
    } catch (const UsageError& e) {
        return complain(kUsage, e.what());
    } catch (const UnknownEnding& e) {
        return complain(kUsage, e.what());
    } catch (const SceneError& e) {
        return complain(kBadScene, e.what());
    } catch (const ColliderError& e) {
        return complain(kColliderUnable, e.what());
    } catch (const UnreadableFile& e) {
        return complain(kBadScene, e.what());
    } catch (const OutputError& e) {
        return complain(kCannotWrite, e.what());
    } catch (const std::bad_alloc&) {
        return complain(kInternalError, "there is not enough memory for this");
    } catch (const std::exception& e) {
        return complain(kInternalError, e.what());
    }
}

}  // namespace

int program(int argc, char** argv) {
    logger()->set_level(spdlog::level::info);
    CLI::App app{"Plumb: position-based rigid body dynamics on interchangeable collision back-ends",
                 "plumb"};
    app.set_version_flag("--version", "plumb " PLUMB_VERSION);
    app.footer(kFooter);
    app.get_formatter()->label("SUBCOMMAND", "VERB");
    app.require_subcommand(1);
    std::array<CLI::App*, kVerbs.size()> commands{};
    std::array<Verb, kVerbs.size()> verbs;
    for (std::size_t i = 0; i < kVerbs.size(); ++i) {
        commands[i] = app.add_subcommand(kVerbs[i].name, kVerbs[i].description);
        commands[i]->group("Verbs");
        verbs[i] = kVerbs[i].add(*commands[i]);
        add_log_level(*commands[i]);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        return complain(kUsage, usage_sentence(app, argc, argv, e));
    }
    set_collider_end(
        [](const std::string& sentence) { std::_Exit(complain(kColliderUnable, sentence)); });
    for (std::size_t i = 0; i < kVerbs.size(); ++i)
        if (commands[i]->parsed()) return guarded(verbs[i]);
    return kUsage;
}

}  // namespace plumb::app

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is one that cannot be written
    return plumb::app::program(argc, argv);
}
