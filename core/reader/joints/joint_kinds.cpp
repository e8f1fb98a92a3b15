// SPDX-License-Identifier: MIT
#include "reader/joints/joint_kinds.h"

#include <array>

namespace plumb::reader {

namespace {

constexpr std::size_t kKinds = static_cast<std::size_t>(JointKind::six_axis) + 1;

/// In the order of JointKind; a and b are the two bodies.
const std::array<KindTraits, kKinds>& all_traits() {
    constexpr Use no = Use::none, may = Use::optional, must = Use::required;
    const NamedAxis x{"x", kAlongX}, y{"y", kAlongY}, z{"z", kAlongZ};
    const NamedAxis tx{"turn_x", kTurnX}, ty{"turn_y", kTurnY}, tz{"turn_z", kTurnZ};
    const NamedAxis twist{"twist", kTurnX}, swing{"swing", kTurnY};
    const char* line = "a's anchor stays on b's line along axis";
    const char* plane = "a's anchor stays in b's plane across axis";
    const char* universal = "turns about b's axis and a's second_axis";
    const char* cylindrical = "moves along axis and turns about it";
    const char* planar = "moves across axis and turns about it";
    const char* cone = "a ball that twists about axis and swings away from it";
    const char* six = "free but for what locked says";
    const char* rod = "the anchors keep their distance, stay within its limits or hang on a spring";
    const char* perpendicular = "b's axis and a's second_axis stay perpendicular";
    static const std::array<KindTraits, kKinds> traits{{
        {"ball", "one common point", no, no, true, false, {tx, ty, tz}, false},
        {"point_on_line", line, must, may, true, false, {x, tx, ty, tz}, true},
        {"point_on_plane", plane, must, may, true, false, {y, z, tx, ty, tz}, false},
        {"orientation", "both turn as one", no, no, false, true, {x, y, z}, false},
        {"parallel", "axis stays parallel", must, may, false, true, {x, y, z, tx}, false},
        {"perpendicular", perpendicular, must, must, false, true, {x, y, z, tx, ty}, false},
        {"fixed", "both move as one", no, no, true, true, {}, false},
        {"hinge", "turns about axis", must, may, true, true, {tx}, true},
        {"universal", universal, must, must, true, true, {tx, ty}, false},
        {"slider", "moves along axis", must, may, true, true, {x}, true},
        {"cylindrical", cylindrical, must, may, true, true, {x, tx}, false},
        {"planar", planar, must, may, true, true, {y, z, tx}, false},
        {"distance", rod, no, no, true, false, {x}, true},
        {"cone_twist", cone, must, may, true, false, {twist, swing}, false},
        {"six_axis", six, may, may, true, true, joint_axes(), false},
    }};
    return traits;
}

void add(std::vector<std::string>& keys, bool wanted, std::initializer_list<const char*> more) {
    if (wanted) keys.insert(keys.end(), more.begin(), more.end());
}

}  // namespace

const std::vector<NamedAxis>& joint_axes() {
    static const std::vector<NamedAxis> axes{{"x", kAlongX},     {"y", kAlongY},
                                             {"z", kAlongZ},     {"turn_x", kTurnX},
                                             {"turn_y", kTurnY}, {"turn_z", kTurnZ}};
    return axes;
}

const KindTraits& traits_of(JointKind kind) { return all_traits()[static_cast<std::size_t>(kind)]; }

Choice<JointKind> joint_kinds() {
    Choice<JointKind> choice;
    for (std::size_t i = 0; i < kKinds; ++i)
        choice.words.emplace_back(all_traits()[i].name, static_cast<JointKind>(i));
    return choice;
}

std::string joint_kinds_in_words() {
    std::string text = "kind of joint, of bodies a and b. ";
    for (const KindTraits& traits : all_traits())
        text += (traits.name == "ball" ? "" : "; ") + traits.name + ": " + traits.meaning;
    return text;
}

std::vector<std::string> names_of_axes(const std::vector<NamedAxis>& axes) {
    std::vector<std::string> names;
    for (const NamedAxis& axis : axes) names.push_back(axis.first);
    return names;
}

std::vector<std::string> required_keys(JointKind kind) {
    const KindTraits& t = traits_of(kind);
    std::vector<std::string> keys{"type", "bodies"};
    add(keys, t.translations, {"anchor"});
    add(keys, kind == JointKind::distance, {"anchor_b"});
    add(keys, t.axis == Use::required, {"axis"});
    add(keys, t.second_axis == Use::required, {"second_axis"});
    return keys;
}

std::vector<std::string> usable_keys(JointKind kind) {
    const KindTraits& t = traits_of(kind);
    std::vector<std::string> keys{"name", "type", "bodies", "anchor"};
    add(keys, kind == JointKind::distance, {"anchor_b"});
    add(keys, t.axis != Use::none, {"axis"});
    add(keys, t.second_axis != Use::none, {"second_axis"});
    add(keys, kind == JointKind::six_axis, {"locked"});
    add(keys, t.has_main_axis, {"limits", "motor", "spring", "friction", "max_speed"});
    add(keys, !t.axes.empty(), {"axes"});
    add(keys, t.translations, {"compliance", "breaking_force"});
    add(keys, t.rotations, {"angular_compliance", "breaking_torque"});
    add(keys, true, {"collide"});
    return keys;
}

SchemaJson rules_of_kinds() {
    SchemaJson rules = SchemaJson::array();
    for (std::size_t i = 0; i < kKinds; ++i) {
        const auto kind = static_cast<JointKind>(i);
        SchemaJson then = {{"required", required_keys(kind)},
                           {"propertyNames", {{"enum", usable_keys(kind)}}}};
        if (!traits_of(kind).axes.empty()) {
            const SchemaJson names = {{"enum", names_of_axes(traits_of(kind).axes)}};
            then["properties"] = {{"axes", {{"propertyNames", names}}}};
        }
        rules.push_back({{"if", {{"properties", {{"type", {{"const", traits_of(kind).name}}}}}}},
                         {"then", then}});
    }
    return rules;
}

}  // namespace plumb::reader
