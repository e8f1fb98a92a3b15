// SPDX-License-Identifier: MIT
/// Contacts of particles with bodies, deformable by deformable, for each has its own filter.
#include "contacts/contact_stages.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace plumb {
namespace {

auto particle_key(const Contact& c) { return std::tuple(c.a, c.b, c.part_b, c.feature); }

bool is_sound(const Contact& c, const World& world) {
    const Vector3d n = to_eigen(c.normal);
    return c.a < world.particles.size() && c.b < world.bodies.size() &&
           world.bodies.id[c.b] != kNoIndex && std::isfinite(c.gap) && n.allFinite() &&
           std::abs(n.squaredNorm() - 1) < 1e-6 && to_eigen(c.point_b).allFinite();
}

/// How far the fastest particle of a deformable may come in dt beyond what the margin covers [m].
double sweep(const World& world, const Deformable& d, double dt) {
    double fastest = 0;
    for (std::uint32_t i = d.first; i < d.first + d.count; ++i)
        fastest = std::max(fastest, world.particles.velocity[i].norm());
    return std::max(0.0, fastest * dt - world.settings.margin / 2);
}

}  // namespace

void detect_particles(World& world, Workers& workers, Proximity& proximity, DetectBuffers& buffers,
                      double dt, StepReport& report, Ledger& ledger) {
    ParticleContactTable& table = world.particle_contacts;
    table.found.clear();
    const TaskRunner runner = runner_on(workers);
    buffers.joined.find(world);
    buffers.places.resize(world.particles.size());
    for (std::size_t i = 0; i < world.particles.size(); ++i)
        buffers.places[i] = to_plain(world.particles.position[i]);
    double furthest = 0;  // of all bodies; those that come less far are sorted out below
    for (const double body : buffers.sweeps) furthest = std::max(furthest, body);
    for (const Deformable& d : world.deformables) {
        const double margin = world.settings.margin + sweep(world, d, dt);
        ParticleRequest request{};
        request.positions = buffers.places.data() + d.first;
        request.radii = world.particles.radius.data() + d.first;
        request.count = d.count;
        request.margin = margin + furthest;
        request.group = d.spec.group, request.mask = d.spec.mask;
        request.runner = workers.count() > 1 ? &runner : nullptr;
        for (ContactRoom& room : buffers.rooms) room.clear();
        Status status;
        {
            const StageTimer timer(ledger, Stage::detect);
            status = proximity.detect_particles(request, buffers.sinks.data(),
                                                static_cast<std::uint32_t>(buffers.sinks.size()));
        }
        if (status.code != Status::ok) {
            report.collider_failed = true;
            report.message =
                status.message ? status.message : "the collider failed without a message";
        }
        for (const ContactRoom& room : buffers.rooms)
            for (Contact c : room) {
                c.a += d.first;
                if (!is_sound(c, world))
                    ++report.rejected_contacts;
                else if (c.gap <= margin + buffers.sweeps[c.b] && !buffers.joined.has(c.a, c.b))
                    table.found.push_back(c);
            }
    }
    const auto before = [](const Contact& x, const Contact& y) {
        return particle_key(x) < particle_key(y);
    };
    if (!std::is_sorted(table.found.begin(), table.found.end(), before))
        std::stable_sort(table.found.begin(), table.found.end(), before);

    table.track.resize(table.found.size());
    for (std::size_t i = 0; i < table.found.size(); ++i)
        table.track[i] = in_body(world.bodies, table.found[i].b, to_eigen(table.found[i].point_b));
    report.contacts += static_cast<std::uint32_t>(table.found.size());
}

}  // namespace plumb
