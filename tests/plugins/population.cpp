// SPDX-License-Identifier: MIT
#include "population.h"

namespace plumb::test {

const std::vector<ShapeKind>& solid_kinds() {
    static const std::vector<ShapeKind> kinds = {ShapeKind::sphere,  ShapeKind::box,
                                                 ShapeKind::capsule, ShapeKind::cylinder,
                                                 ShapeKind::cone,    ShapeKind::hull};
    return kinds;
}

Shape any_shape(ShapeKind kind, Dice& dice) {
    const auto length = [&] { return dice.between(0.2, 0.5); };
    switch (kind) {
        case ShapeKind::sphere:
            return sphere(length());
        case ShapeKind::box:
            return box(length(), length(), length());
        case ShapeKind::capsule:
            return capsule(0.5 * length(), length());
        case ShapeKind::cylinder:
            return cylinder(length(), length());
        case ShapeKind::cone:
            return cone(length(), length());
        default: {
            std::vector<V> points;
            const V stretch(length(), length(), length());
            for (int i = 0; i < 12; ++i) points.push_back(dice.direction().cwiseProduct(stretch));
            return hull_of(points);
        }
    }
}

NearPair near_pair(ShapeKind a, ShapeKind b, double gap, Dice& dice) {
    const auto flat = [](ShapeKind k) { return k == ShapeKind::box || k == ShapeKind::hull; };
    NearPair p{any_shape(a, dice), any_shape(b, dice), {}, {}, gap, {}, flat(a) && flat(b), 0};
    p.pb = {V(0.3, -0.2, 0.1), dice.rotation()};
    p.pa = {p.pb.x + 0.3 * dice.direction(), dice.rotation()};
    const Widest best =
        p.polyhedra ? separating_axes(p.a, p.pa, p.b, p.pb) : widest_gap(p.a, p.pa, p.b, p.pb);
    p.pa.x += (gap - best.gap) * best.n;
    p.n = best.n;
    p.second = gap - (best.gap - best.second);
    return p;
}

std::vector<ShapeKind> mutual_kinds(const std::string& name) {
    std::vector<ShapeKind> kinds;
    for (ShapeKind kind : solid_kinds()) {
        bool with_all = ability(name, kind, kind) != kPairNone;
        for (ShapeKind other : kinds) with_all = with_all && ability(name, kind, other);
        if (with_all) kinds.push_back(kind);
    }
    return kinds;
}

void throw_heap(World& world, const std::string& name, unsigned seed, std::uint32_t count,
                const Place& frame, bool backwards) {
    const std::vector<ShapeKind> kinds = mutual_kinds(name);
    Dice dice(seed);
    const double half = 0.45 * std::cbrt(count);
    for (std::uint32_t i = 0; i < count && !kinds.empty(); ++i) {
        const Shape shape = any_shape(kinds[i % kinds.size()], dice);
        const V x(dice.between(-half, half), dice.between(-half, half), dice.between(-half, half));
        world.add(backwards ? count - 1 - i : i, shape, frame * Place{x, dice.rotation()});
    }
}

std::vector<Contact> contacts_of(const std::string& name, const NearPair& pair, double margin,
                                 const Place& frame, bool a_first) {
    World world(name);
    const std::uint32_t a = a_first ? 1 : 2;
    world.add(a, pair.a, frame * pair.pa);
    world.add(3 - a, pair.b, frame * pair.pb);
    return world.detect(margin);
}

}  // namespace plumb::test
