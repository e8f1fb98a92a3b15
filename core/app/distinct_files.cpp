// SPDX-License-Identifier: MIT
#include "app/distinct_files.h"

#include "app/usage.h"
#include "output/file.h"

#include <filesystem>
#include <set>

namespace plumb::app {

void check_distinct(const std::vector<std::string>& files, const std::string& input) {
    std::set<std::filesystem::path> seen;
    for (const std::string& file : files) {
        if (file.empty() || file == "-") continue;
        std::error_code ignored;
        const std::string place = written_place(file);
        if (std::filesystem::equivalent(place, input, ignored))
            throw UsageError("\"" + file + "\" is what is read: an output would overwrite it");
        const auto path = std::filesystem::absolute(place, ignored).lexically_normal();
        if (!seen.insert(std::filesystem::weakly_canonical(path, ignored)).second)
            throw UsageError("\"" + file + "\" is named twice among the outputs");
    }
}

}  // namespace plumb::app
