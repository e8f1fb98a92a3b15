// SPDX-License-Identifier: MIT
/// What the library that links Bullet exports to the plugin that holds the table.
#pragma once

#include <plumb/plugin.h>

extern "C" {
PLUMB_PLUGIN_EXPORT plumb::Proximity* plumb_bullet_create(const plumb::CreateRequest* request,
                                                          const char** message);
PLUMB_PLUGIN_EXPORT void plumb_bullet_destroy(plumb::Proximity* proximity);
}
