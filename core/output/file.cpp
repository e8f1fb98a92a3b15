// SPDX-License-Identifier: MIT
#include "output/file.h"

#include "output/error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace plumb {
namespace {

/// "cannot be written: No space left on device"
std::string with_reason(const char* sentence, int error) {
    return std::string(sentence) + ": " + std::strerror(error);
}

/// A name beside `path` for the time of writing; where `path` is there already and is no ordinary
/// file, such as a directory, the rename would fail only after the run, so it is refused here.
std::string temporary_name(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw OutputError(path, with_reason("cannot be written", EISDIR));
    }
    return path + ".partial";
}

}  // namespace

std::string written_place(const std::string& path) {
    constexpr int kMostLinks = 40;  // as many as the system follows
    std::filesystem::path place = path;
    std::error_code error;
    for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(place, error); ++i) {
        const std::filesystem::path target = std::filesystem::read_symlink(place, error);
        place = target.is_absolute() ? target : place.parent_path() / target;
    }
    return place.string();
}

AppendFile::AppendFile(std::string path)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
    if (!file_) throw OutputError(path_, with_reason("cannot be opened for writing", errno));
}

void AppendFile::append(std::string_view bytes) {
    errno = 0;
    const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), file_.get());
    if (written != bytes.size() || std::fflush(file_.get()) != 0) {
        throw OutputError(path_, with_reason("cannot be written", errno));
    }
}

void AppendFile::close() {
    if (!file_) return;
    errno = 0;
    if (std::fclose(file_.release()) != 0) {
        throw OutputError(path_, with_reason("cannot be written", errno));
    }
}

WholeFile::WholeFile(std::string path)
    : path_(std::move(path)), place_(written_place(path_)), file_(temporary_name(place_)) {}

WholeFile::~WholeFile() {
    if (!committed_) std::remove(file_.path().c_str());
}

void WholeFile::commit() {
    file_.close();
    if (std::rename(file_.path().c_str(), place_.c_str()) != 0) {
        throw OutputError(path_, with_reason("cannot be written", errno));
    }
    committed_ = true;
}

std::string read_file(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (!file) throw UnreadableFile(path, with_reason("cannot be opened for reading", errno));
    std::string content;
    char buffer[1 << 16];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get())) {
        content.append(buffer, count);
    }
    if (std::ferror(file.get())) throw UnreadableFile(path, with_reason("cannot be read", errno));
    return content;
}

}  // namespace plumb
