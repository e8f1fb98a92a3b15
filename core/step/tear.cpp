// SPDX-License-Identifier: MIT
/// What deforms tears where it is strained too far.
///
/// Of elements that share a point only the one that is strained most gives way in a step: what it
/// bore goes to its neighbours, and a tear runs on through them in the steps that follow.
#include "constraints/strain.h"
#include "scene/elements_left.h"
#include "step/stages.h"
#include "world/tears.h"

#include <algorithm>
#include <vector>

namespace plumb {
namespace {

struct Overstrained {
    double strain;
    std::uint32_t element;  ///< of Deformable::whole
};

template <class Elements>
std::uint32_t tear_elements(Deformable& d, const Elements& elements, const Particles& particles) {
    using Element = typename Elements::value_type;
    std::vector<Overstrained> beyond;
    each_left(elements, d.torn, [&](const Element& element, std::uint32_t i) {
        std::array<Vector3d, std::tuple_size_v<Element>> rest, now;
        for (std::size_t k = 0; k < element.size(); ++k) {
            rest[k] = d.whole.points[element[k]];
            now[k] = particles.position[d.first + element[k]];
        }
        const double strain = greatest_strain(rest, now);
        if (strain > d.spec.tearing_strain) beyond.push_back({strain, i});
    });
    if (beyond.empty()) return 0;
    std::stable_sort(
        beyond.begin(), beyond.end(),
        [](const Overstrained& x, const Overstrained& y) { return x.strain > y.strain; });
    std::vector<std::uint8_t> gave(d.count, 0);  // [point] whether an element at it did
    const std::size_t before = d.torn.size();
    for (const Overstrained& o : beyond) {
        const Element& element = elements[o.element];
        if (std::any_of(element.begin(), element.end(),
                        [&](std::uint32_t point) { return gave[point] != 0; }))
            continue;
        for (const std::uint32_t point : element) gave[point] = 1;
        d.torn.push_back(o.element);
    }
    const auto count = static_cast<std::uint32_t>(d.torn.size() - before);
    std::sort(d.torn.begin(), d.torn.end());
    return count;
}

std::uint32_t tear_one(Deformable& d, const Particles& particles) {
    switch (d.whole.kind) {
        case DeformableKind::rope:
            return tear_elements(d, d.whole.segments, particles);
        case DeformableKind::cloth:
        case DeformableKind::balloon:
            return tear_elements(d, d.whole.triangles, particles);
        case DeformableKind::solid:
            return tear_elements(d, d.whole.tetrahedra, particles);
    }
    return 0;
}

}  // namespace

void tear(World& world, StepReport& report) {
    for (Deformable& d : world.deformables) {
        if (!d.can_tear()) continue;
        const std::uint32_t count = tear_one(d, world.particles);
        if (count == 0) continue;
        leave_out_torn(d);
        report.torn_elements += count;
    }
}

}  // namespace plumb
