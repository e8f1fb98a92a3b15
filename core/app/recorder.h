// SPDX-License-Identifier: MIT
/// The files that a run writes its frames and its summary to.
#pragma once

#include "host/simulation.h"
#include "output/exporters.h"

#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace plumb::app {

/// All files are opened when this is made, so that a path that cannot be written is known before
/// the run. A file that fails later is given up, and the others go on.
class Recorder {
public:
    /// `summary` may be empty (none) or "-" (stdout). Throws OutputError, or UsageError when two
    /// outputs are one file, or one is the scene's.
    Recorder(const std::vector<std::string>& files, const std::string& summary,
             const std::string& scene_file, const Scene& scene, const Simulation& simulation);

    /// How many files of frames there are.
    std::size_t size() const { return exporters_.size(); }

    void append(const Simulation& simulation);
    void finish();
    void write_summary(const std::string& text);

    /// What went wrong with files so far, one sentence; empty when nothing did.
    const std::string& failure() const { return failure_; }

private:
    template <class Work>
    void attempt(std::unique_ptr<Exporter>& exporter, Work&& work);
    void note(const std::string& sentence);

    std::vector<std::unique_ptr<Exporter>> exporters_;  ///< empty where given up
    std::string summary_;
    std::ofstream summary_file_;
    std::string failure_;
    Frame frame_;
};

}  // namespace plumb::app
