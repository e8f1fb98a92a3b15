// SPDX-License-Identifier: MIT
/// Which islands are solved exactly, and what becomes of those that are no longer.
///
/// An island is solved exactly where it has at most Settings::exact_islands bodies and, unless it
/// is very small, is calm: what flies and tumbles needs no exact forces, and they would cost most
/// there. Sweeps are enough for a body that rolls or slides on what is immovable; one that hardly
/// moves shall not creep.
///
/// Joints hold an island together as contacts do, and are solved with it. Left to others are
/// islands with couplings, with joints that close a loop, with motors that nothing can stop, with
/// joints that turn far within a substep or pull so hard that levers have to turn with them
/// (constraints/joint_lever.h), and for a while those whose joints could not be closed.
///
/// What overlaps deeply is left to others, too, where it is squeezed, jointed or very small. A heap
/// that is left to itself is swept here until it is out: its sweeps find more than others do.
#pragma once

#include "schedule/contact_islands.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// How fast gravity and the constant force would make a body in a second [m/s²].
double pull_on(const World& world, std::uint32_t body);

/// Of a contact's point on a against that on b, forces included [m/s].
Vector3d relative_velocity(const World& world, std::uint32_t contact);

/// What becomes of an island: solved or swept here, or left to others.
enum class IslandWay : std::uint8_t { exact, swept, left };

class IslandChoice {
public:
    /// Once a step, before the others: finds the islands that pairs make.
    const ContactIslands& find(const World& world, const std::vector<BodyPair>& pairs);

    /// The joint of a link of the islands.
    std::uint32_t joint_of(std::uint32_t link) const { return links_[link].first; }

    IslandWay way_of(const World& world, const ContactIsland& island,
                     const std::vector<BodyPair>& pairs);

    /// Whether an island that could not be solved may be disputed (step/island_effort.h): a heap
    /// that nothing drives and no joint holds.
    bool is_loose_heap(const ContactIsland& island) const;

    /// Whether it touches and hangs by nothing that is immovable.
    bool flies(const World& world, const ContactIsland& island,
               const std::vector<BodyPair>& pairs) const;

    /// Whether a contact that was solved exactly goes on from its impulses in the sweeps, to which
    /// its island is left because it has grown, or some of it moves, is jammed or overlaps deeply.
    /// It does unless
    ///   - one of its bodies touches what is jammed or too deep,
    ///   - it moves,
    ///   - or it bears more than the island weighs:
    /// what is jammed or was hit may hold each other by more than sweeps can take back.
    bool goes_on(const World& world, std::uint32_t contact) const;

    /// Whether an exact solution left an overlap [m] about as deep as it was.
    bool is_stuck(const ContactMemory& before, double overlap) const;

    /// Whether what is moved by others (a press, a conveyor) touches the island of a body. `row`:
    /// of the body, dynamic.
    bool is_driven(std::int32_t row) const { return driven_[static_cast<std::size_t>(row)] != 0; }
    bool is_driven(const ContactIsland& island) const {
        return is_driven(found_.bodies()[island.first_body]);
    }

    /// Contacts that are left to sweeps until they are out.
    const std::vector<std::uint32_t>& jammed() const { return jammed_; }

private:
    void find_links(const World& world);
    void find_driven(const World& world, const std::vector<BodyPair>& pairs);
    bool closes_loop(const BodyPair& link);
    void rule_out(const World& world);
    bool is_slow(const World& world, const Contact& contact) const;
    bool is_calm(const World& world, const ContactIsland& island,
                 const std::vector<BodyPair>& pairs) const;
    void find_upset(const World& world, const ContactIsland& island,
                    const std::vector<BodyPair>& pairs);
    void mark_what_goes_on(const World& world, const ContactIsland& island,
                           const std::vector<BodyPair>& pairs);
    void mark(const World& world, const BodyPair& pair, double bears);
    double weight_of(const World& world, const ContactIsland& island,
                     const std::vector<BodyPair>& pairs);

    ContactIslands found_;
    double stuck_share_ = 1;               ///< of an overlap, from which it counts as left
    std::vector<BodyPair> links_;          // of joints, and which
    std::vector<std::size_t> tied_;        // [dynamic row, then the ground] see closes_loop
    std::vector<std::uint8_t> ruled_out_;  // [dynamic row]
    std::vector<std::uint8_t> driven_;     // [dynamic row], see is_driven
    std::vector<double> bears_;            // [dynamic row], see goes_on [N s]
    std::vector<std::uint8_t> weighed_;    // [body of an island]
    std::vector<BodyPair> upset_;          // of an island: what is jammed or too deep
    std::vector<std::uint32_t> jammed_;
};

}  // namespace plumb
