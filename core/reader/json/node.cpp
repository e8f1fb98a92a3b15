// SPDX-License-Identifier: MIT
#include "reader/json/node.h"

#include <cstdio>

#include "scene/error.h"

namespace plumb::reader {

namespace {

constexpr std::size_t kLongestShown = 40;  // characters of a value that an error repeats

/// A value in words: what it is, and when it is short, itself.
std::string described(const Json& json) {
    switch (json.type()) {
        case Json::value_t::object:
            return "an object";
        case Json::value_t::array:
            return "a list of " + std::to_string(json.size());
        case Json::value_t::string: {
            const auto& text = json.get_ref<const std::string&>();
            return text.size() <= kLongestShown ? "the text \"" + text + "\"" : "a long text";
        }
        default:
            return json.dump();
    }
}

/// Control characters as JSON writes them: a zero in a key would end the error's text.
std::string visible(const std::string& text) {
    std::string shown;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        char escape[8];
        std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(code));
        shown += code < 0x20 ? std::string(escape) : std::string(1, c);
    }
    return shown;
}

}  // namespace

std::string pointer_part(const std::string& key) {
    std::string part;
    for (const char c : key) {
        if (c == '~') {
            part += "~0";
        } else if (c == '/') {
            part += "~1";
        } else {
            part += c;
        }
    }
    return part;
}

Node Node::at(const std::string& key) const {
    return {json_->at(key), *source_, pointer_ + "/" + pointer_part(key)};
}

Node Node::at(std::size_t index) const {
    return {json_->at(index), *source_, pointer_ + "/" + std::to_string(index)};
}

void Node::fail(const std::string& sentence) const {
    throw SceneError(source_->name, visible(pointer_), visible(sentence));
}

void Node::fail_wanting(const std::string& wanted) const {
    fail("must be " + wanted + ", but is " + described(*json_));
}

void Node::require_one(const std::string& a, const std::string& b) const {
    if (has(a) == has(b))
        fail("must have either \"" + a + "\" or \"" + b + "\"" + (has(a) ? ", not both" : ""));
}

void Node::require_beside(const std::string& key, const std::string& owner) const {
    if (has(key) && !has(owner)) at(key).fail("\"" + key + "\" is for \"" + owner + "\" alone");
}

}  // namespace plumb::reader
