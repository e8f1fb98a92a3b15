// SPDX-License-Identifier: MIT
/// What a sweep has run so far, in a folder, so that nothing is lost when it ends early.
///
///     study.json   subjects, plan, machine: what the sweep is
///     runs.csv     a line for each run, written as soon as it has ended
#pragma once

#include "output/file.h"
#include "study/point.h"
#include "study/run_point.h"

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace plumb::study {

/// The plan of a table as JSON text, and back: all but what runs have told. The text of equal plans
/// is equal, times and machines aside. `plan_from_json` throws std::exception on other text.
std::string plan_json(const StudyTable& table);
StudyTable plan_from_json(std::string_view text);

class Journal {
public:
    /// Opens or begins the journal of a plan in a folder, and enters into `table` what ran before.
    /// Throws OutputError where the folder cannot be written, or holds the journal of another plan.
    Journal(const std::string& folder, StudyTable& table);

    /// Writes a run of row `row`; `judged`: whether it holds the errors.
    void add(std::size_t row, bool judged, const Outcome& outcome);

private:
    std::ofstream file_;
    std::string path_;
};

/// The plan of the sweep in a folder; nothing where it holds none. Throws OutputError.
std::optional<StudyTable> plan_in(const std::string& folder);

/// The tables of several journals as one: rows that one of them has run. Throws OutputError where a
/// folder holds no journal, or they are of different plans.
StudyTable merged(const std::vector<std::string>& folders);

/// Every point with its settings, error and cost, a line each, as CSV text.
std::string table_csv(const StudyTable& table);

/// Enters an outcome into its row.
void enter(Row& row, bool judged, const Outcome& outcome);

}  // namespace plumb::study
