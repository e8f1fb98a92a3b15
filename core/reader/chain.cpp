// SPDX-License-Identifier: MIT
/// Entries {"chain": …}: capsules from one point to another, joined by balls.
#include "reader/drafts.h"
#include "reader/frames.h"
#include "scene/build.h"

namespace plumb::reader {

namespace {

struct ChainDraft {
    SceneDraft* scene;
    BodySpec link;  ///< material and colour of each
    std::string name = "chain";
    std::uint32_t links = 0;
    Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< [m]
    double radius = 0;                                                             ///< [m]
};

const Table<ChainDraft>& chain_table() {
    using C = ChainDraft;
    static const Table<C> table = {
        field<C>("name", Text{}, &C::name,
                 "of the chain; its links and their joints are NAME_0001 and so on"),
        field<C>("links", Whole<std::uint32_t>{{1, static_cast<double>(kMaxBodies)}}, &C::links,
                 "number of links", Presence::required),
        field<C>("from", Vector3{kCoordinate}, &C::from, "where it hangs from the world [m]",
                 Presence::required),
        field<C>("to", Vector3{kCoordinate}, &C::to, "where its last link ends [m]",
                 Presence::required),
        field<C>("radius", Number{kLength}, &C::radius,
                 "of the links, less than half a link's length [m]", Presence::required),
        special<C>(
            "material", Text{}.schema(),
            [](C& c, const Node& n) { c.link.material = c.scene->materials.find(n); },
            "name of the links' material"),
        field<C>(
            "color", Color{}, [](C & c) -> auto& { return c.link.color; }, "\"#rrggbb\""),
    };
    return table;
}

const Table<ChainDraft>& chain_entry_table() {
    static const Table<ChainDraft> table = {special<ChainDraft>(
        "chain", reference_to("chain"),
        [](ChainDraft& c, const Node& node) { read_object(c, node, chain_table()); },
        "links joined by balls, the first to the world", Presence::required)};
    return table;
}

/// One capsule along y for all links, which touches both of its joints.
std::uint32_t add_link_shape(const ChainDraft& chain, double length) {
    Geometry link = capsule(chain.radius, length / 2 - chain.radius);
    link.name = chain.name;
    return add_geometry(chain.scene->scene, std::move(link));
}

JointSpec ball(std::string name, std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& anchor) {
    JointSpec joint;
    joint.name = std::move(name);
    joint.body_a = a;
    joint.body_b = b;
    joint.anchor = anchor;
    return joint;
}

void check_lengths(const ChainDraft& chain, double length, const Node& node) {
    if (length < 2 * kLength.low)
        node.fail("\"from\" and \"to\" are too near each other for so many links");
    if (chain.radius > 0.5 * length - kLength.low)
        node.at("radius").fail("must be less than half of a link's length, which is " +
                               short_number(length) + " m");
}

}  // namespace

void read_chain(SceneDraft& draft, const Node& node) {
    ChainDraft chain{&draft, {}};
    read_object(chain, node, chain_entry_table());
    const Node keys = node.at("chain");
    const Eigen::Vector3d step = (chain.to - chain.from) / chain.links;
    check_lengths(chain, step.norm(), keys);

    const Eigen::Vector3d along = step.normalized();
    chain.link.geometry = add_link_shape(chain, step.norm());
    // The capsule's y axis along the chain.
    const Eigen::Vector3d x = along.cross(any_across(along)).normalized();
    chain.link.placement.rotation = frame_of(x, along);

    std::uint32_t before = kNoIndex;
    for (std::uint32_t i = 0; i < chain.links; ++i) {
        BodySpec link = chain.link;
        link.name = numbered(chain.name, i + 1);
        link.placement.position = chain.from + step * (i + 0.5);
        const auto body = static_cast<std::uint32_t>(draft.scene.bodies.size());
        add_body(draft, link, keys);
        add_joint(draft, ball(link.name, body, before, chain.from + step * i), keys);
        before = body;
    }
}

void add_chain_definitions(SchemaJson& definitions) {
    definitions["chain"] = object_schema(chain_table());
    definitions["chain_entry"] = object_schema(chain_entry_table());
}

}  // namespace plumb::reader
