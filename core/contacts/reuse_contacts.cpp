// SPDX-License-Identifier: MIT
#include "contacts/reuse_contacts.h"

#include <algorithm>
#include <tuple>

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

std::tuple<std::uint32_t, std::uint32_t> key(const KeptPair& p) { return {p.a, p.b}; }

/// The smaller body of a pair, whose points are watched in the frame of the other.
struct Watched {
    std::uint32_t small, large;
};
Watched watched(const Bodies& b, std::uint32_t i, std::uint32_t j) {
    return b.bounding_radius[i] < b.bounding_radius[j] ? Watched{i, j} : Watched{j, i};
}

void measure_pose(KeptPair& pair, const Bodies& b) {
    const auto [small, large] = watched(b, pair.a, pair.b);
    const Quaterniond back = b.orientation[large].conjugate();
    pair.offset = back * (b.position[small] - b.position[large]);
    pair.turn = back * b.orientation[small];
}

/// Twice the sine of half the angle by which the smaller body has turned in the other's frame: a
/// point at distance r has moved by r times it.
double turned(const KeptPair& then, const KeptPair& now) {
    return 2 * (then.turn.conjugate() * now.turn).vec().norm();
}

/// How far the smaller body of a pair may move against the other [m], and by how much its rim may
/// turn, while their contacts are kept. Contacts on a rim that turns would lag behind it, and brake
/// what rolls.
struct Allowed {
    double moved, turned;
};

/// What the bodies of a pair have moved by since the detection before, at most [m].
double motion_of(const KeptPair& pair, const Bodies& b, const std::vector<PoseChange>& changes) {
    const PoseChange &of_a = changes[pair.a], &of_b = changes[pair.b];
    const double radius = std::min(b.bounding_radius[pair.a], b.bounding_radius[pair.b]);
    const double reach = pair.offset.norm() + pair.moved + radius;
    return of_a.travel + of_b.travel + (of_a.turn + of_b.turn) * reach;
}

/// Whether the contacts of a pair will do at the poses now. Its bound is brought up to date.
bool will_do(KeptPair& pair, const Bodies& b, const Allowed& most) {
    const double surely = kSure * std::min(most.moved, most.turned);
    if (pair.moved <= surely) return true;
    KeptPair now = pair;
    measure_pose(now, b);
    const double radius = b.bounding_radius[watched(b, pair.a, pair.b).small];
    const double turn = turned(pair, now) * radius;
    pair.moved = (now.offset - pair.offset).norm() + turn;
    return turn <= most.turned && pair.moved <= most.moved;
}

/// Goes through the candidates of a detection and the pairs of the one before side by side.
class Choice {
public:
    explicit Choice(const ReuseContext& context)
        : context_(context), world_(*context.world), contacts_(world_.contacts) {
        contacts_.kept.born.clear();
    }

    /// Whether the narrow phase must run on a pair. Nothing is kept of one that is out of order or
    /// of no bodies, which is a fault of the collider.
    bool is_wanted(std::uint32_t a, std::uint32_t b) {
        if (!(a < b) || b >= context_.sweeps->size() || std::tie(a, b) <= last_) return true;
        last_ = {a, b};
        std::vector<KeptPair>& pairs = contacts_.kept.pairs;
        while (read_ < pairs.size() && key(pairs[read_]) < std::tie(a, b)) leave_out();
        const double margin =
            world_.settings.margin + (*context_.sweeps)[a] + (*context_.sweeps)[b];
        if (read_ == pairs.size() || key(pairs[read_]) != std::tie(a, b)) {
            KeptPair& born = contacts_.kept.born.emplace_back();
            born.a = a, born.b = b;
            renew(born, margin);
            return true;
        }
        KeptPair& pair = pairs[read_];
        pair.first = contact_;
        if (is_kept(pair, margin))
            keep(pair);
        else
            renew(pair, margin);
        const bool wanted = pair.fresh;
        contact_ += pair.count;
        if (write_ != read_) pairs[write_] = pair;
        ++write_, ++read_;
        return wanted;
    }

    /// Only pairs that are candidates stay, and new ones go among them.
    void finish() {
        std::vector<KeptPair>&pairs = contacts_.kept.pairs, &born = contacts_.kept.born;
        pairs.resize(write_);
        if (born.empty()) return;
        pairs.insert(pairs.end(), born.begin(), born.end());
        std::inplace_merge(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(write_),
                           pairs.end(),
                           [](const KeptPair& p, const KeptPair& q) { return key(p) < key(q); });
    }

private:
    void leave_out() { contact_ += contacts_.kept.pairs[read_++].count; }

    void renew(KeptPair& pair, double margin) const {
        pair.fresh = true, pair.margin = margin, pair.moved = 0;
        measure_pose(pair, world_.bodies);
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

    bool is_kept(KeptPair& pair, double margin) const {
        const double motion = motion_of(pair, world_.bodies, *context_.changes);
        pair.moved += motion;
        const double apart = allowed_apart(pair, margin, motion);
        const double distance = world_.settings.reuse_distance;
        if (apart > distance) return will_do(pair, world_.bodies, {apart, apart});
        return pair.margin >= margin - distance && will_do(pair, world_.bodies, allowed(pair));
    }

    /// By how much a pair may move that was farther apart than its margin [m]; 0 where it was not.
    double allowed_apart(const KeptPair& pair, double margin, double motion) const {
        if (pair.count > 0) return 0;
        return pair.margin - std::max(margin - world_.settings.margin / 2, 2 * motion);
    }

    Allowed allowed(const KeptPair& pair) const {
        const double distance = world_.settings.reuse_distance;
        const Roundness &a = (*context_.roundness)[pair.a], &b = (*context_.roundness)[pair.b];
        Allowed most{distance, distance};
        if (!a.is_round && !b.is_round) return most;
        if (a.has_rim || b.has_rim) most.turned = kLag * distance;
        if (pair.count > 0 && contacts_.memory[pair.first].exact) most.moved = kStill * distance;
        return most;
    }

    const ReuseContext& context_;
    World& world_;
    ContactTable& contacts_;
    std::size_t read_ = 0, write_ = 0;                     // of the pairs
    std::uint32_t contact_ = 0;                            // the first of pair `read_`
    std::tuple<std::uint32_t, std::uint32_t> last_{0, 0};  // that was in order
};

void choose(void* ctx, const CandidatePair* pairs, std::uint32_t count, std::uint8_t* wanted) {
    auto& context = *static_cast<ReuseContext*>(ctx);
    context.asked = true;
    Choice choice(context);
    for (std::uint32_t i = 0; i < count; ++i) wanted[i] = choice.is_wanted(pairs[i].a, pairs[i].b);
    choice.finish();
}

}  // namespace

PairFilter reuse_filter(ReuseContext& context) { return {&context, choose}; }

void forget_kept_contacts(World& world) { world.contacts.kept.pairs.clear(); }

}  // namespace plumb
