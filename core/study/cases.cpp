// SPDX-License-Identifier: MIT
#include "study/cases.h"

#include "study/cases/list.h"

#include <algorithm>

namespace plumb::study {

const std::vector<CaseEntry>& cases() {
    static const std::vector<CaseEntry> all{
        {"parabola", parabola},
        {"free_top", free_top},
        {"dzhanibekov", dzhanibekov},
        {"gyroscope", gyroscope},
        {"pendulum", pendulum},
        {"double_pendulum", double_pendulum},
        {"slope_slides", slope_slides},
        {"slope_sticks", slope_sticks},
        {"braking", braking},
        {"rolling_start", rolling_start},
        {"rolling_down", rolling_down},
        {"rolling_disk", rolling_disk},
        {"bouncing", bouncing},
        {"cradle", cradle},
        {"stack", stack},
        {"loaded_stack", loaded_stack},
        {"tower", tower},
        {"arch", arch},
        {"wall", wall},
        {"robot", robot},
        {"pile", pile},
        {"catenary", catenary},
        {"hanging_chain", hanging_chain},
        {"heavy_chain", heavy_chain},
        {"gears", gears},
        {"springs", springs},
        {"hanging_strip", hanging_strip},
        {"drape", drape},
        {"rope_catenary", rope_catenary},
        {"hanging_rope", hanging_rope},
        {"cantilever", cantilever},
        {"balloon", balloon},
        {"pressed_balloon", pressed_balloon},
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
