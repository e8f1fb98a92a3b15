// SPDX-License-Identifier: MIT
/// What is thrown on bad input. `what()` is one clear sentence; the parts are kept for programs.
#pragma once

#include <stdexcept>
#include <string>

namespace plumb {

/// A scene, mesh or setting that cannot be used (exit code 3).
class SceneError : public std::runtime_error {
public:
    /// `file` and `pointer` (a JSON pointer, "/bodies/3/mass") may be empty when the scene was made
    /// by a program.
    SceneError(std::string file, std::string pointer, const std::string& sentence)
        : std::runtime_error((file.empty() ? "" : file + ": ") +
                             (pointer.empty() ? "" : pointer + ": ") + sentence),
          file_(std::move(file)),
          pointer_(std::move(pointer)) {}

    const std::string& file() const { return file_; }
    const std::string& pointer() const { return pointer_; }

private:
    std::string file_, pointer_;
};

/// A collider that is missing, cannot be loaded, or lacks what the scene needs (exit code 4).
class ColliderError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace plumb
