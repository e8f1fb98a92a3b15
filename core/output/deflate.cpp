// SPDX-License-Identifier: MIT
#include "output/deflate.h"

#include <zlib.h>

#include <cstdint>
#include <new>

namespace plumb {

std::string deflated(std::string_view bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string result(size, '\0');
    const int status = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()),
                                 static_cast<uLong>(bytes.size()), 9);
    if (status != Z_OK)
        throw std::bad_alloc();  // the room suffices, so that only memory can be missing
    result.resize(size);
    return result;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const unsigned char byte =
                i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0;
            group = (group << 8) | byte;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const bool there = i + k < bytes.size() + 1;
            text += there ? kLetters[(group >> (18 - 6 * k)) & 63u] : '=';
        }
    }
    return text;
}

}  // namespace plumb
