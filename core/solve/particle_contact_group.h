// SPDX-License-Identifier: MIT
/// Contacts of particles with bodies: the rows and kernels of bodies' contacts, in which a is a
/// particle, whose connector has neither arm nor inertia (§7).
#pragma once

#include "contacts/contact_sums.h"
#include "effects/plan.h"
#include "kernels/contact_kernels.h"
#include "schedule/contact_batches.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/contact_iteration.h"
#include "solve/fill_mass.h"

#include <vector>

namespace plumb {

template <class Real, int W>
class ParticleContactGroup final : public ConstraintGroup<Real> {
public:
    ParticleContactGroup(const Plan& plan, Workers& workers)
        : variant_(plan.runs(Effect::friction) ? ContactVariant::friction
                                               : ContactVariant::frictionless),
          kernels_(contact_kernels<Real, W>(variant_)),
          workers_(workers) {}

    Stage stage() const override { return Stage::particle_contacts; }
    bool empty() const override { return pairs_.empty(); }

    void load(const World& world) override {
        const ParticleContactTable& c = world.particle_contacts;
        pairs_.clear();
        for (std::uint32_t i = 0; i < c.found.size(); ++i) {
            const Contact& contact = c.found[i];
            if (i > 0 && c.found[i - 1].a == contact.a && c.found[i - 1].b == contact.b)
                ++pairs_.back().count;
            else
                pairs_.push_back(
                    {world.particle_row(contact.a), world.bodies.row[contact.b], i, 1});
        }
        colouring_.colour(pairs_, world.moving_count());
        batches_.lay_out(pairs_, colouring_, variant_, world.zero_row());
        const ContactArrays<Real, W> rows = batches_.arrays();
        each_contact([&](const ContactPlace& at) {
            const Contact& contact = c.found[at.contact];
            const double n[3] = {contact.normal.x, contact.normal.y, contact.normal.z};
            for (int k = 0; k < 3; ++k)
                rows.normals[at.row].normal[k][at.lane] = static_cast<Real>(n[k]);
            rows.blocks[at.block].inverse_mass_a[at.lane] =
                static_cast<Real>(world.particles.inverse_mass[contact.a]);
            if (!rows.frictions) return;
            const std::uint32_t material = world.particles.material[contact.a];
            rows.frictions[at.row].friction[at.lane] = static_cast<Real>(
                world.surface_of(material, world.bodies.material[contact.b]).friction);
        });
    }

    void begin(const World& world, const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
               double) override {
        const ParticleContactTable& c = world.particle_contacts;
        const ContactArrays<Real, W> rows = batches_.arrays();
        each_contact([&](const ContactPlace& at) {
            const Contact& contact = c.found[at.contact];
            const Vector3d& place = world.particles.position[contact.a];
            const Vector3d apart = place - in_world(world.bodies, contact.b, c.track[at.contact]);
            const Vector3d arm = place - world.bodies.position[contact.b];
            NormalRow<Real, W>& row = rows.normals[at.row];
            row.gap[at.lane] = static_cast<Real>(to_eigen(contact.normal).dot(apart) -
                                                 contact.radius_a - contact.radius_b);
            for (int k = 0; k < 3; ++k) row.arm_b[k][at.lane] = static_cast<Real>(arm[k]);
            PairBlock<Real, W>& block = rows.blocks[at.block];
            fill_mass(world.bodies, contact.b, block.inverse_mass_b, block.inverse_inertia_b,
                      at.lane);
        });
        run(kernels_.prepare, bodies, pass);
        run(kernels_.begin, bodies, cold(pass, 0));
    }

    void iterate_velocities(const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                            std::uint32_t worker) override {
        iterate(kernels_.solve_velocities, bodies, cold(pass, pass.iteration), worker);
    }
    void iterate_positions(const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        iterate(kernels_.solve_positions, bodies, cold(pass, pass.iteration + pass.round), worker);
    }

    /// Adds what the contacts bear in this substep.
    void add_impulses(ContactSums& sums) {
        const ContactArrays<Real, W> rows = batches_.arrays();
        each_contact([&](const ContactPlace& at) {
            const RowImpulse p = impulse_of(rows, at.row, at.lane);
            sums.add_of_particle(at.contact, p.normal, p.friction());
        });
    }

private:
    template <class Visit>
    void each_contact(Visit visit) const {
        for (std::size_t p = 0; p < pairs_.size(); ++p) batches_.each_contact(pairs_, p, visit);
    }

    /// Each substep begins from nothing and iterates alike: what deforms is never solved to the
    /// end, and impulses carried over would feed what is left.
    static PassSettings<Real> cold(PassSettings<Real> pass, std::uint32_t iteration) {
        pass.warm_start = false;
        pass.forwards = iteration % 2 == 0;
        return pass;
    }

    void run(ContactPass<Real, W> kernel, const BodyRows<Real>& bodies,
             const PassSettings<Real>& pass) {
        workers_.run([&](std::uint32_t worker) { iterate(kernel, bodies, pass, worker); });
    }

    void iterate(ContactPass<Real, W> kernel, const BodyRows<Real>& bodies,
                 const PassSettings<Real>& pass, std::uint32_t worker) {
        iterate_batches(kernel, batches_, bodies, pass, workers_, worker);
    }

    ContactVariant variant_;
    const ContactKernels<Real, W>& kernels_;
    Workers& workers_;
    std::vector<BodyPair> pairs_;
    Colouring colouring_;
    ContactBatches<Real, W> batches_;
};

}  // namespace plumb
