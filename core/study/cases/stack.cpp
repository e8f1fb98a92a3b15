// SPDX-License-Identifier: MIT
/// Cubes that stand on each other.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"

#include <algorithm>
#include <vector>

namespace plumb::study {
namespace {

constexpr double kHalf = 0.25;  // [m]

/// Force with which body a + 1 presses on body a [N], from the impulses of the last substep.
double force_on(const World& w, std::uint32_t a) {
    const ContactTable& contacts = w.contacts;
    double impulse = 0;
    for (std::size_t i = 0; i < contacts.found.size(); ++i)  // what this step remembered
        if (contacts.found[i].a == a && contacts.found[i].b == a + 1)
            impulse += contacts.memory[i].normal_impulse;
    return impulse * w.settings.substeps / w.settings.dt;
}

double force_error(const World& w) {
    double worst = 0, weight = 0;
    for (auto a = static_cast<std::uint32_t>(w.bodies.size()) - 1; a-- > 0;) {
        weight += w.bodies.mass[a + 1] * kGravity;
        worst = std::max(worst, size_of(force_on(w, a) / weight - 1));
    }
    return worst;
}

/// Cubes of these masses on the ground, from below [kg].
void add_cubes(Subject& s, const std::vector<double>& masses) {
    add_ground(s.scene);
    for (std::uint32_t i = 0; i < masses.size(); ++i)
        add_body(s.scene, box(Vector3d::Constant(kHalf)), {0, kHalf * (2 * i + 1), 0}).mass =
            masses[i];
    s.metrics = {shift_metric("farthest that a cube has moved, of its edge", 2 * kHalf),
                 last("force", "", "largest error of a level's force in the end", force_error)};
}

}  // namespace

Subject stack() {
    Subject s = begin_subject("stack", "Ten cubes stand on each other",
                              "each level bears the weight of what is above it", 3);
    add_cubes(s, std::vector<double>(10, 125));
    s.tolerance = 1e-10;
    return s;
}

Subject tower() {
    Subject s = begin_subject("tower", "Of eight cubes every other one is 10,000 times as heavy",
                              "each level bears the weight of what is above it", 3);
    add_cubes(s, {1, 1e4, 1, 1e4, 1, 1e4, 1, 1e4});
    s.tolerance = 1e-9;
    return s;
}

Subject loaded_stack() {
    Subject s = begin_subject("loaded_stack", "Three cubes bear one that is 1000 times as heavy",
                              "each level bears the weight of what is above it", 3);
    add_cubes(s, {1, 1, 1, 1000});
    s.tolerance = 1e-10;
    return s;
}

}  // namespace plumb::study
