// SPDX-License-Identifier: MIT
#include "step/stages.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

Contact* grow(void* ctx, std::uint32_t count) {
    auto& contacts = *static_cast<std::vector<Contact>*>(ctx);
    const std::size_t before = contacts.size();
    contacts.resize(before + count);
    return contacts.data() + before;
}

/// How far a body may come in dt beyond what the margin covers already [m].
double sweep(const World& world, std::size_t i, double dt) {
    const Bodies& b = world.bodies;
    if (b.motion[i] == Motion::fixed || !(b.reach[i] > 0)) return 0;
    const double turn = std::min(b.angular_velocity[i].norm() * dt, 2.0);
    const double spin = turn * b.reach[i];
    const double travel = b.velocity[i].norm() * dt + (std::isfinite(spin) ? spin : 0);
    return std::max(0.0, travel - world.settings.margin / 2);
}

bool usable(const Contact& c, const World& world) {
    const auto n = world.bodies.size();
    if (c.a >= n || c.b >= n || c.a >= c.b) return false;
    if (world.bodies.motion[c.a] != Motion::dynamic && world.bodies.motion[c.b] != Motion::dynamic)
        return false;
    const double sum = c.gap + c.radius_a + c.radius_b + c.point_a.x + c.point_a.y + c.point_a.z +
                       c.point_b.x + c.point_b.y + c.point_b.z;
    const double length = to_eigen(c.normal).squaredNorm();
    return std::isfinite(sum) && std::abs(length - 1) < 1e-6;
}

bool before(const Contact& x, const Contact& y) {
    if (x.a != y.a) return x.a < y.a;
    if (x.b != y.b) return x.b < y.b;
    return x.feature < y.feature;
}

/// Poses and sweeps of all bodies, and empty sinks.
void prepare_request(const World& world, DetectBuffers& buffers, double dt) {
    const Bodies& bodies = world.bodies;
    buffers.poses.resize(bodies.size());
    buffers.sweeps.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        buffers.poses[i] = {to_plain(bodies.position[i]), to_plain(bodies.orientation[i])};
        buffers.sweeps[i] = sweep(world, i, dt);
    }
    buffers.contacts.resize(std::max<std::size_t>(1, world.settings.threads));
    buffers.sinks.clear();
    for (auto& contacts : buffers.contacts) {
        contacts.clear();
        buffers.sinks.push_back({&contacts, grow});
    }
}

void take_contacts(World& world, const DetectBuffers& buffers, StepReport& report) {
    std::vector<Contact>& found = world.contacts.found;
    found.clear();
    for (const auto& contacts : buffers.contacts)
        for (const Contact& c : contacts) {
            if (usable(c, world))
                found.push_back(c);
            else
                ++report.rejected_contacts;
        }
    world.contacts.rejected += report.rejected_contacts;
    if (!std::is_sorted(found.begin(), found.end(), before))
        std::stable_sort(found.begin(), found.end(), before);
    report.contacts = static_cast<std::uint32_t>(found.size());
}

}  // namespace

void detect(World& world, Proximity& proximity, DetectBuffers& buffers, double dt,
            StepReport& report, Ledger& ledger) {
    {
        const StageTimer timer(ledger, Stage::match);
        prepare_request(world, buffers, dt);
    }
    const DetectRequest request{buffers.poses.data(), buffers.sweeps.data(),
                                static_cast<std::uint32_t>(buffers.poses.size()), 0,
                                world.settings.margin};
    Status status;
    {
        const StageTimer timer(ledger, Stage::detect);
        status = proximity.detect(request, buffers.sinks.data(),
                                  static_cast<std::uint32_t>(buffers.sinks.size()));
    }
    if (status.code != Status::ok) {
        report.collider_failed = true;
        report.message = status.message ? status.message : "the collider failed without a message";
    }
    const StageTimer timer(ledger, Stage::match);
    take_contacts(world, buffers, report);
}

}  // namespace plumb
