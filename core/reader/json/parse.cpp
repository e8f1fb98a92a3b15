// SPDX-License-Identifier: MIT
#include "reader/json/parse.h"

#include <algorithm>
#include <vector>

#include "scene/error.h"

namespace plumb::reader {

namespace {

constexpr std::size_t kDeepest = 64;  // levels of lists and objects inside each other

/// "line 3, column 14" of the byte before `position`.
std::string line_and_column(std::string_view text, std::size_t position) {
    const std::size_t at = std::min(position > 0 ? position - 1 : 0, text.size());
    const std::string_view before = text.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t newline = before.rfind('\n');
    const std::size_t column = newline == std::string_view::npos ? at + 1 : at - newline;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// The library's message without its "[json.exception…]" and its own count of lines.
std::string reason(std::string message) {
    if (const auto bracket = message.find("] "); bracket != std::string::npos) {
        message.erase(0, bracket + 2);
    }
    if (message.starts_with("parse error")) {
        if (const auto colon = message.find(": "); colon != std::string::npos) {
            message.erase(0, colon + 2);
        }
    }
    return message;
}

/// Whether the word that ends at `position` begins like NaN or an infinity, which JSON does not
/// have.
bool looks_not_finite(std::string_view text, std::size_t position) {
    std::string_view word = text.substr(0, position);
    word.remove_prefix(word.find_last_of(" \t\r\n:,[{/") + 1);  // npos + 1 is 0
    if (word.starts_with('-')) word.remove_prefix(1);
    return word.starts_with('N') || word.starts_with("na") || word.starts_with('I') ||
           word.starts_with('i');
}

/// Builds the tree while the library walks through the text.
class TreeBuilder final : public nlohmann::json_sax<Json> {
public:
    TreeBuilder(std::string_view text, const Source& source) : text_(text), source_(source) {}

    Json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(std::int64_t value) override { return add(value); }
    bool number_unsigned(std::uint64_t value) override { return add(value); }
    bool number_float(double value, const std::string&) override { return add(value); }
    bool string(std::string& value) override { return add(std::move(value)); }
    bool binary(Json::binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_array() override { return close(); }

    bool key(std::string& name) override {
        levels_.back().key = name;
        if (levels_.back().value->contains(name)) fail(pointer(), "the key stands here twice");
        return true;
    }

    bool parse_error(std::size_t position, const std::string&,
                     const Json::exception& error) override {
        std::string sentence = line_and_column(text_, position);
        sentence += ": ";
        if (looks_not_finite(text_, position)) {
            sentence += "JSON has no NaN and no infinity; write a finite number";
        } else {
            sentence += reason(error.what());
        }
        fail("", sentence);
    }

private:
    struct Level {
        Json*
            value;  ///< a list or an object that is still open; its parent does not grow meanwhile
        std::string key;  ///< of an object: the key that is being read
    };

    [[noreturn]] void fail(const std::string& at, const std::string& sentence) const {
        throw SceneError(source_.name, at, sentence);
    }

    std::string pointer() const {
        std::string path;
        for (const Level& level : levels_) {
            const bool list = level.value->is_array();
            path += '/';
            path += list ? std::to_string(level.value->size() - 1) : pointer_part(level.key);
        }
        return path;
    }

    Json* place(Json value) {
        if (levels_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Json& parent = *levels_.back().value;
        if (parent.is_array()) {
            parent.push_back(std::move(value));
            return &parent.back();
        }
        return &(parent[levels_.back().key] = std::move(value));
    }

    bool add(Json value) {
        place(std::move(value));
        return true;
    }

    bool open(Json value) {
        if (levels_.size() == kDeepest)
            fail("", "lists and objects stand too deep inside each other");
        levels_.push_back({place(std::move(value)), ""});
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    std::string_view text_;
    const Source& source_;
    Json root_;
    std::vector<Level> levels_;
};

}  // namespace

Json parse_json(std::string_view text, const Source& source) {
    TreeBuilder builder(text, source);
    Json::sax_parse(text.begin(), text.end(), &builder, Json::input_format_t::json, true, true);
    return builder.take();
}

}  // namespace plumb::reader
