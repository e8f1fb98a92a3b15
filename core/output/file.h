// SPDX-License-Identifier: MIT
/// Files that exporters write to. Every failure throws OutputError with the path and the system's
/// words.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace plumb {

/// A file that grows. What `append` was given has left the program when it returns, so that a crash
/// of the program loses nothing of it.
class AppendFile {
public:
    /// Begins the file anew.
    explicit AppendFile(std::string path);

    void append(std::string_view bytes);

    /// Closes the file; what the system could not write after all is reported here.
    void close();

    const std::string& path() const { return path_; }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
};

/// A file that appears whole or not at all: it is written under a temporary name beside its own,
/// and renamed. Where the path is a symbolic link, all this is done where that leads.
class WholeFile {
public:
    /// Opens the temporary file, so that a path that cannot be written is known before the run.
    explicit WholeFile(std::string path);
    /// Removes the temporary file when `commit` was never reached.
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    void append(std::string_view bytes) { file_.append(bytes); }

    /// Closes the file and gives it its name.
    void commit();

    const std::string& path() const { return path_; }

private:
    std::string path_, place_;
    AppendFile file_;
    bool committed_ = false;
};

/// Where what is written to a path arrives: symbolic links are followed, also to what is not there.
std::string written_place(const std::string& path);

/// The whole content of a file.
std::string read_file(const std::string& path);

}  // namespace plumb
