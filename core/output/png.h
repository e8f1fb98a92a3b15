// SPDX-License-Identifier: MIT
/// A picture of the last frame as a PNG file.
#pragma once

#include "output/exporters.h"
#include "output/file.h"
#include "output/picture.h"

#include <string>

namespace plumb {

class PngExporter : public Exporter {
public:
    PngExporter(const std::string& path, const RecordingHeader& header)
        : header_(header), file_(path) {}
    void append(const Frame& frame) override {
        expect_bodies_of(header_, frame, file_.path());
        last_ = frame;
    }
    void finish() override;

private:
    RecordingHeader header_;
    WholeFile file_;
    Frame last_;
};

/// The picture as the bytes of a PNG file.
std::string png_bytes(const Picture& picture);

}  // namespace plumb
