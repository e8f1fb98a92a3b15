// SPDX-License-Identifier: MIT
/// A table with one row for each body and frame. Numbers have as many digits as it takes to read
/// back the same bits.
///
/// Where a scene has deformables, two columns more, `deformable` and `point`, are filled in the
/// rows of their points, which follow those of the bodies of the same frame; such a row has its
/// deformable's name and the place of the point, and nothing in the columns of bodies alone.
#pragma once

#include "output/exporters.h"
#include "output/file.h"

#include <string>
#include <vector>

namespace plumb {

class CsvExporter : public Exporter {
public:
    CsvExporter(const std::string& path, const RecordingHeader& header);
    void append(const Frame& frame) override;
    void finish() override { file_.close(); }

private:
    void put_bodies(std::string& rows, const Frame& frame) const;
    void put_points(std::string& rows, const Frame& frame) const;

    RecordingHeader header_;
    AppendFile file_;
    std::vector<std::string> names_;             ///< [body], quoted where need be
    std::vector<std::string> deformable_names_;  ///< [deformable], the same
};

}  // namespace plumb
