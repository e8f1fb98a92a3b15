// SPDX-License-Identifier: MIT
/// "attach": points of a deformable, picked by number or by place.
#include <algorithm>
#include <numeric>

#include "reader/deformables/deformables.h"

namespace plumb::reader {

namespace {

struct AttachmentDraft {
    SceneDraft* scene;
    const DeformableSpec* deformable;
    AttachmentSpec spec;
};
using A = AttachmentDraft;

struct Near {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double radius = 0;
};

const Table<Near>& near_table() {
    static const Table<Near> table = {
        field<Near>("point", Vector3{kCoordinate}, &Near::point, "world frame [m]",
                    Presence::required),
        field<Near>("radius", Number{kLength}, &Near::radius, "[m]", Presence::required),
    };
    return table;
}

struct Within {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(), half_extents = Eigen::Vector3d::Zero();
};

const Table<Within>& within_table() {
    static const Table<Within> table = {
        field<Within>("centre", Vector3{kCoordinate}, &Within::centre, "world frame [m]",
                      Presence::required),
        field<Within>("half_extents", Vector3{kLength}, &Within::half_extents,
                      "along the axes of the world, half the length of each edge [m]",
                      Presence::required),
    };
    return table;
}

/// Takes the points whose distance is 0; fails with the least distance where there are none.
template <class Distance>
void pick(A& attachment, const Node& node, const std::string& what, Distance distance) {
    const auto& points = attachment.deformable->points;
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const double d = distance(points[i]);
        if (!(d > 0)) attachment.spec.points.push_back(i);
        if (d < least) least = d, nearest = i;
    }
    if (attachment.spec.points.empty())
        node.fail("there is no point " + what + "; the nearest, point " + std::to_string(nearest) +
                  ", is " + short_number(least) + " m away from it");
}

void pick_near(A& attachment, const Node& node) {
    Near near;
    read_object(near, node, near_table());
    pick(attachment, node, "within the radius", [&](const Eigen::Vector3d& p) {
        return std::max(0.0, (p - near.point).norm() - near.radius);
    });
}

void pick_within(A& attachment, const Node& node) {
    Within box;
    read_object(box, node, within_table());
    pick(attachment, node, "in the box", [&](const Eigen::Vector3d& p) {
        return ((p - box.centre).cwiseAbs() - box.half_extents).cwiseMax(0).norm();
    });
}

void pick_all(A& attachment, const Node& node) {
    if (!Flag{}.read(node)) node.fail("must be true, or left out");
    attachment.spec.points.resize(attachment.deformable->points.size());
    std::iota(attachment.spec.points.begin(), attachment.spec.points.end(), 0u);
}

void pick_listed(A& attachment, const Node& node) {
    if (!node.json().is_array() || node.size() == 0)
        node.fail_wanting("a list of at least one number of a point");
    const Whole<std::uint32_t> index{{0, static_cast<double>(kMaxParticles - 1)}};
    for (std::size_t i = 0; i < node.size(); ++i)
        attachment.spec.points.push_back(index.read(node.at(i)));
}

const Table<A>& attachment_table() {
    const SchemaJson numbers = {
        {"type", "array"},
        {"items", Whole<std::uint32_t>{{0, static_cast<double>(kMaxParticles - 1)}}.schema()},
        {"minItems", 1},
        {"uniqueItems", true}};
    static const Table<A> table = {
        special<A>("points", numbers, pick_listed, "by their numbers, from 0"),
        special<A>("near", object_schema(near_table()), pick_near, "those in a ball"),
        special<A>("box", object_schema(within_table()), pick_within, "those in a box"),
        special<A>("all", {{"const", true}}, pick_all, "every point"),
        special<A>(
            "to", Text{}.schema(),
            [](A& a, const Node& n) { a.spec.body = a.scene->bodies.find(n); },
            "name of a body; left out: the world"),
        field<A>(
            "compliance", Number{kCoupling}, [](A & a) -> auto& { return a.spec.compliance; },
            "[m/N]; 0, the default, is rigid"),
    };
    return table;
}

}  // namespace

std::vector<AttachmentSpec> read_attachments(SceneDraft& draft, const DeformableSpec& deformable,
                                             const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of attachments");
    std::vector<AttachmentSpec> list;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Node entry = node.at(i);
        AttachmentDraft attachment{&draft, &deformable, {}};
        read_object(attachment, entry, attachment_table());
        if (entry.has("points") + entry.has("near") + entry.has("box") + entry.has("all") != 1)
            entry.fail("must have one of \"points\", \"near\", \"box\" and \"all\"");
        list.push_back(std::move(attachment.spec));
    }
    return list;
}

void add_attachment_definitions(SchemaJson& definitions) {
    SchemaJson schema = object_schema(attachment_table());
    schema["oneOf"] = SchemaJson::array();
    for (const char* key : {"points", "near", "box", "all"})
        schema["oneOf"].push_back({{"required", {key}}});
    definitions["attachment"] = schema;
}

}  // namespace plumb::reader
