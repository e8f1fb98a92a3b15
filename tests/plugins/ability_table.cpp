// SPDX-License-Identifier: MIT
#include "ability_table.h"

#include "child.h"
#include "loading.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace plumb::test {
namespace {

constexpr const char* kNothing = "–";
constexpr const char* kFails = "**fails**";
constexpr unsigned kLimit = 60;  ///< for one pair [s]

/// The cells of one plugin, pair by pair.
using Column = std::vector<std::string>;
struct Subject {
    std::string name;
    Column cells;
};

ShapeKind kind(std::uint32_t i) { return static_cast<ShapeKind>(i); }

/// Two half-spaces never touch in points.
bool listed(std::uint32_t a, std::uint32_t b) { return a <= b && !(a == 0 && b == 0); }

/// Reads all that a child process says until it ends; true when it ended well.
bool hear_out(const Child& child, std::string& said) {
    if (child.pid < 0) return false;
    char piece[4096];
    for (ssize_t got; (got = read(child.lines, piece, sizeof piece)) > 0;)
        said.append(piece, static_cast<std::size_t>(got));
    close(child.lines);
    int status = 0;
    waitpid(child.pid, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string words_for(std::uint32_t able) {
    std::string words = able & kPairManifold ? "full" : "point";
    if (!(able & kPairSeparated)) words += ", touching";
    if (able & kPairMovingMesh) words += ", moving";
    return words;
}

/// The cell of a pair, after its tests have run.
std::string cell(const std::string& file, std::uint32_t a, std::uint32_t b) {
    const std::uint32_t able = ability(file, kind(a), kind(b));
    if (able == kPairNone) return kNothing;
    std::string said;
    const KindPair pair{kind(a), kind(b)};
    return hear_out(start_child(file, "Pairs.*", {}, pair, kLimit), said) ? words_for(able)
                                                                          : kFails;
}

/// What the process of one plugin tells: its name, then a cell a line.
[[noreturn]] void tell_column(int lines, const std::string& file) {
    std::string text = std::string(plugin(file).name) + "\n";
    for (std::uint32_t a = 0; a < kShapeKindCount; ++a)
        for (std::uint32_t b = 0; b < kShapeKindCount; ++b)
            if (listed(a, b)) text += cell(file, a, b) + "\n";
    const bool written =
        write(lines, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    std::_Exit(written ? 0 : 1);
}

/// Asks a plugin in a process of its own; no cells where that fails.
Subject ask(const std::string& name) {
    const std::string file = plugin_file(name);
    int ends[2];
    if (file.empty() || pipe(ends) != 0) return {name, {}};
    std::fflush(nullptr);
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        tell_column(ends[1], file);
    }
    close(ends[1]);
    std::string said;
    Subject subject{name, {}};
    if (!hear_out({pid, ends[0]}, said)) return subject;
    std::istringstream stream(said);
    std::getline(stream, subject.name);
    for (std::string line; std::getline(stream, line);) subject.cells.push_back(line);
    return subject;
}

/// A row holds all kinds that do the same against one.
struct Row {
    std::string others;
    Column cells;
};

std::vector<Row> rows_of(std::uint32_t a, std::size_t first, const std::vector<Subject>& subjects) {
    std::vector<Row> rows;
    for (std::uint32_t b = a; b < kShapeKindCount; ++b) {
        if (!listed(a, b)) continue;
        Column cells;
        for (const Subject& s : subjects) cells.push_back(s.cells[first]);
        ++first;
        Row* row = nullptr;
        for (Row& r : rows)
            if (r.cells == cells) row = &r;
        if (!row) row = &rows.emplace_back(Row{"", cells});
        row->others += (row->others.empty() ? "" : ", ") + std::string(name_of(kind(b)));
    }
    return rows;
}

void print_row(const std::string& a, const std::string& b, const Column& cells) {
    std::printf("| %s | %s |", a.c_str(), b.c_str());
    for (const std::string& c : cells) std::printf(" %s |", c.c_str());
    std::printf("\n");
}

void print_rows(const std::vector<Subject>& subjects) {
    Column names, rule;
    for (const Subject& s : subjects) names.push_back("`" + s.name + "`"), rule.push_back("---");
    print_row("", "with", names);
    print_row("---", "---", rule);
    std::size_t first = 0;
    for (std::uint32_t a = 0; a < kShapeKindCount; ++a) {
        for (const Row& row : rows_of(a, first, subjects))
            print_row(name_of(kind(a)), row.others, row.cells);
        for (std::uint32_t b = a; b < kShapeKindCount; ++b) first += listed(a, b);
    }
}

}  // namespace

bool print_ability_table(const std::vector<std::string>& plugins) {
    std::vector<Subject> subjects;
    bool good = true;
    for (const std::string& name : plugins) {
        const Subject subject = ask(name);
        for (const std::string& c : subject.cells) good = good && c != kFails;
        if (!subject.cells.empty()) {
            subjects.push_back(subject);
            continue;
        }
        std::fprintf(stderr, "%s cannot be asked\n", name.c_str());
        good = false;
    }
    print_rows(subjects);
    return good;
}

}  // namespace plumb::test
