// SPDX-License-Identifier: MIT
#include "app/interrupt.h"

#include <csignal>
#include <cstdlib>

namespace plumb::app {
namespace {

volatile std::sig_atomic_t asked = 0;

void on_signal(int signal) {
    if (asked) std::_Exit(128 + signal);
    asked = 1;
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

bool interrupted() { return asked != 0; }

}  // namespace plumb::app
