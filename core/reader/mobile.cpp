// SPDX-License-Identifier: MIT
/// Entries {"mobile": …}: rods that hang in a binary tree, two from the ends of each.
///
/// Rod n of the tree (the root is 0, its left child 2n + 1, its right one 2n + 2) at level l of L
/// has the half length a = 0.3 · 1.25^(L − 1 − l) and is turned a quarter about y at odd levels. A
/// ball joint ties its point (0, 0.25, 0) to its parent's end (±a, −0.25, 0), the root's to the
/// world. Rods pass through each other.
#include <cmath>

#include "math/random.h"
#include "reader/drafts.h"
#include "scene/build.h"

namespace plumb::reader {

namespace {

constexpr double kShortestRod = 0.3, kGrowth = 1.25;  // half length of a leaf [m], and by level
constexpr double kHalfWidth = 0.05, kDrop = 0.25;     // of a rod; of a joint above or below it [m]
constexpr double kMostLevels = 19;                    // 2^19 − 1 rods

struct MobileDraft {
    SceneDraft* scene;
    BodySpec rod;  ///< material and colour of each
    std::string name = "mobile";
    std::uint32_t levels = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the hook [m]
    double spin = 0.5;                                   ///< [rad/s]
    std::uint64_t seed = 1;
};

const Table<MobileDraft>& mobile_table() {
    using M = MobileDraft;
    static const Table<M> table = {
        field<M>("name", Text{}, &M::name,
                 "of the mobile; its rods and their joints are NAME_0001 and so on"),
        field<M>("levels", Whole<std::uint32_t>{{1, kMostLevels}}, &M::levels,
                 "L: 2^L - 1 rods; of 0.6 m at the lowest level, longer by a quarter at each above",
                 Presence::required),
        field<M>("position", Vector3{kCoordinate}, &M::position, "of the hook in the world [m]"),
        field<M>("spin", Number{kNotNegative}, &M::spin,
                 "greatest random speed about y of each rod, either way [rad/s]"),
        field<M>("seed", Whole<std::uint64_t>{{0, kMostExact}}, &M::seed, "seed of the speeds"),
        special<M>(
            "material", Text{}.schema(),
            [](M& m, const Node& n) { m.rod.material = m.scene->materials.find(n); },
            "name of the rods' material"),
        field<M>(
            "color", Color{}, [](M & m) -> auto& { return m.rod.color; }, "\"#rrggbb\""),
    };
    return table;
}

const Table<MobileDraft>& mobile_entry_table() {
    static const Table<MobileDraft> table = {special<MobileDraft>(
        "mobile", reference_to("mobile"),
        [](MobileDraft& m, const Node& node) { read_object(m, node, mobile_table()); },
        "rods that hang in a binary tree, without colliding", Presence::required)};
    return table;
}

/// Half lengths by level, and one box a level.
std::vector<double> add_rods(Scene& scene, const MobileDraft& mobile) {
    std::vector<double> halves(mobile.levels, kShortestRod);
    for (std::size_t level = mobile.levels - 1; level > 0; --level)
        halves[level - 1] = halves[level] * kGrowth;
    for (const double half : halves) {
        Geometry rod = box(half, kHalfWidth, kHalfWidth);
        rod.name = mobile.name;
        add_geometry(scene, std::move(rod));
    }
    return halves;
}

/// Where a rod of a level reaches to: its ends along x, or along −z where it is turned.
Eigen::Vector3d reach(std::uint32_t level, double half) {
    return level % 2 == 0 ? Eigen::Vector3d(half, 0, 0) : Eigen::Vector3d(0, 0, -half);
}

void add_rod(SceneDraft& draft, const BodySpec& rod, std::uint32_t parent,
             const Eigen::Vector3d& anchor, const Node& node) {
    JointSpec joint;
    joint.name = rod.name;
    joint.body_a = static_cast<std::uint32_t>(draft.scene.bodies.size());
    joint.body_b = parent;
    joint.anchor = anchor;
    add_body(draft, rod, node);
    add_joint(draft, std::move(joint), node);
}

}  // namespace

void read_mobile(SceneDraft& draft, const Node& node) {
    MobileDraft mobile{&draft, {}};
    read_object(mobile, node, mobile_entry_table());
    const Node keys = node.at("mobile");
    const auto shape = static_cast<std::uint32_t>(draft.scene.geometries.size());
    const auto root = static_cast<std::uint32_t>(draft.scene.bodies.size());
    const std::vector<double> halves = add_rods(draft.scene, mobile);
    const Eigen::Quaterniond quarter(std::sqrt(0.5), 0, std::sqrt(0.5), 0);

    Random random(mobile.seed);
    std::uint32_t n = 0;
    for (std::uint32_t level = 0; level < mobile.levels; ++level) {
        for (std::uint32_t k = 0; k < (1u << level); ++k, ++n) {
            Eigen::Vector3d anchor = mobile.position;
            const std::uint32_t parent = n == 0 ? kNoIndex : root + (n - 1) / 2;
            if (n > 0)
                anchor = draft.scene.bodies[parent].placement.position -
                         Eigen::Vector3d(0, kDrop, 0) +
                         (n % 2 == 1 ? -1 : 1) * reach(level - 1, halves[level - 1]);
            BodySpec rod = mobile.rod;
            rod.name = numbered(mobile.name, n + 1);
            rod.geometry = shape + level;
            rod.mask = 0;
            rod.placement.position = anchor - Eigen::Vector3d(0, kDrop, 0);
            if (level % 2 == 1) rod.placement.rotation = quarter;
            rod.angular_velocity.y() = random.between(-mobile.spin, mobile.spin);
            add_rod(draft, rod, parent, anchor, keys);
        }
    }
}

void add_mobile_definitions(SchemaJson& definitions) {
    definitions["mobile"] = object_schema(mobile_table());
    definitions["mobile_entry"] = object_schema(mobile_entry_table());
}

}  // namespace plumb::reader
