// SPDX-License-Identifier: MIT
/// What the factorisations of an island take in vain, and when it is given up.
///
/// A structure finds its forces in some thirty factorisations, or in a hundred once it is jolted. A
/// large heap that has just settled misses its laws after hundreds, and in each substep again,
/// though sweeps carry it well. So what is taken in vain is summed up, less what a step may take
/// freely, until the island is solved once. One that comes to more than it may is swept for the
/// rest of the step, and for a while.
///
/// A smaller heap takes in vain most while it moves, a step's forces being of no use to the next.
/// Its unit is so many of its own factorisations, and it may take fewer. One that was given up is
/// tried again as soon as it rests. If sweeps do not bring it to rest, it is solved as far as that
/// goes until it does.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace plumb {

/// As many as an island takes.
inline constexpr std::uint64_t kAnyProducts = std::numeric_limits<std::uint64_t>::max();

/// What the factorisations of a large island in a substep may take, in products of two 6 × 6
/// blocks: some two seconds, or a millisecond for each of its bodies. One that could not have
/// kFewest of them is left to sweeps: a wall of 10,000 bricks can, a heap of as many is far from
/// it, for a body of that has more neighbours.
inline constexpr std::uint64_t kFewest = 30;
inline std::uint64_t most_products(std::uint32_t bodies) {
    return std::max<std::uint64_t>(100'000'000, std::uint64_t{50'000} * bodies);
}

/// The least unit of large islands [products], which is one factorisation if that takes more; how
/// many of them are free in a step, and how many they may take in vain.
inline constexpr std::uint64_t kLargeUnit = 2'500'000, kFreeUnits = 4;
inline constexpr std::uint8_t kMostInVain = 60;

/// A unit of smaller heaps [factorisations], and how many they may take in vain.
inline constexpr std::uint64_t kHeapUnit = 8;
inline constexpr std::uint8_t kMostOfHeap = 20;

/// ContactMemory::missed: 0 where sweeps will do for the island of the contact; where it is to be
/// solved exactly, 1 and what has been taken in vain [units]. Above that it waits for so many times
/// kTick steps until it is tried again: kTriesAgain where its system was too large or it missed far
/// too much, kInVain where it is large and has taken all that it may, kHeapInVain where it is a
/// smaller heap.
inline constexpr std::uint8_t kMissed = 1, kTriesAgain = 77, kHeapInVain = 93, kInVain = 255;
inline constexpr std::uint64_t kTick = 8;
inline bool waits(std::uint8_t missed) { return missed > kMissed + kMostInVain; }

/// After a step in which the island was swept. `step`: how many there were.
inline std::uint8_t missed_after_sweeps(std::uint8_t missed, std::uint64_t step) {
    if (!waits(missed)) return 0;
    const std::uint8_t left = missed - (step % kTick == 0);
    return waits(left) ? left : 0;
}

/// The account of one island in one step.
class IslandAccount {
public:
    /// Of an island that takes what it needs, and is never given up.
    IslandAccount() = default;

    // `products`: of one factorisation

    static IslandAccount of_large(std::uint32_t bodies, std::uint64_t products) {
        return {std::max(kLargeUnit, products), kFreeUnits, kMostInVain, kInVain,
                most_products(bodies)};
    }

    /// Of a smaller heap.
    static IslandAccount of_heap(std::uint64_t products) {
        return {kHeapUnit * products, 0, kMostOfHeap, kHeapInVain, kAnyProducts};
    }

    /// Whether what is taken in vain is counted at all.
    bool is_kept() const { return unit_ > 0; }

    /// What one of its contacts remembers of the step before.
    void recall(std::uint8_t missed) {
        if (!waits(missed) && missed > kMissed)
            in_vain_ = std::max(in_vain_, (missed - kMissed) * unit_);
    }

    // in each substep

    void begin_substep() { left_ = most_; }
    /// What it may still take, and what it has taken [products].
    std::uint64_t left() const { return left_; }
    void take(std::uint64_t products) { left_ -= std::min(left_, products); }
    /// Returns whether it is given up for the rest of the step.
    bool end_substep(bool solved) {
        if (!is_kept()) return false;
        in_vain_ = solved ? 0 : in_vain_ + most_ - left_;
        given_up_ = in_vain_ > most_in_vain_ * unit_;
        return given_up_;
    }

    bool is_given_up() const { return given_up_; }

    /// What its contacts remember for the next step.
    std::uint8_t missed() const {
        if (!is_kept()) return 0;
        if (given_up_) return waits_as_;
        const std::uint64_t kept = in_vain_ - std::min(in_vain_, free_ * unit_);
        return static_cast<std::uint8_t>(kMissed +
                                         std::min<std::uint64_t>(kMostInVain, kept / unit_));
    }

private:
    IslandAccount(std::uint64_t unit, std::uint64_t free, std::uint8_t most_in_vain,
                  std::uint8_t waits_as, std::uint64_t most)
        : unit_(unit), free_(free), most_in_vain_(most_in_vain), waits_as_(waits_as), most_(most) {}

    std::uint64_t unit_ = 0;             // [products]; 0: it is never given up
    std::uint64_t free_ = 0;             // of a step [units]
    std::uint64_t most_in_vain_ = 0;     // [units]
    std::uint8_t waits_as_ = 0;          // ContactMemory::missed once it is given up
    std::uint64_t most_ = kAnyProducts;  // that a substep may take [products],
    std::uint64_t left_ = kAnyProducts;  // and what is left of it
    std::uint64_t in_vain_ = 0;          // since it was solved [products]
    bool given_up_ = false;              // in this step
};

}  // namespace plumb
