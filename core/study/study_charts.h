// SPDX-License-Identifier: MIT
/// A study as charts for papers: error against cost, one chart a question.
#pragma once

#include "output/chart_files.h"
#include "study/point.h"

#include <string>
#include <vector>

namespace plumb::study {

struct NamedChart {
    std::string name;  ///< of its files
    Chart chart;
};

/// Of each subject: what is made finer (NAME), what each departure from the paper buys
/// (NAME-departures), and colliders with their shared and raw contacts (NAME-colliders); and one
/// performance profile over all (profile). Those with a single line are left out.
std::vector<NamedChart> charts_of(const StudyTable& table);

}  // namespace plumb::study
