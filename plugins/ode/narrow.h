// SPDX-License-Identifier: MIT
/// What ODE says about a pair, and how it becomes contacts.
#pragma once

#include "ode/geoms.h"

namespace plumb::ode {

/// Where contacts go.
struct Output {
    ContactList& contacts;
    DetectStats& stats;
};

/// Contacts of two parts, a before b; neither is a mesh.
void collide_convex(Output out, const Part& a, const Part& b);

/// Contacts of two parts of which at least one is a mesh.
void collide_mesh(Output out, const Part& a, const Part& b);

/// What ODE itself says: its points and depths, nothing else.
void collide_raw(Output out, const Part& a, const Part& b);

}  // namespace plumb::ode
