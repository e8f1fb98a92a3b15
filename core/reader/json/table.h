// SPDX-License-Identifier: MIT
/// Tables: the keys of an object, each with its type, its meaning and where its value goes.
///
/// The reader walks through a table to fill a T, and the JSON Schema is written from the same
/// table, so the two cannot drift apart. Keys are read in the order of the table, whatever their
/// order in the file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reader/json/node.h"
#include "reader/json/types.h"
#include "scene/nearest.h"

namespace plumb::reader {

enum class Presence { optional, required };

template <class T>
struct Field {
    std::string key;
    std::string meaning;  ///< one line with its unit, shown by editors that know the schema
    SchemaJson schema;
    Presence presence;
    std::function<void(T&, const Node&)> read;
};

template <class T>
using Table = std::vector<Field<T>>;

/// A key whose value is of a simple type; `member` is a member pointer, or a function from T& to a
/// reference.
template <class T, class Type, class Member>
Field<T> field(std::string key, Type type, Member member, std::string meaning,
               Presence presence = Presence::optional) {
    const SchemaJson schema = type.schema();
    return {std::move(key), std::move(meaning), schema, presence,
            [type, member](T& target, const Node& node) {
                std::invoke(member, target) = type.read(node);
            }};
}

/// A key whose value is read by a function.
template <class T>
Field<T> special(std::string key, SchemaJson schema, std::function<void(T&, const Node&)> read,
                 std::string meaning, Presence presence = Presence::optional) {
    return {std::move(key), std::move(meaning), std::move(schema), presence, std::move(read)};
}

template <class T>
std::vector<std::string> keys_of(const Table<T>& table) {
    std::vector<std::string> keys;
    for (const auto& entry : table) keys.push_back(entry.key);
    return keys;
}

/// Fails on keys that are not among `allowed`.
void refuse_unknown_keys(const Node& node, const std::vector<std::string>& allowed);

/// Fills `target` from an object.
template <class T>
void read_object(T& target, const Node& node, const Table<T>& table) {
    if (!node.json().is_object()) node.fail_wanting("an object");
    refuse_unknown_keys(node, keys_of(table));
    for (const auto& entry : table) {
        if (node.has(entry.key)) {
            entry.read(target, node.at(entry.key));
        } else if (entry.presence == Presence::required) {
            node.fail("\"" + entry.key + "\" is missing");
        }
    }
}

/// The schema of an object that `read_object` accepts.
template <class T>
SchemaJson object_schema(const Table<T>& table) {
    SchemaJson properties = SchemaJson::object(), required = SchemaJson::array();
    for (const auto& entry : table) {
        SchemaJson schema = {{"description", entry.meaning}};
        schema.update(entry.schema);
        properties[entry.key] = std::move(schema);
        if (entry.presence == Presence::required) required.push_back(entry.key);
    }
    SchemaJson json = {
        {"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) json["required"] = required;
    return json;
}

/// {"$ref": "#/$defs/NAME"}.
SchemaJson reference_to(const std::string& definition);

/// A list whose items are of the definition NAME.
SchemaJson list_of(const std::string& definition);

/// An object whose keys are the user's names, and whose values are of the definition NAME.
SchemaJson names_of(const std::string& definition);

}  // namespace plumb::reader
