// SPDX-License-Identifier: MIT
/// What mesh and hull code throws; the reader adds the file and the place of the scene that asked.
#pragma once

#include <stdexcept>

namespace plumb {

/// A mesh or a set of points that is no shape; `what()` is one sentence.
class BadShape : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace plumb
