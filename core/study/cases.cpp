// SPDX-License-Identifier: MIT
#include "study/cases.h"

#include "study/cases/list.h"

#include <algorithm>

namespace plumb::study {

const std::vector<CaseEntry>& cases() {
    static const std::vector<CaseEntry> all{
        {"pendulum", pendulum},
    };
    return all;
}

const CaseEntry* find_case(std::string_view name) {
    const auto& all = cases();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const CaseEntry& c) { return c.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace plumb::study
