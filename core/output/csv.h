// SPDX-License-Identifier: MIT
/// A table with one row for each body and frame. Numbers have as many digits as it takes to read
/// back the same bits.
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
    RecordingHeader header_;
    AppendFile file_;
    std::vector<std::string> names_;  ///< [body], quoted where need be
};

}  // namespace plumb
