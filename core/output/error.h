// SPDX-License-Identifier: MIT
/// What is thrown when a result cannot be written or read back. `what()` is one clear sentence.
#pragma once

#include <stdexcept>
#include <string>

namespace plumb {

/// A file that cannot be written or read: names the path, and says what the system said about it.
class OutputError : public std::runtime_error {
public:
    OutputError(std::string path, const std::string& sentence)
        : std::runtime_error(path + ": " + sentence), path_(std::move(path)) {}

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// A file that cannot be read back.
class UnreadableFile : public OutputError {
    using OutputError::OutputError;
};

/// The ending of a file's name is that of no kind of output.
class UnknownEnding : public OutputError {
    using OutputError::OutputError;
};

}  // namespace plumb
