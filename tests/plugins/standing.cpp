// SPDX-License-Identifier: MIT
#include "standing.h"

namespace plumb::test {
namespace {

Outline rectangle(double hx, double hz) { return {{-hx, -hz}, {hx, -hz}, {hx, hz}, {-hx, hz}}; }

Outline regular(int sides, double radius) {
    Outline o;
    for (int i = 0; i < sides; ++i)
        o.push_back(
            {radius * std::cos(2 * M_PI * i / sides), radius * std::sin(2 * M_PI * i / sides)});
    return o;
}

Shape two_boxes(double size) {
    const double h = 0.5 * size;
    return compound({{box(h, h, size), {V(-h, 0, 0), Q::Identity()}},
                     {box(h, h, size), {V(h, 0, 0), Q::Identity()}}});
}

std::optional<KindPair>& chosen_pair() {
    static std::optional<KindPair> pair;
    return pair;
}

bool is_chosen(ShapeKind a, ShapeKind b) {
    const std::optional<KindPair>& pair = chosen_pair();
    return !pair || KindPair(a, b) == *pair || KindPair(b, a) == *pair;
}

}  // namespace

void choose_pair(const KindPair& pair) { chosen_pair() = pair; }

Standing below(ShapeKind kind, double s) {
    const Q flat = Q::Identity();
    const auto down = [](double h, const Q& q) { return Place{V(0, -h, 0), q}; };
    switch (kind) {
        case ShapeKind::plane:
            return {plane(), {}, 4, rectangle(100, 100)};
        case ShapeKind::sphere:
            return {sphere(s), down(s, flat), 1, {}};
        case ShapeKind::box:
            return {box(s, .5 * s, s), down(.5 * s, flat), 4, rectangle(s, s)};
        case ShapeKind::capsule:
            return {capsule(.5 * s, s), down(.5 * s, turn(90, V::UnitZ())), 2, {}};
        case ShapeKind::cylinder:
            return {cylinder(s, .5 * s), down(.5 * s, flat), 4, regular(720, s)};
        case ShapeKind::cone:
            return {cone(s, .5 * s), down(.5 * s, turn(180, V::UnitX())), 4, regular(720, s)};
        case ShapeKind::hull:
            return {prism(6, s, .5 * s), down(.5 * s, flat), 4, regular(6, s)};
        case ShapeKind::mesh:
            return {grid_mesh(4 * s, 4), {}, 4, rectangle(4 * s, 4 * s)};
        case ShapeKind::height_field:
            return {height_field(4 * s, 4, [](double, double) { return 0; }),
                    {},
                    4,
                    rectangle(4 * s, 4 * s)};
        case ShapeKind::compound:
            return {two_boxes(s), down(.5 * s, flat), 4, rectangle(s, s)};
    }
    return {};
}

std::optional<Standing> above(ShapeKind kind, double s) {
    if (kind == ShapeKind::plane || kind == ShapeKind::height_field) return std::nullopt;
    if (kind == ShapeKind::mesh)
        return Standing{
            box_mesh(s, .5 * s, s), {V(0, .5 * s, 0), Q::Identity()}, 4, rectangle(s, s)};
    Standing standing = below(kind, s);
    // Seams across those of the compound below: two seams in one plane would touch each other too.
    if (kind == ShapeKind::compound) standing.place.q = turn(90, V::UnitY());
    standing.place = {-standing.place.x,
                      kind == ShapeKind::cone ? Q::Identity() : standing.place.q};
    return standing;
}

std::string Stack::name() const {
    return std::string(name_of(upper.shape.kind)) + " on " + name_of(lower.shape.kind);
}

std::vector<Stack> stacks(const std::string& plugin, double size) {
    std::vector<Stack> all;
    for (std::uint32_t i = 0; i < kShapeKindCount; ++i)
        for (std::uint32_t j = 0; j < kShapeKindCount; ++j) {
            const auto low = static_cast<ShapeKind>(i), high = static_cast<ShapeKind>(j);
            const std::uint32_t able = ability(plugin, low, high);
            if (able == kPairNone || !above(high, size) || !is_chosen(low, high)) continue;
            // A half-space is never dynamic, and one of two must be.
            if (high == ShapeKind::mesh && !(able & kPairMovingMesh) && low == ShapeKind::plane)
                continue;
            all.push_back({below(low, 2 * size), *above(high, size), able});
        }
    return all;
}

void build(World& world, const Stack& s, double gap, const Place& frame, std::uint32_t lower) {
    const bool upper_stays =
        s.upper.shape.kind == ShapeKind::mesh && !(s.ability & kPairMovingMesh);
    Place raised = s.upper.place;
    raised.x.y() += gap;
    world.add(lower, s.lower.shape, frame * s.lower.place,
              upper_stays ? Mobility::dynamic : Mobility::fixed);
    world.add(3 - lower, s.upper.shape, frame * raised,
              upper_stays ? Mobility::fixed : Mobility::dynamic);
}

double shared_area(const Outline& a, const Outline& b) {
    Outline rest = a;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Eigen::Vector2d p = b[i], d = b[(i + 1) % b.size()] - p;
        const auto inside = [&](const Eigen::Vector2d& q) {
            return d.x() * (q.y() - p.y()) - d.y() * (q.x() - p.x());
        };
        Outline kept;
        for (std::size_t k = 0; k < rest.size(); ++k) {
            const Eigen::Vector2d q = rest[k], r = rest[(k + 1) % rest.size()];
            const double iq = inside(q), ir = inside(r);
            if (iq >= 0) kept.push_back(q);
            if ((iq < 0) != (ir < 0)) kept.push_back(q + iq / (iq - ir) * (r - q));
        }
        rest = kept;
    }
    double twice = 0;
    for (std::size_t k = 0; k < rest.size(); ++k) {
        const Eigen::Vector2d q = rest[k], r = rest[(k + 1) % rest.size()];
        twice += q.x() * r.y() - q.y() * r.x();
    }
    return 0.5 * std::abs(twice);
}

}  // namespace plumb::test
