// SPDX-License-Identifier: MIT
#include "output/html_page.h"

#include "output/player.h"

namespace plumb {
namespace {

/// A page that lets nothing in from outside: the policy forbids every request.
constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:">
<title>)";

/// Text between tags.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

}  // namespace

std::string page_head(std::string_view title) {
    return std::string(kHead) + escaped(title) + " \xc2\xb7 Plumb</title>\n</head>\n<body>\n";
}

std::string data_element(std::string_view id, std::string_view type, std::string_view content) {
    std::string element =
        "<script id=\"" + std::string(id) + "\" type=\"" + std::string(type) + "\">";
    return element.append(content) + "</script>\n";
}

std::string without_tags(std::string_view json) {
    std::string text;
    for (const char c : json) {
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    }
    return text;
}

std::string page_end(std::string_view script) {
    return "<script>\n" + std::string(script) + "\n</script>\n</body>\n</html>\n";
}

std::string page_end() { return page_end(player_script()); }

}  // namespace plumb
