// SPDX-License-Identifier: MIT
/// A replay as one HTML file that opens from disk: the player, the shapes and the motion, and no
/// network.
#pragma once

#include "output/exporters.h"
#include "output/file.h"
#include "output/motion_code.h"
#include "output/view.h"

#include <string>
#include <vector>

namespace plumb {

class HtmlExporter : public Exporter {
public:
    HtmlExporter(const std::string& path, const RecordingHeader& header)
        : header_(header), file_(path), motions_(header.bodies.size()) {}
    void append(const Frame& frame) override;
    void finish() override;

private:
    RecordingHeader header_;
    WholeFile file_;
    std::vector<std::vector<PoseSample>> motions_;  ///< [body][frame]
    std::vector<Frame> notes_;                      ///< [frame], without bodies
    std::vector<Ball> balls_;  ///< where bodies were at the start and are now, to fit the view to
    Frame last_;
};

}  // namespace plumb
