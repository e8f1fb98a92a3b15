// SPDX-License-Identifier: MIT
/// A step that is warmed up allocates nothing. Counted with operator new; the collider is one that
/// allocates nothing either, so that whatever is counted is the solver's.
#include "support/scenes.h"
#include "support/soft_scenes.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};

void* allocate(std::size_t size, std::size_t alignment) {
    if (counting) ++allocations;
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t a) {
    return allocate(size, static_cast<std::size_t>(a));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace plumb::test {
namespace {

/// Answers what another collider said once.
class Replayed : public Proximity {
public:
    std::vector<Contact> contacts;
    std::vector<std::vector<Contact>> touches;  ///< of the particles of each deformable, in turn
    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return ok_status(); }
    Status remove(std::uint32_t) noexcept override { return ok_status(); }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
    DetectStats stats() const noexcept override { return {}; }
    Status detect(const DetectRequest&, const ContactSink* sinks, std::uint32_t) noexcept override {
        Contact* room = sinks[0].grow(sinks[0].ctx, static_cast<std::uint32_t>(contacts.size()));
        std::copy(contacts.begin(), contacts.end(), room);
        turn_ = 0;
        return ok_status();
    }
    Status detect_particles(const ParticleRequest&, const ContactSink* sinks,
                            std::uint32_t) noexcept override {
        const std::vector<Contact>& said = touches[turn_++];
        Contact* room = sinks[0].grow(sinks[0].ctx, static_cast<std::uint32_t>(said.size()));
        for (const Contact& c : said) {
            *room = c;
            room->gap = std::min(c.gap, 0.0);  // near enough, however slowly all moves
            ++room;
        }
        return ok_status();
    }

private:
    std::size_t turn_ = 0;
};

/// Of so many steps.
long allocations_of(Simulation& simulation, int steps) {
    allocations = 0;
    counting = true;
    for (int i = 0; i < steps; ++i) simulation.step();
    counting = false;
    return allocations;
}

TEST(Allocation, AWarmStepAllocatesNothing) {
    for (const char* required : {"", "shock_propagation"})
        for (std::uint32_t threads : {1u, 2u})
            for (std::uint32_t substeps : {1u, 4u}) {
                Scene s;
                s.settings.threads = threads;
                s.settings.substeps = substeps;
                s.materials[0].restitution = 0.2;
                s.materials[0].rolling_friction = 0.01;
                if (*required) s.settings.require = {required};
                add_ground(s);
                for (int i = 0; i < 100; ++i)
                    add_body(s, box(0.2, 0.2, 0.25),
                             {0.402 * (i % 5), 0.2 + 0.402 * (i / 25), 0.502 * (i / 5 % 5)});
                JointSpec joint;
                joint.body_a = 1;
                joint.anchor = {0, 0.2, 0};
                s.joints.push_back(joint);
                Simulation teacher(s, colliders(), "reference");
                teacher.step();
                Replayed replayed;
                replayed.contacts = teacher.world().contacts.found;
                ASSERT_GT(replayed.contacts.size(), 100u);

                for (const bool watched : {false, true}) {
                    Simulation simulation(s, replayed);
                    if (watched) simulation.watch_contacts();
                    for (int i = 0; i < 3; ++i) simulation.step();
                    EXPECT_EQ(allocations_of(simulation, 5), 0)
                        << required << ", " << threads << " threads, " << substeps << " substeps"
                        << (watched ? ", contacts are watched" : "");
                }
            }
}

/// Of an island that is solved block by block, and of one that is too large for that: one pair of
/// neighbours or another does not touch, so that its system is ordered anew in each step.
TEST(Allocation, AWarmStepOfAnIslandWhosePairsChangeAllocatesNothing) {
    for (const std::uint32_t exact : {400u, 20u}) {
        Scene s;
        s.settings.exact_islands = exact, s.settings.accuracy = 1e-3;
        add_ground(s);
        for (int i = 0; i < 60; ++i)
            add_body(s, box(0.2, 0.2, 0.2), {0.4 * (i % 10), 0.2 + 0.4 * (i / 10), 0});
        Simulation teacher(s, colliders(), "reference");
        teacher.step();
        const std::vector<Contact>& all = teacher.world().contacts.found;
        std::vector<Contact> beside;  // one of each pair of neighbours
        for (const Contact& c : all)
            if (std::abs(c.normal.x) > 0.5 && (beside.empty() || beside.back().b != c.b))
                beside.push_back(c);
        ASSERT_GT(beside.size(), 20u);

        Replayed replayed;
        Simulation simulation(s, replayed);
        const auto allocations_of_step = [&](int i) {
            const Contact& apart = beside[static_cast<std::size_t>(i) % 7];
            replayed.contacts = all;
            std::erase_if(replayed.contacts,
                          [&](const Contact& c) { return c.a == apart.a && c.b == apart.b; });
            return allocations_of(simulation, 1);
        };
        for (int i = 0; i < 20; ++i) allocations_of_step(i);
        for (int i = 20; i < 30; ++i)
            EXPECT_EQ(allocations_of_step(i), 0) << "step " << i << ", exact up to " << exact;
    }
}

/// As one system, pairs of particles come to touch all the time, and it is ordered anew.
TEST(Allocation, AWarmStepOfDeformablesAllocatesNothing) {
    for (const auto& [precision, exact] :
         {std::pair(Precision::single, 0u), std::pair(Precision::double_, 0u),
          std::pair(Precision::single, 10000u), std::pair(Precision::double_, 10000u)}) {
        Scene s = soft_scene();
        s.settings.precision = precision, s.settings.exact_deformables = exact;
        Simulation teacher(s, colliders(), "reference");
        for (int i = 0; i < 60; ++i) teacher.step();
        Replayed replayed;
        replayed.touches.resize(s.deformables.size());
        for (Contact c : teacher.world().particle_contacts.found) {
            const std::uint32_t d = teacher.world().particles.deformable[c.a];
            c.a -= teacher.world().deformables[d].first;
            replayed.touches[d].push_back(c);
        }
        replayed.contacts = teacher.world().contacts.found;
        const std::size_t touching = teacher.world().particle_contacts.found.size();
        ASSERT_GT(touching, 50u);

        for (std::uint32_t threads : {1u, 2u}) {
            s.settings.threads = threads;
            Simulation simulation(s, replayed);
            simulation.restore(teacher.save());
            for (int i = 0; i < 20; ++i) simulation.step();
            ASSERT_EQ(simulation.world().particle_contacts.found.size(), touching);
            const auto near = simulation.world().kept_factors.near;
            EXPECT_EQ(allocations_of(simulation, 5), 0)
                << threads << " threads, as one system " << exact;
            EXPECT_EQ(simulation.world().kept_factors.near != near, exact > 0);
        }
    }
}

}  // namespace
}  // namespace plumb::test
