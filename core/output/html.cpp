// SPDX-License-Identifier: MIT
#include "output/html.h"

#include "output/deflate.h"
#include "output/html_json.h"
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

std::string data_element(std::string_view id, std::string_view type, std::string_view content) {
    std::string element =
        "<script id=\"" + std::string(id) + "\" type=\"" + std::string(type) + "\">";
    return element.append(content) + "</script>\n";
}

}  // namespace

void HtmlExporter::append(const Frame& frame) {
    for (std::size_t i = 0; i < motions_.size() && i < frame.bodies.size(); ++i) {
        const Placement& placement = frame.bodies[i].placement;
        motions_[i].push_back(pose_sample(placement.position - header_.origin, placement.rotation));
    }
    Frame note = frame;
    note.bodies.clear();
    notes_.push_back(std::move(note));
    if (notes_.size() == 1) balls_ = balls_of_interest(header_, frame);
    last_ = frame;
}

void HtmlExporter::finish() {
    const std::vector<Ball> now = balls_of_interest(header_, last_);
    balls_.insert(balls_.end(), now.begin(), now.end());
    const ReplayParts parts = replay_parts(header_, notes_, motions_, balls_);

    file_.append(kHead);
    file_.append(escaped(header_.name) + " \xc2\xb7 Plumb</title>\n</head>\n<body>\n");
    file_.append(data_element("plumb-scene", "application/json", parts.scene));
    file_.append(data_element("plumb-meshes", "text/plain", base64(deflated(parts.meshes))));
    file_.append(data_element("plumb-motion", "text/plain", base64(parts.motion)));
    file_.append("<script>\n");
    file_.append(player_script());
    file_.append("\n</script>\n</body>\n</html>\n");
    file_.commit();
}

}  // namespace plumb
