// SPDX-License-Identifier: MIT
#include "contacts/reuse_contacts.h"

#include "contacts/contact_measures.h"
#include "contacts/contact_pairs.h"

#include <algorithm>

namespace plumb {
namespace {

/// Share of the reuse distance by which a rim may turn while its contacts are kept.
constexpr double kLag = 0.01;

/// Share of it by which what is round may move where contacts are solved exactly. Contacts that lag
/// by x behind what rolls over a radius r lead it on by g x/r: what lies in a hollow swings for
/// ever, and what rolls slowly gets faster.
constexpr double kStill = 1e-4;

/// Share of what is allowed up to which a bound on the motion is as good as the motion: roundings
/// are less than the rest.
constexpr double kSure = 0.99;

/// Less than any motion is.
constexpr double kNone = -1;

/// So many pairs ahead the memory of their poses is asked for: only some are looked at, and the
/// processor does not foresee which.
constexpr std::ptrdiff_t kAhead = 8;

/// The smaller body of a pair, whose points are watched in the frame of the other.
struct Watched {
    std::uint32_t small, large;
};
Watched watched(const Bodies& b, std::uint32_t i, std::uint32_t j) {
    return b.bounding_radius[i] < b.bounding_radius[j] ? Watched{i, j} : Watched{j, i};
}

/// Twice the sine of half the angle by which the smaller body has turned in the other's frame: a
/// point at distance r has moved by r times it.
double turn_between(const PairPose& then, const PairPose& now) {
    return 2 * (then.turn.conjugate() * now.turn).vec().norm();
}

/// How far the smaller body of a pair may move against the other [m], and by how much its rim may
/// turn, while their contacts are kept. Contacts on a rim that turns would lag behind it, and brake
/// what rolls.
struct Allowed {
    double moved, turned;

    /// Whether a bound on the motion is enough to tell.
    bool surely_holds(double bound) const { return bound <= kSure * std::min(moved, turned); }
};

/// Goes through the candidates of a detection and the pairs of the one before side by side.
class Choice {
public:
    explicit Choice(const ReuseContext& context)
        : world_(*context.world),
          motions_(*context.motions),
          contacts_(world_.contacts),
          kept_(contacts_.kept),
          fall_(fall_in_step(world_.settings)) {
        kept_.born.clear(), kept_.born_poses.clear();
    }

    /// Whether the narrow phase must run on a pair: it would find nothing where bounding spheres
    /// are too far apart. Nothing is kept of one that is out of order or of no bodies, which is a
    /// fault of the collider.
    bool is_wanted(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = pair_key(a, b);
        if (!(a < b) || b >= motions_.size() || key <= last_) return true;
        last_ = key;
        if (motions_[a].is_still && motions_[b].is_still) return false;  // its contacts lie aside
        std::vector<KeptPair>& pairs = kept_.pairs;
        while (read_ < pairs.size() && key_of(pairs[read_]) < key) contact_ += pairs[read_++].count;
        const double margin = world_.settings.margin + motions_[a].sweep + motions_[b].sweep;
        if (read_ == pairs.size() || key_of(pairs[read_]) != key) {
            if (spheres_are_apart(world_.bodies, a, b, margin)) return false;
            KeptPair& born = kept_.born.emplace_back(KeptPair{a, b, 0, 0, true, margin, 0, 0});
            renew(born, kept_.born_poses.emplace_back(), pose_of(born), margin);
            return true;
        }
        KeptPair& pair = pairs[read_];
        PairPose& pose = kept_.poses[read_];
        __builtin_prefetch(&pose + kAhead), __builtin_prefetch(&(&pose + kAhead)->turn);
        pair.first = contact_;
        contact_ += pair.count;
        add_motion(pair);
        const Allowed most = allowed(pair, margin);
        PairPose now;
        if (most.surely_holds(pair.moved) || will_do(pair, pose, now = pose_of(pair), most)) {
            keep(pair);
        } else if (spheres_are_apart(world_.bodies, a, b, margin)) {
            ++read_;
            return false;
        } else {
            renew(pair, pose, now, margin);
        }
        const bool wanted = pair.fresh;
        if (write_ != read_) pairs[write_] = pair, kept_.poses[write_] = pose;
        ++write_, ++read_;
        return wanted;
    }

    /// Only pairs that are candidates stay, and new ones go among them, the last first.
    void finish() {
        const std::size_t size = write_ + kept_.born.size();
        kept_.pairs.resize(size), kept_.poses.resize(size);
        for (std::size_t to = size, from = write_, born = kept_.born.size(); born > 0;) {
            const bool stays =
                from > 0 && bodies_of(kept_.born[born - 1]) < bodies_of(kept_.pairs[from - 1]);
            --to, stays ? --from : --born;
            kept_.pairs[to] = stays ? kept_.pairs[from] : kept_.born[born];
            kept_.poses[to] = stays ? kept_.poses[from] : kept_.born_poses[born];
        }
    }

private:
    PairPose pose_of(const KeptPair& pair) const {
        const Bodies& b = world_.bodies;
        const auto [small, large] = watched(b, pair.a, pair.b);
        const Quaterniond back = b.orientation[large].conjugate();
        return {back * (b.position[small] - b.position[large]), back * b.orientation[small]};
    }

    void renew(KeptPair& pair, PairPose& pose, const PairPose& now, double margin) const {
        pose = now;
        pair.fresh = true, pair.margin = margin, pair.moved = 0;
        pair.reach = pose.offset.norm() + smaller_radius(pair);
    }

    /// What was detected in the step before is known from now on.
    void keep(KeptPair& pair) {
        if (pair.fresh)
            for (std::uint32_t i = 0; i < pair.count; ++i) {
                ContactMemory& memory = contacts_.memory[pair.first + i];
                memory.known = memory.matched = true;
            }
        pair.fresh = false;
    }

    double smaller_radius(const KeptPair& pair) const {
        const std::vector<double>& radius = world_.bodies.bounding_radius;
        return std::min(radius[pair.a], radius[pair.b]);
    }

    /// Adds what the bodies have moved since the detection before to the bound of a pair.
    void add_motion(KeptPair& pair) const {
        const PoseChange &a = motions_[pair.a].change, &b = motions_[pair.b].change;
        pair.moved += a.travel + b.travel + (a.turn + b.turn) * (pair.reach + pair.moved);
    }

    /// Whether the contacts of a pair will do at the pose now. Its bound is brought up to date.
    bool will_do(KeptPair& pair, const PairPose& then, const PairPose& now,
                 const Allowed& most) const {
        pair.moved = (now.offset - then.offset).norm();
        if (pair.moved > most.moved) return false;
        const double turn = turn_between(then, now) * smaller_radius(pair);
        pair.moved += turn;
        return turn <= most.turned && pair.moved <= most.moved;
    }

    /// By how much a pair may move that was farther apart than its margin [m]; 0 where it was not.
    double allowed_apart(const KeptPair& pair, double margin) const {
        if (pair.count > 0) return 0;
        const double step = motions_[pair.a].travel + motions_[pair.b].travel + fall_;
        return pair.margin - std::max(margin - world_.settings.margin / 2, 2 * step);
    }

    Allowed allowed(const KeptPair& pair, double margin) const {
        const double distance = world_.settings.reuse_distance;
        const double apart = allowed_apart(pair, margin);
        if (apart > distance) return {apart, apart};
        if (pair.margin < margin - distance) return {kNone, kNone};
        const BodyMotion &a = motions_[pair.a], &b = motions_[pair.b];
        Allowed most{distance, distance};
        if (!a.is_round && !b.is_round) return most;
        if (a.has_rim || b.has_rim) most.turned = kLag * distance;
        if (pair.count > 0 && contacts_.memory[pair.first].exact) most.moved = kStill * distance;
        return most;
    }

    static std::uint64_t key_of(const KeptPair& pair) { return pair_key(pair.a, pair.b); }

    World& world_;
    const std::vector<BodyMotion>& motions_;
    ContactTable& contacts_;
    KeptContacts& kept_;
    const double fall_;                 // [m]
    std::size_t read_ = 0, write_ = 0;  // of the pairs
    std::uint32_t contact_ = 0;         // the first of pair `read_`
    std::uint64_t last_ = 0;            // pair_key of the last that was in order
};

void choose(void* ctx, const CandidatePair* pairs, std::uint32_t count, std::uint8_t* wanted) {
    auto& context = *static_cast<ReuseContext*>(ctx);
    if (context.asked) {  // once is enough: what was kept is no longer what it was
        forget_kept_contacts(*context.world);
        std::fill_n(wanted, count, std::uint8_t{1});
        return;
    }
    context.asked = true;
    Choice choice(context);
    for (std::uint32_t i = 0; i < count; ++i) wanted[i] = choice.is_wanted(pairs[i].a, pairs[i].b);
    choice.finish();
}

}  // namespace

PairFilter reuse_filter(ReuseContext& context) { return {&context, choose}; }

void forget_kept_contacts(World& world) {
    world.contacts.kept.pairs.clear();
    world.contacts.kept.poses.clear();
}

}  // namespace plumb
