// SPDX-License-Identifier: MIT
#include "app/recorder.h"

#include "app/distinct_files.h"
#include "output/error.h"

#include <cerrno>
#include <cstring>
#include <iostream>

namespace plumb::app {
Recorder::Recorder(const std::vector<std::string>& files, const std::string& summary,
                   const std::string& scene_file, const Scene& scene, const Simulation& simulation)
    : summary_(summary) {
    std::vector<std::string> all = files;
    all.push_back(summary);
    check_distinct(all, scene_file);
    Metadata metadata{simulation.collider_name(),
                      {{"collider_version", simulation.collider_version()}}};
    if (scene.settings.contacts == ContactOrigin::raw) metadata.values["contacts"] = "raw";
    for (const std::string& file : files)
        exporters_.push_back(make_exporter(file, scene, metadata));
    if (summary.empty() || summary == "-") return;
    summary_file_.open(summary);
    if (!summary_file_)
        throw OutputError(summary, std::string("cannot be written: ") + std::strerror(errno));
}

void Recorder::append(const Simulation& simulation) {
    if (exporters_.empty()) return;
    simulation.capture(frame_);
    for (auto& e : exporters_) attempt(e, [this](Exporter& exporter) { exporter.append(frame_); });
}

void Recorder::finish() {
    for (auto& e : exporters_) attempt(e, [](Exporter& exporter) { exporter.finish(); });
}

void Recorder::write_summary(const std::string& text) {
    if (summary_.empty()) return;
    std::ostream& to = summary_ == "-" ? std::cout : summary_file_;
    to << text << std::endl;
    if (!to)
        note((summary_ == "-" ? "stdout" : summary_) + ": cannot be written: the disk may be full");
}

template <class Work>
void Recorder::attempt(std::unique_ptr<Exporter>& exporter, Work&& work) {
    if (!exporter) return;
    try {
        work(*exporter);
    } catch (const OutputError& e) {
        note(e.what());
        exporter.reset();
    }
}

void Recorder::note(const std::string& sentence) {
    failure_ += (failure_.empty() ? "" : "; ") + sentence;
}

}  // namespace plumb::app
