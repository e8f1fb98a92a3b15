// SPDX-License-Identifier: MIT
#include "reader/json/types.h"

#include <cmath>
#include <cstdio>

#include "reader/json/lists.h"

namespace plumb::reader {

namespace {

bool inside(const Range& range, double value) { return value >= range.low && value <= range.high; }

}  // namespace

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

std::string in_words(const Range& range, const std::string& noun) {
    const std::string above = range.low > 0 && range.low < 1 ? noun + " above 0," : noun;
    return above + " from " + short_number(range.low) + " to " + short_number(range.high);
}

void require_list(const Node& node, std::size_t count, const std::string& noun) {
    if (node.json().is_array() && node.size() == count) return;
    node.fail_wanting("a list of " + std::to_string(count) + " " + noun);
}

double Number::read(const Node& node) const {
    if (!node.json().is_number()) node.fail_wanting(in_words(range, "a number"));
    const double value = node.json().get<double>();
    if (!inside(range, value)) node.fail_wanting(in_words(range, "a number"));
    return value;
}

SchemaJson Number::schema() const {
    SchemaJson json = {{"type", "number"}};
    if (range.low != kAny.low) json["minimum"] = range.low;
    if (range.high != kAny.high) json["maximum"] = range.high;
    return json;
}

template <class T>
T Whole<T>::read(const Node& node) const {
    if (!node.json().is_number()) node.fail_wanting(in_words(range, "a whole number"));
    const double value = node.json().get<double>();
    if (!inside(range, value) || std::trunc(value) != value) {
        node.fail_wanting(in_words(range, "a whole number"));
    }
    return static_cast<T>(value);
}

template <class T>
SchemaJson Whole<T>::schema() const {
    return {{"type", "integer"},
            {"minimum", static_cast<std::int64_t>(range.low)},
            {"maximum", static_cast<std::int64_t>(range.high)}};
}

template struct Whole<std::uint32_t>;
template struct Whole<std::uint64_t>;

Eigen::Vector3d Vector3::read(const Node& node) const {
    require_list(node, 3, "numbers");
    const Number number{range};
    return {number.read(node.at(0)), number.read(node.at(1)), number.read(node.at(2))};
}

SchemaJson Vector3::schema() const { return list_schema(Number{range}.schema(), 3); }

bool Flag::read(const Node& node) const {
    if (!node.json().is_boolean()) node.fail_wanting("true or false");
    return node.json().get<bool>();
}

SchemaJson Flag::schema() const { return {{"type", "boolean"}}; }

std::array<bool, 3> Flags3::read(const Node& node) const {
    require_list(node, 3, "flags (true or false)");
    const Flag flag;
    return {flag.read(node.at(0)), flag.read(node.at(1)), flag.read(node.at(2))};
}

SchemaJson Flags3::schema() const { return list_schema(Flag{}.schema(), 3); }

std::string Text::read(const Node& node) const {
    if (!node.json().is_string() || node.json().get_ref<const std::string&>().empty()) {
        node.fail_wanting("a text that is not empty");
    }
    return node.json().get<std::string>();
}

SchemaJson Text::schema() const { return {{"type", "string"}, {"minLength", 1}}; }

std::vector<std::string> TextList::read(const Node& node) const {
    if (!node.json().is_array()) node.fail_wanting("a list of texts");
    std::vector<std::string> list;
    for (std::size_t i = 0; i < node.size(); ++i) list.push_back(Text{}.read(node.at(i)));
    return list;
}

SchemaJson TextList::schema() const { return {{"type", "array"}, {"items", Text{}.schema()}}; }

std::uint32_t Color::read(const Node& node) const {
    const std::string wanted = "a colour such as \"#ff8800\"";
    if (!node.json().is_string()) node.fail_wanting(wanted);
    const auto& text = node.json().get_ref<const std::string&>();
    const bool hex = text.size() == 7 && text[0] == '#' &&
                     text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!hex) node.fail_wanting(wanted);
    return std::max<std::uint32_t>(
        1, static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16)));
}

SchemaJson Color::schema() const { return {{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}}; }

}  // namespace plumb::reader
