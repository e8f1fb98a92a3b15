// SPDX-License-Identifier: MIT
#include "host/cut_short.h"

#include <elf.h>
#include <link.h>

#include <cstdint>
#include <cstring>
#include <fstream>

namespace plumb {
namespace {

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);

constexpr unsigned char kOwnClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;

template <class T>
bool read_at(std::ifstream& file, std::uint64_t offset, T& value) {
    file.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof value));
}

bool own_kind(const Header& h) {
    return std::memcmp(h.e_ident, ELFMAG, SELFMAG) == 0 && h.e_ident[EI_CLASS] == kOwnClass &&
           h.e_phentsize == sizeof(Segment);
}

std::string sentence(std::uint64_t size) {
    return "it is cut short: its headers announce more than the " + std::to_string(size) +
           " bytes that it has";
}

}  // namespace

std::string cut_short(const std::filesystem::path& path) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    Header header{};
    if (error || !read_at(file, 0, header) || !own_kind(header)) return {};
    for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
        const std::uint64_t at = i * sizeof(Segment);
        Segment s{};
        // in this order no sum can overflow
        if (header.e_phoff > size || at > size - header.e_phoff ||
            !read_at(file, header.e_phoff + at, s))
            return sentence(size);
        if (s.p_type == PT_LOAD && (s.p_filesz > size || s.p_offset > size - s.p_filesz))
            return sentence(size);
    }
    return {};
}

}  // namespace plumb
