// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "reader/drafts.h"

namespace plumb::reader {

void Names::add(const std::string& name, std::uint32_t index, const Node& node) {
    if (!indices_.emplace(name, index).second) {
        node.fail("there is already a " + kind_ + " named \"" + name + "\"");
    }
}

std::uint32_t Names::find(const Node& node) const {
    const std::string name = Text{}.read(node);
    if (const auto found = indices_.find(name); found != indices_.end()) return found->second;

    std::vector<std::string> known;
    for (const auto& entry : indices_) known.push_back(entry.first);
    std::sort(known.begin(), known.end());
    node.fail("there is no " + kind_ + " named \"" + name + "\"" + advice(name, known));
}

std::string numbered(const std::string& name, std::size_t number) {
    if (name.empty()) return "";
    char text[32];
    std::snprintf(text, sizeof text, "_%04zu", number);
    return name + text;
}

}  // namespace plumb::reader
