// SPDX-License-Identifier: MIT
/// Takes pages apart.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>

namespace plumb::test {

/// The text of an element of a page.
inline std::string element(const std::string& page, const std::string& id) {
    const std::string opening = "<script id=\"" + id + "\"";
    const std::size_t start = page.find('>', page.find(opening)) + 1;
    return page.substr(start, page.find("</script>", start) - start);
}

inline std::string from_base64(const std::string& text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') break;
        bits = (bits << 6) | static_cast<std::uint32_t>(letters.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<char>((bits >> count) & 0xff));
    }
    return bytes;
}

/// `size`: how many bytes there shall be.
inline std::string inflated(const std::string& bytes, std::size_t size) {
    std::string result(size + 1, '\0');
    uLongf length = size + 1;
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(result.data()), &length,
                         reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
              Z_OK);
    EXPECT_EQ(length, size);
    result.resize(length);
    return result;
}

}  // namespace plumb::test
