// SPDX-License-Identifier: MIT
#include "contacts/contact_faults.h"
#include "contacts/contact_measures.h"
#include "contacts/contact_stages.h"
#include "contacts/renew_contacts.h"
#include "world/motion_script.h"
#include "world/round_shapes.h"
#include "world/sleep.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// How far a point of a body may come in a step [m]: one that moves and turns so far.
double travel_of(const Bodies& b, std::size_t i, double way, double angle) {
    const double spin = std::min(angle, 2.0) * b.bounding_radius[i];
    return way + (std::isfinite(spin) ? spin : 0);
}

/// The same within dt [s], at the velocity that it has and by its own force, or as its script wants
/// it to. What others do to it is not known yet.
double travel_in(const World& world, std::size_t i, double dt) {
    const Bodies& b = world.bodies;
    if (b.motion[i] == Motion::fixed || !(b.bounding_radius[i] > 0)) return 0;
    if (b.motion[i] == Motion::kinematic && !b.script[i].keyframes.empty()) {
        const Placement to = placement_at(b.script[i], world.time + dt);
        return travel_of(b, i, (to.position - b.position[i]).norm(),
                         to.rotation.angularDistance(b.orientation[i]));
    }
    return travel_of(b, i, way_in(b, i, dt), b.angular_velocity[i].norm() * dt);
}

bool before(const Contact& x, const Contact& y) {
    if (x.a != y.a) return x.a < y.a;
    if (x.b != y.b) return x.b < y.b;
    return x.feature < y.feature;
}

/// Poses and motions of all bodies, and empty sinks.
void prepare_request(World& world, Workers& workers, DetectBuffers& buffers, double dt) {
    const Bodies& bodies = world.bodies;
    std::vector<Pose>& poses = world.contacts.kept.seen;
    const std::size_t known = poses.size();
    poses.resize(bodies.size());
    buffers.motions.resize(bodies.size());
    buffers.sweeps.resize(bodies.size());
    workers.each(bodies.size(), [&](std::uint32_t i, std::uint32_t) {
        const Pose pose{to_plain(bodies.position[i]), to_plain(bodies.orientation[i])};
        const PoseChange change = i < known ? PoseChange::between(poses[i], pose) : PoseChange();
        poses[i] = pose;
        const double travel = travel_in(world, i, dt);
        buffers.sweeps[i] = std::max(0.0, travel - world.settings.margin / 2);
        buffers.motions[i] = {travel,
                              buffers.sweeps[i],
                              change,
                              is_round(world, i),
                              has_rim(world, i),
                              is_still(bodies, i)};
    });
    buffers.rooms.resize(std::max<std::size_t>(1, world.settings.threads));
    buffers.sinks.clear();
    for (ContactRoom& room : buffers.rooms) {
        room.clear();
        buffers.sinks.push_back(room.sink());
    }
}

/// Trouble that the collider does not know of itself, or tells less of.
void look_at_rooms(const DetectBuffers& buffers, StepReport& report) {
    for (const ContactRoom& room : buffers.rooms) {
        if (room.refused() > 0) {
            report.collider_failed = true;
            report.message = "it asked for room for " + std::to_string(room.refused()) +
                             " contacts, and a sink takes " + std::to_string(kMaxContacts) +
                             " at most";
        }
        if (!room.overrun()) continue;
        report.collider_failed = report.collider_unusable = true;
        report.message = "it wrote more contacts than it had asked room for";
        return;
    }
}

/// Whether a contact of known bodies lies aside, as one of them sleeps and the other is still.
bool lies_aside(const Bodies& b, const std::vector<BodyMotion>& motions, const Contact& c) {
    if (c.a >= b.size() || c.b >= b.size()) return false;
    const bool any = b.motion[c.a] == Motion::asleep || b.motion[c.b] == Motion::asleep;
    return any && motions[c.a].is_still && motions[c.b].is_still;
}

void take_contacts(World& world, const DetectBuffers& buffers, StepReport& report) {
    std::vector<Contact>& found = world.contacts.fresh.found;
    found.clear();
    if (report.collider_unusable) return;
    for (const ContactRoom& room : buffers.rooms)
        for (const Contact& c : room) {
            // from colliders that were not asked to leave it out
            if (lies_aside(world.bodies, buffers.motions, c)) continue;
            const ContactFault fault = fault_of(c, world, buffers.sweeps);
            if (fault == ContactFault::none) {
                found.push_back(c);
                continue;
            }
            ++report.faults[static_cast<std::size_t>(fault)];
            ++report.rejected_contacts;
        }
    world.contacts.rejected += report.rejected_contacts;
    if (!std::is_sorted(found.begin(), found.end(), before))
        std::stable_sort(found.begin(), found.end(), before);
}

std::uint32_t detect_flags(const Settings& settings) {
    return settings.contacts == ContactOrigin::raw ? kDetectRaw : 0u;
}

}  // namespace

TaskRunner runner_on(Workers& workers) {
    return {&workers, workers.count(),
            [](void* ctx, void (*task)(void*, std::uint32_t), void* arg) {
                static_cast<Workers*>(ctx)->run([=](std::uint32_t worker) { task(arg, worker); });
            }};
}

void detect(World& world, const Plan& plan, Workers& workers, Proximity& proximity,
            DetectBuffers& buffers, double dt, StepReport& report, Ledger& ledger) {
    {
        const StageTimer timer(ledger, Stage::match);
        prepare_request(world, workers, buffers, dt);
    }
    const bool reuse = plan.runs(Effect::contact_reuse);
    const TaskRunner runner = runner_on(workers);
    ReuseContext context{&world, &buffers.motions};
    PairFilter filter{};
    if (reuse) filter = reuse_filter(context);
    const DetectRequest request{world.contacts.kept.seen.data(),
                                buffers.sweeps.data(),
                                static_cast<std::uint32_t>(world.contacts.kept.seen.size()),
                                detect_flags(world.settings),
                                world.settings.margin,
                                reuse ? &filter : nullptr,
                                workers.count() > 1 ? &runner : nullptr};
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
    {
        const StageTimer timer(ledger, Stage::match);
        look_at_rooms(buffers, report);
        take_contacts(world, buffers, report);
    }
    const StageTimer timer(ledger, Stage::reuse);
    if (!context.asked) forget_kept_contacts(world);
    const std::uint32_t unasked = find_moves(world);
    report.faults[static_cast<std::size_t>(ContactFault::unwanted_pair)] += unasked;
    report.rejected_contacts += unasked;
    if (report.collider_failed || report.rejected_contacts > 0) forget_kept_contacts(world);
    report.contacts = contacts_to_be(world.contacts.kept);
}

}  // namespace plumb
