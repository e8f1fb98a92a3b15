// SPDX-License-Identifier: MIT
/// bench_costs PLUGIN… [--rounds N]: what a near pair of each two kinds of unit size costs [ns], as
/// the table that a plugin's source holds for PluginTable::costs.
///
/// The plugins take turns, pair of kinds by pair of kinds. Each round detects 21 times and keeps
/// the median; printed is the least median of all rounds, which other work on the machine disturbs
/// least, to two digits. 0: the plugin cannot do the pair. Plugins that must not share a process
/// are measured by a program run of their own.
#include "costs/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <string>

namespace plumb::bench {
namespace {

constexpr std::uint32_t kKinds = static_cast<std::uint32_t>(ShapeKind::compound);  ///< all others

struct Subject {
    ColliderLibrary library;
    const ColliderInfo& info;
    double costs[kKinds][kKinds]{};  ///< [ns]

    explicit Subject(const std::string& name) : library({}, name), info(library.find(name)) {}
};

double median_detection(NearPairs& pairs) {
    double times[21];
    for (double& t : times) t = pairs.detect();
    std::nth_element(times, times + 10, times + 21);
    return times[10];
}

/// All rounds of one pair of kinds on one plugin.
void measure(Subject& s, ShapeKind a, ShapeKind b, int rounds) {
    const auto i = static_cast<std::uint32_t>(a), j = static_cast<std::uint32_t>(b);
    if (!s.info.table->pairs[i][j]) return;
    NearPairs pairs(s.library, s.info, a, b);
    double least = s.costs[i][j] > 0 ? s.costs[i][j] : std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) least = std::min(least, median_detection(pairs));
    s.costs[i][j] = s.costs[j][i] = least;
    std::fprintf(stderr, "%-12s %-12s %-12s %8.0f ns, %zu touching\n", s.info.name.c_str(),
                 name_of(a), name_of(b), least, pairs.touching());
}

long two_digits(double x) {
    if (!(x > 0)) return 0;
    const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
    return std::max(1L, std::lround(std::round(x / unit) * unit));
}

void print(const Subject& s) {
    std::printf("// %s: %s\n//", s.info.name.c_str(), s.info.table->backend_version);
    for (std::uint32_t i = 0; i < kKinds; ++i)
        std::printf(" %s%s", name_of(static_cast<ShapeKind>(i)), i + 1 < kKinds ? "," : "\n");
    for (std::uint32_t i = 0; i < kKinds; ++i) {
        std::printf("{");
        for (std::uint32_t j = 0; j < kKinds; ++j)
            std::printf("%ld%s", two_digits(s.costs[i][j]), j + 1 < kKinds ? ", " : "},\n");
    }
}

int run(int argc, char** argv) {
    int rounds = 5;
    std::vector<std::unique_ptr<Subject>> subjects;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--rounds" && i + 1 < argc)
            rounds = std::max(1, std::atoi(argv[++i]));
        else
            subjects.push_back(std::make_unique<Subject>(word));
    }
    for (std::uint32_t a = 0; a < kKinds; ++a)
        for (std::uint32_t b = a; b < kKinds; ++b)
            for (auto& s : subjects)
                measure(*s, static_cast<ShapeKind>(a), static_cast<ShapeKind>(b), rounds);
    for (const auto& s : subjects) print(*s);
    return subjects.empty() ? 2 : 0;
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
    try {
        return plumb::bench::run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", argv[0], e.what());
        return 3;
    }
}
