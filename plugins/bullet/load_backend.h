// SPDX-License-Identifier: MIT
/// Bullet in one precision, loaded when it is first asked for.
///
/// Bullet's two precisions share symbols that are unique in a process
/// (btMatrix3x3::getIdentity()::identityMatrix), whatever the flags of dlopen: the second one that
/// is loaded reads the first one's bytes. So a plugin's table must be there without Bullet, and the
/// library beside it that links Bullet is loaded only into a process without the other precision.
#pragma once

#include "bullet/backend.h"

#include <string>

namespace plumb::bullet {

struct Backend {
    decltype(&plumb_bullet_create) create = nullptr;
    decltype(&plumb_bullet_destroy) destroy = nullptr;
    std::string refusal;  ///< why it cannot be used; empty when it can
};

/// The backend of this plugin's precision, loaded at the first call; or why there is none.
const Backend& load_backend();

}  // namespace plumb::bullet
