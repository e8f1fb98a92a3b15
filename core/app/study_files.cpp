// SPDX-License-Identifier: MIT
#include "app/study_files.h"

#include "output/chart_files.h"
#include "output/error.h"
#include "output/file.h"
#include "output/study_page.h"
#include "study/journal.h"
#include "study/study_charts.h"
#include "study/study_json.h"

#include <filesystem>

namespace plumb::app {
namespace {

void write_whole(const std::filesystem::path& path, const std::string& text) {
    WholeFile file(path.string());
    file.append(text);
    file.commit();
}

std::string title_of(const study::StudyTable& table) {
    std::string names;
    for (const study::SubjectSummary& s : table.subjects)
        names.append(names.empty() ? "" : ", ").append(s.name);
    constexpr std::size_t kMost = 3;
    return table.subjects.size() > kMost ? "What accuracy costs" : "What accuracy costs: " + names;
}

/// The charts; once a chart cannot be drawn, the sentence that says why.
std::vector<std::string> write_charts(const study::StudyTable& table,
                                      const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::vector<std::string> remarks;
    for (const study::NamedChart& c : study::charts_of(table)) {
        const ChartFiles files = write_chart_files(folder.string(), c.name, c.chart);
        if (!files.trouble.empty() && remarks.empty()) remarks.push_back(files.trouble);
    }
    return remarks;
}

}  // namespace

std::vector<std::string> write_study(const study::StudyTable& table, const std::string& folder) {
    const std::filesystem::path base(folder);
    std::error_code failed;
    std::filesystem::create_directories(base, failed);
    if (failed) throw OutputError(folder, "cannot be made: " + failed.message());
    write_whole(base / "points.csv", study::table_csv(table));
    const std::string findings = study::study_json(table, title_of(table));
    write_whole(base / "findings.json", findings);
    write_whole(base / "report.html", study_page(title_of(table), findings));
    return write_charts(table, base / "charts");
}

}  // namespace plumb::app
