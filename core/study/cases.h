// SPDX-License-Identifier: MIT
/// Cases with known answers. A new one is a function in a file of `cases/` and a line in cases.cpp.
#pragma once

#include "study/subject.h"

#include <string_view>
#include <vector>

namespace plumb::study {

/// A case, made when it is asked for.
struct CaseEntry {
    std::string_view name;
    Subject (*make)();
};

/// All of them, in the order in which a reader would want to meet them.
const std::vector<CaseEntry>& cases();

/// The case of this name; nullptr where there is none.
const CaseEntry* find_case(std::string_view name);

}  // namespace plumb::study
