// SPDX-License-Identifier: MIT
#include "output/chart_files.h"

#include "output/chart_script.h"
#include "output/file.h"
#include "output/gnuplot.h"

#include <cctype>
#include <filesystem>

namespace plumb {
namespace {

/// A name that means nothing to file systems, gnuplot or shells.
std::string plain_name(const std::string& name) {
    std::string plain;
    for (const char c : name) {
        const bool good = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
        plain += good ? c : '-';
    }
    return plain.empty() || plain.front() == '.' ? "chart" + plain : plain;
}

void write_whole(const std::string& path, const std::string& content) {
    WholeFile file(path);
    file.append(content);
    file.commit();
}

}  // namespace

ChartFiles write_chart_files(const std::string& folder, const std::string& name, const Chart& chart,
                             const std::string& program) {
    const std::string plain = plain_name(name);
    const auto path = [&](const char* ending) {
        return (std::filesystem::path(folder) / (plain + ending)).string();
    };
    const ChartStage stage = chart_stage(chart);
    write_whole(path(".dat"), chart_data(chart, stage));
    write_whole(path(".gp"), chart_script(plain, chart, stage));

    // What an earlier run drew must not pass for what this one did.
    std::error_code ignored;
    for (const char* ending : {".svg", ".png"}) std::filesystem::remove(path(ending), ignored);
    ChartFiles files{{path(".dat"), path(".gp")}, run_gnuplot(program, folder, plain + ".gp")};
    for (const char* ending : {".svg", ".png"}) {
        if (std::filesystem::exists(path(ending), ignored)) files.written.push_back(path(ending));
    }
    return files;
}

}  // namespace plumb
