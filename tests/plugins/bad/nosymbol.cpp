// SPDX-License-Identifier: MIT
/// A shared library that is no plugin at all.
extern "C" __attribute__((visibility("default"))) int plumb_is_not_here() { return 0; }
