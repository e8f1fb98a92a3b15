// SPDX-License-Identifier: MIT
/// What each kind of joint means and can use: which of its axes are free, and which keys it takes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reader/json/types.h"
#include "scene/joint.h"

namespace plumb::reader {

/// Whether a key means anything to a kind.
enum class Use { none, optional, required };

/// An axis as a file names it.
using NamedAxis = std::pair<std::string, JointAxis>;

struct KindTraits {
    std::string name;
    std::string meaning;
    Use axis, second_axis;
    bool translations, rotations;  ///< whether it locks any
    std::vector<NamedAxis> axes;   ///< that it leaves free
    bool has_main_axis;            ///< the first of them, which "limits" beside "type" belong to
};

const KindTraits& traits_of(JointKind kind);
Choice<JointKind> joint_kinds();

/// One line for each kind.
std::string joint_kinds_in_words();

/// x, y, z, turn_x, turn_y, turn_z.
const std::vector<NamedAxis>& joint_axes();
std::vector<std::string> names_of_axes(const std::vector<NamedAxis>& axes);

/// The keys that a joint of this kind must have, and those that it may have.
std::vector<std::string> required_keys(JointKind kind);
std::vector<std::string> usable_keys(JointKind kind);

/// What the schema says of kinds, beside the keys of them all.
SchemaJson rules_of_kinds();

}  // namespace plumb::reader
