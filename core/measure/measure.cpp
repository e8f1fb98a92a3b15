// SPDX-License-Identifier: MIT
#include "measure/measure.h"

#include "math/fnv1a.h"
#include "solve/gaping_joints.h"
#include "world/body_momentum.h"
#include "world/link_error.h"
#include "world/sleep.h"

#include <algorithm>

namespace plumb {

double kinetic_energy(const World& world) {
    double sum = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) sum += kinetic_energy(world.bodies, i);
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i) sum += 0.5 * p.mass[i] * p.velocity[i].squaredNorm();
    return sum;
}

double potential_energy(const World& world) {
    const Bodies& b = world.bodies;
    double sum = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (is_movable(b.motion[i]))
            sum -= (b.mass[i] * world.settings.gravity + b.force[i]).dot(b.position[i]);
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        sum -= p.mass[i] * world.settings.gravity.dot(p.position[i]);
    return sum;
}

Vector3d linear_momentum(const World& world) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        sum += world.bodies.mass[i] * world.bodies.velocity[i];
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
    return sum;
}

Vector3d angular_momentum(const World& world) {
    const Bodies& b = world.bodies;
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < b.size(); ++i)
        sum += b.position[i].cross(b.mass[i] * b.velocity[i]) +
               spin_momentum(b, i, b.angular_velocity[i]);
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        sum += p.position[i].cross(p.mass[i] * p.velocity[i]);
    return sum;
}

namespace {

void add_penetrations(const std::vector<Contact>& contacts, std::vector<double>& depths) {
    for (std::size_t i = 0; i < contacts.size();) {
        double deepest = 0;
        const Contact& first = contacts[i];
        for (; i < contacts.size() && contacts[i].a == first.a && contacts[i].b == first.b; ++i)
            deepest = std::max(deepest, -contacts[i].gap);
        if (deepest > 0) depths.push_back(deepest);
    }
}

}  // namespace

std::vector<double> penetrations(const World& world) {
    std::vector<double> depths;
    add_penetrations(world.contacts.found, depths);
    add_penetrations(world.asleep.found, depths);
    return depths;
}

std::vector<double> joint_errors(const World& world) {
    std::vector<double> errors(world.joints.size(), 0);
    each_joint_error(world, false,
                     [&](std::uint32_t i, const JointError& error) { errors[i] = error.along; });
    return errors;
}

std::vector<double> joint_turn_errors(const World& world) {
    std::vector<double> errors(world.joints.size(), 0);
    each_joint_error(world, false,
                     [&](std::uint32_t i, const JointError& error) { errors[i] = error.about; });
    return errors;
}

std::vector<double> coupling_errors(const World& world) {
    std::vector<double> errors;
    for (const JointCoupling& coupling : world.joints.couplings)
        errors.push_back(coupling_error(world, coupling));
    return errors;
}

std::vector<double> link_errors(const World& world) {
    std::vector<double> errors;
    for (const Link& link : world.links) errors.push_back(link_error(world, link));
    return errors;
}

std::uint64_t state_hash(const World& world) {
    Fnv1a hash;
    const auto add = [&](const double* values, std::size_t count) {
        hash.add(values, count * sizeof *values);
    };
    const Bodies& b = world.bodies;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.id[i] == kNoIndex) continue;
        add(b.position[i].data(), 3);
        add(b.orientation[i].coeffs().data(), 4);
        add(b.velocity[i].data(), 3);
        add(b.angular_velocity[i].data(), 3);
    }
    for (std::size_t i = 0; i < world.particles.size(); ++i) {
        add(world.particles.position[i].data(), 3);
        add(world.particles.velocity[i].data(), 3);
    }
    return hash.value();
}

void capture(const World& world, Frame& frame) {
    frame.step = world.steps;
    frame.time = world.time;
    frame.bodies.resize(world.bodies.size());
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        frame.bodies[i] = {geometry_placement(world.bodies, i), world.bodies.velocity[i],
                           world.bodies.angular_velocity[i]};
    frame.ids = world.bodies.id;
    frame.particles.assign(world.particles.position.begin(), world.particles.position.end());
    frame.torn.clear();
    for (std::uint32_t i = 0; i < world.deformables.size(); ++i)
        for (const std::uint32_t element : world.deformables[i].torn)
            frame.torn.push_back({i, element});
    frame.contacts =
        static_cast<std::uint32_t>(world.contacts.found.size() + world.asleep.found.size());
    frame.kinetic_energy = kinetic_energy(world);
    frame.potential_energy = potential_energy(world);
    frame.deepest_penetration = 0;
    for (const auto* contacts : {&world.contacts.found, &world.asleep.found})
        for (const Contact& c : *contacts)
            frame.deepest_penetration = std::max(frame.deepest_penetration, -c.gap);
}

double percentile(std::vector<double> values, double p) {
    if (values.empty()) return 0;
    const auto k = std::min(values.size() - 1,
                            static_cast<std::size_t>(p * static_cast<double>(values.size())));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
    return values[k];
}

}  // namespace plumb
