// SPDX-License-Identifier: MIT
/// "links".
#include "reader/deformables/deformables.h"
#include "scene/link_faults.h"

namespace plumb::reader {

namespace {

struct EndDraft {
    SceneDraft* scene;
    ScenePoint end;
    std::optional<std::uint32_t> point;
    std::optional<Eigen::Vector3d> near, position;
};

struct LinkDraft {
    SceneDraft* scene;
    LinkSpec spec;
};

const Table<EndDraft>& end_table() {
    using E = EndDraft;
    const Whole<std::uint32_t> number{{0, static_cast<double>(kMaxParticles - 1)}};
    static const Table<E> table = {
        special<E>(
            "deformable", Text{}.schema(),
            [](E& e, const Node& n) { e.end.deformable = e.scene->deformables.find(n); },
            "name of a deformable, with \"point\" or \"near\""),
        field<E>("point", number, &E::point, "of the deformable, by its number, from 0"),
        field<E>("near", Vector3{kCoordinate}, &E::near,
                 "the point of the deformable that is nearest to here, world frame [m]"),
        special<E>(
            "body", Text{}.schema(),
            [](E& e, const Node& n) { e.end.body = e.scene->bodies.find(n); },
            "name of a body; with neither body nor deformable it is the world"),
        field<E>("position", Vector3{kCoordinate}, &E::position,
                 "on the body or the world at the start, world frame; left out: the body's own "
                 "[m]"),
    };
    return table;
}

std::uint32_t nearest_point(const DeformableSpec& spec, const Eigen::Vector3d& to) {
    std::uint32_t nearest = 0;
    for (std::uint32_t i = 1; i < spec.points.size(); ++i)
        if ((spec.points[i] - to).squaredNorm() < (spec.points[nearest] - to).squaredNorm())
            nearest = i;
    return nearest;
}

ScenePoint read_end(SceneDraft& scene, const Node& node) {
    EndDraft draft{&scene, {}, {}, {}, {}};
    read_object(draft, node, end_table());
    if (node.has("deformable")) {
        for (const char* key : {"body", "position"})
            if (node.has(key))
                node.at(key).fail(std::string("an end on a \"deformable\" has no \"") + key + "\"");
        node.require_one("point", "near");
        draft.end.point =
            draft.near ? nearest_point(scene.scene.deformables[draft.end.deformable], *draft.near)
                       : *draft.point;
        return draft.end;
    }
    for (const char* key : {"point", "near"})
        if (node.has(key))
            node.at(key).fail(std::string("\"") + key + "\" needs a \"deformable\" beside it");
    if (!node.has("body") && !node.has("position"))
        node.fail("must have \"deformable\", \"body\" or \"position\"");
    draft.end.position =
        draft.position ? *draft.position : scene.scene.bodies[draft.end.body].placement.position;
    return draft.end;
}

void read_length(LinkSpec& link, const Node& node) {
    link.shortest = link.longest = Number{kLength}.read(node);
}

/// [shortest, longest], either of which may be null.
void read_link_limits(LinkSpec& link, const Node& node) {
    require_list(node, 2, "numbers or null");
    const auto bound = [&](std::size_t i) {
        return node.at(i).json().is_null()
                   ? std::nullopt
                   : std::optional<double>(Number{kNotNegative}.read(node.at(i)));
    };
    link.shortest = bound(0);
    link.longest = bound(1);
    if (!link.shortest && !link.longest)
        node.fail("at least one of the two limits must be a number");
}

SchemaJson link_limits_schema() {
    const SchemaJson bound = {{"anyOf", {Number{kNotNegative}.schema(), {{"type", "null"}}}}};
    return {{"type", "array"}, {"items", bound}, {"minItems", 2}, {"maxItems", 2}};
}

const Table<LinkDraft>& link_table() {
    using L = LinkDraft;
    static const Table<L> table = {
        special<L>(
            "a", reference_to("link_end"),
            [](L& l, const Node& n) { l.spec.a = read_end(*l.scene, n); }, "one end",
            Presence::required),
        special<L>(
            "b", reference_to("link_end"),
            [](L& l, const Node& n) { l.spec.b = read_end(*l.scene, n); }, "the other end",
            Presence::required),
        special<L>(
            "length", Number{kLength}.schema(), [](L& l, const Node& n) { read_length(l.spec, n); },
            "of a rod; left out: as far as its ends are apart at the start [m]"),
        special<L>(
            "limits", link_limits_schema(),
            [](L& l, const Node& n) { read_link_limits(l.spec, n); },
            "in place of a length: [shortest, longest], either of which may be null; "
            "[null, 2] is a rope of 2 m [m]"),
        field<L>(
            "compliance", Number{kCoupling}, [](L & l) -> auto& { return l.spec.compliance; },
            "[m/N]; 0, the default, is rigid"),
        field<L>(
            "damping", Number{kCoupling}, [](L & l) -> auto& { return l.spec.damping; },
            "[N s/m]; 0 is the default"),
    };
    return table;
}

}  // namespace

void read_links(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of links");
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Node entry = node.at(i);
        LinkDraft link{&draft, {}};
        read_object(link, entry, link_table());
        if (entry.has("length") && entry.has("limits"))
            entry.fail("must have either \"length\" or \"limits\"");
        if (const auto fault = link_fault(draft.scene, link.spec))
            place_of(*fault, entry).fail(fault->sentence);
        draft.scene.links.push_back(std::move(link.spec));
    }
}

void add_link_definitions(SchemaJson& definitions) {
    definitions["link_end"] = object_schema(end_table());
    definitions["link"] = object_schema(link_table());
}

}  // namespace plumb::reader
