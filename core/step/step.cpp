// SPDX-License-Identifier: MIT
#include "step/step.h"

#include "constraints/substep_time.h"
#include "contacts/bend.h"
#include "solve/gaping_joints.h"
#include "world/derived.h"

#include <cmath>

namespace plumb {
namespace {

bool is_finite(const World& world) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        sum +=
            world.bodies.position[i] + world.bodies.velocity[i] + world.bodies.angular_velocity[i];
    for (std::size_t i = 0; i < world.particles.size(); ++i)
        sum += world.particles.position[i] + world.particles.velocity[i];
    return sum.allFinite();
}

}  // namespace

/// Contacts are found once (§6: one discrete detection). Each substep of length h then makes
/// velocities admissible and repairs positions, where x₀ + h v is the preview position all along,
/// and moves. The order matters: friction solved before positions is what keeps a resting body from
/// sliding.
StepReport step(World& world, Stepper& stepper, Proximity& proximity) {
    const auto start = std::chrono::steady_clock::now();
    const Workers::Awake awake(stepper.workers);
    StepReport report;
    Ledger& ledger = stepper.ledger = {};
    ledger.mark = start;
    const Plan& plan = stepper.plan;
    auto timed = [&](Stage stage, auto&& work) {
        const StageTimer timer(ledger, stage);
        work();
    };

    const double dt = world.settings.dt, h = dt / world.settings.substeps;
    const bool divides = plan.runs(Effect::divided_trees);
    const bool watches = plan.runs(Effect::still_ground);
    const bool touches = plan.runs(Effect::contacts);
    const bool sleeps = plan.runs(Effect::sleeping);
    bool renews = false;
    ContactSums* sums = stepper.sums ? &*stepper.sums : nullptr;
    if (sleeps) timed(Stage::sleeping, [&] { renews = stepper.sleeping.let_sleep(world); });
    if (touches) {
        detect(world, plan, stepper.workers, proximity, stepper.buffers, dt, report, ledger);
        timed(Stage::match, [&] { match_contacts(world, plan, stepper.workers); });
    }
    if (plan.runs(Effect::particle_contacts))
        timed(Stage::particle_contacts, [&] {
            detect_particles(world, stepper.workers, proximity, stepper.buffers, dt, report,
                             ledger);
        });
    if (plan.runs(Effect::surface_contacts))
        timed(Stage::surface_contacts, [&] { stepper.surfaces.detect(world, stepper.workers, dt); });
    if (sleeps)
        timed(Stage::sleeping, [&] {
            renews |= stepper.sleeping.wake_disturbed(world, stepper.buffers.motions);
            if (renews) assign_rows(world), stepper.renew_rows(world);
            report.asleep = stepper.sleeping.asleep();
            report.contacts =
                static_cast<std::uint32_t>(world.contacts.found.size() + world.asleep.found.size());
        });
    RowSolver& solver = *stepper.solver;
    if (divides) timed(Stage::divided_trees, [&] { stepper.divided.find_free(world); });
    if (sums) timed(Stage::remember, [&] { sums->begin_step(world); });
    for (std::uint32_t i = 0; i < world.settings.substeps; ++i) {
        const bool first = i == 0;
        if (plan.runs(Effect::kinematics))
            timed(Stage::kinematics, [&] { move_scripted(world, h); });
        else if (world.kinematic_count > 0)
            timed(Stage::kinematics, [&] { hold_scripted(world.bodies); });
        if (touches && first)
            timed(Stage::match, [&] { stepper.ghosts.find(world, stepper.workers); });
        timed(Stage::begin, [&] { follow_contacts(world, plan, stepper.workers, first); });
        if (touches) stepper.ghosts.keep_open(world.contacts);
        if (divides) timed(Stage::divided_trees, [&] { stepper.divided.choose(world, h); });
        timed(Stage::begin, [&] { remember_velocities(world.bodies); });
        if (sums) timed(Stage::remember, [&] { sums->begin_substep(world); });
        report.open_trees.clear();
        if (plan.runs(Effect::joints))
            timed(Stage::joints, [&] { count_turns(world, stepper.revolute); });
        if (plan.runs(Effect::restitution))
            timed(Stage::restitution, [&] { choose_restitution(world, first); });
        if (touches) timed(Stage::begin, [&] { stepper.ground.find(world); });
        if (watches)
            timed(Stage::still_ground,
                  [&] { stepper.still_ground.note(world, stepper.ground, h); });
        timed(Stage::integrate, [&] {
            const SubstepTime time = substep_time(world, h);
            integrate_velocities(world, plan, stepper.motion, time, time.push());
            integrate_particles(world, h);
        });
        if (plan.runs(Effect::air_drag))
            timed(Stage::air_drag,
                  [&] { stepper.air.blow(world, stepper.workers, substep_time(world, h).push()); });
        if (touches)
            timed(Stage::begin,
                  [&] { foresee_bend(world, stepper.ground, plan, stepper.workers, h); });
        if (first) timed(Stage::schedule, [&] { solver.load(world); });
        if (plan.runs(Effect::impacts))
            timed(Stage::impacts, [&] { solver.solve_impacts(world, h, sums); });
        timed(Stage::begin,
              [&] { report.clamped_recoveries += solver.begin_substep(world, h, ledger); });
        timed(Stage::velocities, [&] { solver.solve_velocities(); });
        timed(Stage::positions, [&] { solver.solve_positions(world, report, ledger); });
        if (plan.runs(Effect::impacts))
            timed(Stage::impacts, [&] { solver.bound_energy(world, h); });
        if (plan.runs(Effect::joints))
            timed(Stage::joints, [&] { solver.bound_joint_energy(world, h); });
        if (plan.runs(Effect::exact_islands))
            timed(Stage::islands, [&] { solver.solve_islands(world, report); });
        if (plan.runs(Effect::shock_propagation))
            timed(Stage::shock, [&] { solver.propagate_shock(); });
        if (sums) timed(Stage::remember, [&] { solver.add_impulses(*sums); });
        const MotionLists* moving = &stepper.motion;
        timed(Stage::move, [&] { solver.take_changes(world); });
        if (divides)
            timed(Stage::divided_trees, [&] {
                moving = &stepper.divided.advance(world, plan, stepper.workers, h, stepper.motion,
                                                  report);
            });
        timed(Stage::move, [&] {
            move(world, *moving, h);
            move_particles(world, h);
            stepper.fast_joints.note_open(world, h, report);
            stepper.whirled.close(world, h);
        });
        report.count_open_trees();
        if (watches) timed(Stage::still_ground, [&] { stepper.still_ground.take_back(world, h); });
        timed(Stage::joints, [&] { solver.end_substep(world, ledger); });
        world.time += h;
    }
    timed(Stage::residual, [&] { report.residual = solver.find_residual(world); });
    timed(Stage::remember, [&] {
        solver.end_step(world);
        report.finite = is_finite(world);
    });
    if (plan.runs(Effect::joints))
        timed(Stage::joints, [&] {
            break_joints(world, stepper.breakable, plan, proximity, report);
            // trees that nothing disturbs have told what they left open
            const bool closed = report.unsolved_trees == 0 && solver.has_undisturbed_trees();
            note_gaping_joints(world, closed, report);
        });
    if (plan.runs(Effect::links)) timed(Stage::links, [&] { note_stretched_links(world, report); });
    if (plan.runs(Effect::tearing)) timed(Stage::tearing, [&] { tear(world, report); });

    world.time = static_cast<double>(++world.steps) * dt;
    ledger.step_nanoseconds =
        static_cast<std::uint64_t>((std::chrono::steady_clock::now() - start).count());
    return report;
}

}  // namespace plumb
