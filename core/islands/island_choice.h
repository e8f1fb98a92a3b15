// SPDX-License-Identifier: MIT
/// Which islands are solved exactly, and what becomes of those that are no longer.
///
/// An island is solved exactly where it has at most Settings::exact_islands bodies and, unless it
/// is very small, is calm: what flies and tumbles needs no exact forces, and they would cost most
/// there. Of larger ones large_islands.h tells. Sweeps are enough for a body that rolls or slides
/// on what is immovable; one that hardly moves shall not creep.
///
/// Ties hold an island together as contacts do, and are solved with it; links between bodies and
/// couplings, and joints that close a loop, are so even where nothing touches: others only iterate
/// them. Left to others are islands with motors that nothing can stop, with links to particles,
/// with joints or links that turn far within a substep or pull so hard that levers have to turn
/// with them (constraints/joint_lever.h, constraints/link.h), and for a while those whose ties
/// could not be closed. Of these last three, what links, couplings or loops tie and nothing drives
/// is swept here, where it is seen to that it gains nothing; what something drives is left to
/// others as a whole.
///
/// What overlaps deeply is left to others, too, where it is squeezed, jointed or very small. A heap
/// that is left to itself is swept here until it is out: its sweeps find more than others do.
#pragma once

#include "islands/driven_islands.h"
#include "islands/island_obstacles.h"
#include "schedule/contact_islands.h"
#include "ties/tie_list.h"

#include <vector>

namespace plumb {

/// What becomes of an island: solved or swept here, or left to others.
enum class IslandWay : std::uint8_t { exact, swept, left };

/// Islands of so many bodies are solved exactly however they move.
inline constexpr std::uint32_t kVerySmall = 8;
/// What sweeps do not hold, too, up to so many bodies: robots that land on their feet, whose joints
/// they open, and heavy bodies on light ones, into which they sink. Of more than a few bodies, half
/// must be jointed: a heap that a chain hits is no robot.
inline constexpr std::uint32_t kMostHard = 64, kFewHard = 16;
/// While contacts slide, part and approach by no more than so many radii in a substep. Joints that
/// are opened cost more than contacts that are late; a heap that is stirred is swept as others are.
inline constexpr double kTreeFollowed = 2, kHeapFollowed = 0.1;

class IslandChoice {
public:
    /// Once a step, before the others: finds the islands that pairs and ties make. `solved`: ties
    /// that others solve already, whose bodies are left to them.
    const ContactIslands& find(const World& world, const std::vector<BodyPair>& pairs,
                               const SolvedTies& solved);

    /// Those that it found.
    const ContactIslands& islands() const { return found_; }

    /// A tie of the islands.
    const Tie& tie(std::uint32_t i) const { return ties_[i]; }

    /// Whether it is small, and sweeps would not hold it: see kMostHard.
    bool is_hard(const World& world, const ContactIsland& island,
                 const std::vector<BodyPair>& pairs) const;

    IslandWay way_of(const World& world, const ContactIsland& island,
                     const std::vector<BodyPair>& pairs);

    /// Whether an island that could not be solved may be disputed (islands/island_effort.h): a heap
    /// that nothing drives and no joint holds.
    bool is_loose_heap(const ContactIsland& island) const;

    /// Leaves an island to others, and marks what of it goes on from its impulses there.
    void leave(const World& world, const ContactIsland& island, const std::vector<BodyPair>& pairs);

    /// Whether links, couplings or joints that close a loop tie it: others only iterate those. Few
    /// couplings of a tree that touches something are none: with them it is solved as others are.
    bool is_meshed(const ContactIsland& island) const;
    bool is_torn(const World& world, const ContactIsland& island) const;

    /// Whether a tie of it may give it energy (ties/tie_work.h).
    bool can_do_work(const World& world, const ContactIsland& island) const;

    /// Whether it lies still, as far as sweeps tell, and overlaps by little
    /// (islands/large_islands.h).
    bool rests(const World& world, const ContactIsland& island,
               const std::vector<BodyPair>& pairs) const;

    /// Of a heap that moves: whether it was given up, and sweeps have not brought it to rest.
    bool moved_on(const World& world, const ContactIsland& island,
                  const std::vector<BodyPair>& pairs) const;

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

    /// Whether the island of a body is moved by others. `row`: of the body, dynamic.
    bool is_driven(std::int32_t row) const { return driven_.is_driven(row); }
    bool is_driven(const ContactIsland& island) const {
        return is_driven(found_.bodies()[island.first_body]);
    }

    /// Contacts that are left to sweeps until they are out.
    const std::vector<std::uint32_t>& jammed() const { return jammed_; }

private:
    bool is_loose(const ContactIsland& island) const;  // nothing ties or drives it
    bool is_slow(const World& world, const Contact& contact) const;

    /// How fast an island's contacts slide, part and approach.
    struct Stir {
        double speed = 0;             ///< root of the mean square [m/s]
        double radius = 0, pull = 0;  ///< the greatest of its bodies [m], [m/s²]
    };
    template <class VelocityAt>
    Stir stir_of(const World& world, const ContactIsland& island,
                 const std::vector<BodyPair>& pairs, VelocityAt velocity_at) const;
    /// What is `hard` is calm as long as contacts of a substep's start will do until its end.
    bool is_calm(const World& world, const ContactIsland& island,
                 const std::vector<BodyPair>& pairs, bool hard) const;
    bool rests_and_misses(const World& world, const ContactIsland& island,
                          const std::vector<BodyPair>& pairs) const;
    bool waits_for_rest(const World& world, const ContactIsland& island,
                        const std::vector<BodyPair>& pairs) const;
    template <class Is>
    bool most_of(const World& world, const ContactIsland& island,
                 const std::vector<BodyPair>& pairs, Is is) const;
    void find_upset(const World& world, const ContactIsland& island,
                    const std::vector<BodyPair>& pairs);
    void mark(const World& world, const BodyPair& pair, double bears);
    double weight_of(const World& world, const ContactIsland& island,
                     const std::vector<BodyPair>& pairs);

    ContactIslands found_;
    TieList ties_;
    bool has_seeds_ = true;  // as far as is known
    DrivenIslands driven_;
    IslandObstacles obstacles_;
    double stuck_share_ = 1;             // of an overlap, from which it counts as left
    std::vector<double> bears_;          // [dynamic row], see goes_on [N s]
    std::vector<std::uint8_t> weighed_;  // [body of an island]
    std::vector<BodyPair> upset_;        // of an island: what is jammed or too deep
    std::vector<std::uint32_t> jammed_;
};

}  // namespace plumb
