// SPDX-License-Identifier: MIT
/// Every kind of file that a run can be written to, and the one place where they are listed.
///
/// A new exporter is a class in a file of its own and one line in the table of exporters.cpp.
#pragma once

#include "measure/frame.h"
#include "output/recording.h"

#include <memory>
#include <string>

namespace plumb {

/// Takes the frames of a run, one after the other, and makes a file of them.
class Exporter {
public:
    virtual ~Exporter() = default;

    /// Frames come in the order of time, each with the bodies of the header; one of others throws
    /// OutputError.
    virtual void append(const Frame& frame) = 0;

    /// Completes the file; nothing is appended afterwards. Without it, .csv and .plumb files hold
    /// what was appended, the others do not appear.
    virtual void finish() = 0;
};

/// Makes the exporter that the ending of `path` asks for, and opens its file, so that a path that
/// cannot be written is known before the run. Throws OutputError, with the endings that there are
/// when it is none of them.
std::unique_ptr<Exporter> make_exporter(const std::string& path, const RecordingHeader& header);
std::unique_ptr<Exporter> make_exporter(const std::string& path, const Scene& scene,
                                        const Metadata& metadata);

/// Writes a recording, such as one that was read from a .plumb file, to another file.
void export_recording(const std::string& path, const Recording& recording);

}  // namespace plumb
