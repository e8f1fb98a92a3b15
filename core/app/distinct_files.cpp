// SPDX-License-Identifier: MIT
#include "app/distinct_files.h"

#include "app/usage.h"

#include <filesystem>
#include <set>

namespace plumb::app {

void check_distinct(const std::vector<std::string>& files) {
    std::set<std::filesystem::path> seen;
    for (const std::string& file : files) {
        if (file.empty() || file == "-") continue;
        std::error_code ignored;
        const auto path = std::filesystem::absolute(file, ignored).lexically_normal();
        if (!seen.insert(std::filesystem::weakly_canonical(path, ignored)).second)
            throw UsageError("\"" + file + "\" is named twice among the outputs");
    }
}

}  // namespace plumb::app
