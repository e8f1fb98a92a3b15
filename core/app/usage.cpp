// SPDX-License-Identifier: MIT
#include "app/usage.h"

#include "scene/nearest.h"

#include <algorithm>
#include <vector>

namespace plumb::app {
namespace {

std::vector<std::string> verb_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(verb->get_name());
    return names;
}

std::vector<std::string> option_names(const CLI::App& verb) {
    std::vector<std::string> names;
    for (const CLI::Option* option : verb.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The first "--name" on the command line that the verb does not have, or "".
std::string unknown_option(const CLI::App& verb, int argc, char** argv) {
    const std::vector<std::string> known = option_names(verb);
    for (int i = 1; i < argc; ++i) {
        std::string word = argv[i];
        word.erase(std::min(word.find('='), word.size()));
        if (word.rfind("--", 0) == 0 && word.size() > 2 && !contains(known, word)) return word;
    }
    return {};
}

/// CLI11's messages are sentences already, but some span lines.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

}  // namespace

std::string usage_sentence(const CLI::App& app, int argc, char** argv, const CLI::ParseError& e) {
    const std::vector<std::string> verbs = verb_names(app);
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    const CLI::App& asked = parsed.empty() ? app : *parsed.front();
    const std::string help =
        "; try \"plumb " + (parsed.empty() ? "" : asked.get_name() + " ") + "--help\"";

    const std::string word = argc > 1 ? argv[1] : "";
    // What follows an unknown verb may be an option of the verb that was meant.
    const bool verb_is_known = !parsed.empty() || word.rfind('-', 0) == 0;
    const std::string option = verb_is_known ? unknown_option(asked, argc, argv) : "";
    if (!option.empty())
        return "unknown option \"" + option + '"' + advice(option, option_names(asked)) + help;
    if (!parsed.empty()) return one_line(e.what()) + help;
    if (word.empty()) return "a verb is missing" + advice(word, verbs) + help;
    return "unknown verb \"" + word + '"' + advice(word, verbs) + help;
}

}  // namespace plumb::app
