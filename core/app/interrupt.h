// SPDX-License-Identifier: MIT
/// Ctrl-C: a run ends after its present step, and completes its outputs.
#pragma once

namespace plumb::app {

/// From here on SIGINT and SIGTERM only set a flag; a second SIGINT ends the program at once.
void catch_interrupts();
bool interrupted();

}  // namespace plumb::app
