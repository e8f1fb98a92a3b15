// SPDX-License-Identifier: MIT
/// A replay as one HTML file that opens from disk: the player, the shapes and the motion, and no
/// network.
#pragma once

#include "output/exporters.h"
#include "output/file.h"
#include "output/html_json.h"
#include "output/view.h"

#include <string>
#include <vector>

namespace plumb {

class HtmlExporter : public Exporter {
public:
    HtmlExporter(const std::string& path, const RecordingHeader& header);
    void append(const Frame& frame) override;
    void finish() override;

private:
    RecordingHeader header_;
    WholeFile file_;
    ReplayMotions motions_;
    std::vector<Frame> notes_;  ///< [frame], without bodies and particles
    std::vector<Ball> balls_;   ///< where things were at the start and are now, to fit the view to
    Frame last_;
};

}  // namespace plumb
