// SPDX-License-Identifier: MIT
#include "reader/urdf_file.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <vector>

#include "reader/file_text.h"

namespace plumb::reader {

namespace {

constexpr std::size_t kMostLinks = 10'000;
constexpr int kDeepest = 100;  // elements within elements; the parser calls itself for each

/// Collects what urdfdom would print, for as long as it lives.
class Listener : public console_bridge::OutputHandler {
public:
    Listener()
        : before_(console_bridge::getOutputHandler()), level_(console_bridge::getLogLevel()) {
        console_bridge::useOutputHandler(this);
        console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_ERROR);
    }
    ~Listener() override {
        console_bridge::setLogLevel(level_);
        console_bridge::useOutputHandler(before_);
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
        // The last word of a failure, which says nothing that was not said before.
        const bool empty = text.find("xml is not initialized correctly") != std::string::npos;
        if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR || (empty && !errors_.empty())) return;
        errors_ += (errors_.empty() ? "" : "; ") + text;
    }

    /// All errors in one sentence; "" where there are none.
    const std::string& errors() const { return errors_; }

private:
    console_bridge::OutputHandler* before_;
    console_bridge::LogLevel level_;
    std::string errors_;
};

/// How deep elements stand within each other; comments count as nothing.
int nesting(std::string_view text) {
    int depth = 0, deepest = 0;
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
        if (text.substr(at, 4) == "<!--") {
            at = std::min(text.find("-->", at), text.size());
            continue;
        }
        const std::size_t end = std::min(text.find('>', at), text.size());
        const char first = at + 1 < text.size() ? text[at + 1] : ' ';
        if (first == '/') {
            --depth;
        } else if (first != '!' && first != '?' && text[end - 1] != '/') {
            deepest = std::max(deepest, ++depth);
        }
        at = end;
    }
    return deepest;
}

void keep_only(TiXmlElement& parent, const std::set<std::string>& names) {
    for (TiXmlNode* child = parent.FirstChild(); child;) {
        TiXmlNode* next = child->NextSibling();
        if (!child->ToElement() || !names.contains(child->ValueStr())) parent.RemoveChild(child);
        child = next;
    }
}

/// The text with nothing but what a simulation needs. Throws what is wrong, as a sentence.
std::string essence(const std::string& text) {
    if (nesting(text) > kDeepest) throw BadRobot("elements are nested too deeply");
    TiXmlDocument document;
    document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
    if (document.Error()) {
        std::string reason = document.ErrorDesc();
        while (reason.ends_with('.')) reason.pop_back();
        // There is no line where the text ends too early.
        const int row = document.ErrorRow();
        throw BadRobot((row > 0 ? "line " + std::to_string(row) + ": " : "") +
                       "not good XML: " + reason);
    }
    TiXmlElement* robot = document.FirstChildElement("robot");
    if (!robot) throw BadRobot("there is no \"robot\" element in it");
    keep_only(*robot, {"link", "joint"});
    for (TiXmlElement* e = robot->FirstChildElement(); e; e = e->NextSiblingElement()) {
        keep_only(*e, e->ValueStr() == "link"
                          ? std::set<std::string>{"inertial", "collision"}
                          : std::set<std::string>{"origin", "parent", "child", "axis", "limit",
                                                  "dynamics", "mimic"});
    }
    TiXmlPrinter printer;
    document.Accept(&printer);
    return printer.Str();
}

/// Throws what urdfdom complains of, in one sentence.
urdf::ModelInterfaceSharedPtr parse(const std::string& text) {
    static std::mutex one_at_a_time;  // the listener is the whole program's
    const std::lock_guard lock(one_at_a_time);
    const Listener listener;
    urdf::ModelInterfaceSharedPtr model;
    try {
        model = urdf::parseURDF(text);
    } catch (const std::exception& error) {
        throw BadRobot(std::string("not a good robot description: ") + error.what());
    }
    if (!listener.errors().empty()) throw BadRobot(listener.errors());
    if (!model) throw BadRobot("not a good robot description");
    return model;
}

/// urdfdom takes links with two parents, and rings of links beside the tree.
void check_tree(const urdf::ModelInterface& model) {
    if (model.links_.size() > kMostLinks)
        throw BadRobot("it has more than " + std::to_string(kMostLinks) + " links");
    std::map<std::string, std::string> parent_joints;
    for (const auto& [name, joint] : model.joints_) {
        const auto [other, is_new] = parent_joints.emplace(joint->child_link_name, name);
        if (!is_new) {
            throw BadRobot(link_named(joint->child_link_name) + " is the child of two joints, \"" +
                           other->second + "\" and \"" + name + "\"; a robot is a tree");
        }
    }

    std::set<std::string> reached;
    std::vector<const urdf::Link*> open{model.root_link_.get()};
    while (!open.empty()) {
        const urdf::Link* link = open.back();
        open.pop_back();
        reached.insert(link->name);
        for (const auto& child : link->child_links) open.push_back(child.get());
    }
    for (const auto& entry : model.links_) {
        if (!reached.contains(entry.first)) {
            throw BadRobot(link_named(entry.first) + " is in a ring of joints that the root, \"" +
                           model.root_link_->name + "\", does not reach; a robot is a tree");
        }
    }
}

}  // namespace

urdf::ModelInterfaceSharedPtr load_urdf(const std::filesystem::path& file) {
    urdf::ModelInterfaceSharedPtr model = parse(essence(text_of_file(file)));
    check_tree(*model);
    return model;
}

}  // namespace plumb::reader
