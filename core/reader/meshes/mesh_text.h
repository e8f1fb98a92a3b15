// SPDX-License-Identifier: MIT
/// The words of a mesh's text file, with the line that each stands in.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/bad_shape.h"
#include "reader/meshes/words.h"

namespace plumb::reader {

class MeshText {
public:
    /// `comment` begins what is passed over up to the end of its line; 0: nothing does.
    MeshText(std::string text, char comment) : text_(std::move(text)), comment_(comment) {}

    bool at_end() {
        skip();
        return at_ == text_.size();
    }

    /// The next word; `wanted` says what it is if the text ends before it.
    std::string_view word(const std::string& wanted) {
        if (at_end()) fail("the file ends where " + wanted + " should follow");
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return std::string_view(text_).substr(begin, at_ - begin);
    }

    std::uint64_t whole(const std::string& wanted) {
        return number<std::uint64_t>(wanted, "a whole number, ");
    }

    double finite(const std::string& wanted) {
        const double value = number<double>(wanted, "a finite number, ");
        if (!std::isfinite(value)) fail("there must be a finite number, " + wanted);
        return value;
    }

    /// Passes over the words that are left in this line.
    void end_line() {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    }

    [[noreturn]] void fail(const std::string& sentence) const {
        throw BadShape("line " + std::to_string(line_) + ": " + sentence);
    }

private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

    void skip() {
        for (; at_ < text_.size(); ++at_) {
            if (comment_ != 0 && text_[at_] == comment_) end_line();
            if (at_ == text_.size() || !is_blank(text_[at_])) return;
            if (text_[at_] == '\n') ++line_;
        }
    }

    template <class T>
    T number(const std::string& wanted, const std::string& kind) {
        const std::string_view text = without_plus(word(wanted));
        const std::optional<T> value = number_of<T>(text);
        if (!value)
            fail("there must be " + kind + wanted + ", not \"" + std::string(text.substr(0, 40)) +
                 "\"");
        return *value;
    }

    std::string text_;
    char comment_;
    std::size_t at_ = 0, line_ = 1;
};

}  // namespace plumb::reader
