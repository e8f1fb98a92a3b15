// SPDX-License-Identifier: MIT
/// A JSON value together with where it stands, so that every complaint can name its place.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace plumb::reader {

using Json = nlohmann::json;

/// Where a text comes from. Outlives every Node made from it.
struct Source {
    std::string name;              ///< as errors show it
    std::filesystem::path folder;  ///< that relative mesh files start from
};

class Node {
public:
    Node(const Json& json, const Source& source, std::string pointer = "")
        : json_(&json), source_(&source), pointer_(std::move(pointer)) {}

    const Json& json() const { return *json_; }
    const Source& source() const { return *source_; }
    std::size_t size() const { return json_->size(); }
    bool has(const std::string& key) const { return json_->is_object() && json_->contains(key); }

    /// The value of a key that is there, and the element of an index that is there.
    Node at(const std::string& key) const;
    Node at(std::size_t index) const;

    /// Throws SceneError at this place.
    [[noreturn]] void fail(const std::string& sentence) const;

    /// Throws "must be WANTED, but is what stands here".
    [[noreturn]] void fail_wanting(const std::string& wanted) const;

    /// Throws unless exactly one of two keys is there.
    void require_one(const std::string& a, const std::string& b) const;

    /// Throws where a key is there without the one that it belongs to.
    void require_beside(const std::string& key, const std::string& owner) const;

private:
    const Json* json_;
    const Source* source_;
    std::string pointer_;
};

/// A part of a JSON pointer with "~" and "/" escaped (RFC 6901).
std::string pointer_part(const std::string& key);

}  // namespace plumb::reader
