// SPDX-License-Identifier: MIT
/// Changes of a world between two steps: bodies and joints come and go.
///
/// What stays keeps all its state. The rows of the velocity table (assign_rows) and whoever holds
/// them are out of date after a body came or went.
#pragma once

#include "world/body_row.h"
#include "world/build_joints.h"

namespace plumb {

/// Puts a body in the lowest vacant slot, or at the end. Its identifier comes back.
std::uint32_t insert_body(World& world, BodyRow row);

/// Takes away a body that no joint has any more, and all that is remembered of its contacts.
void erase_body(World& world, std::uint32_t slot);

/// Forgets the impulses, anchors and kept contacts of a body, as if it touched nothing before.
void forget_contacts(World& world, std::uint32_t slot);

/// Its identifier comes back.
std::uint32_t insert_joint(World& world, JointDraft draft);

/// A joint keeps its bodies apart no more; others may.
void stop_keeping_apart(World& world, Joint& joint);

/// Takes away a joint, with its drives and the couplings that tie it.
void erase_joint(World& world, std::uint32_t index);

void erase_coupling(World& world, std::uint32_t index);

}  // namespace plumb
