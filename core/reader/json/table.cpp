// SPDX-License-Identifier: MIT
#include "reader/json/table.h"

#include <algorithm>

namespace plumb::reader {

void refuse_unknown_keys(const Node& node, const std::vector<std::string>& allowed) {
    for (const auto& item : node.json().items()) {
        if (std::find(allowed.begin(), allowed.end(), item.key()) != allowed.end()) continue;
        node.at(item.key())
            .fail("unknown key \"" + item.key() + "\"" + advice(item.key(), allowed));
    }
}

SchemaJson reference_to(const std::string& definition) {
    return {{"$ref", "#/$defs/" + definition}};
}

SchemaJson list_of(const std::string& definition) {
    return {{"type", "array"}, {"items", reference_to(definition)}};
}

SchemaJson names_of(const std::string& definition) {
    return {{"type", "object"}, {"additionalProperties", reference_to(definition)}};
}

}  // namespace plumb::reader
