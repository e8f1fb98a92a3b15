// SPDX-License-Identifier: MIT
#include "step/island_group.h"

#include "constraints/connector.h"
#include "constraints/contact.h"
#include "constraints/friction.h"
#include "contacts/anchors.h"
#include "contacts/contact_measures.h"
#include "math/rotation.h"
#include "step/island_rows.h"
#include "step/joint_geometry.h"
#include "step/large_islands.h"
#include "step/tie_work.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

/// A contact bears at most this many times the weight of its island (wedges and flat arches thrust
/// by more than they weigh), and this many times its momentum.
constexpr double kThrust = 100, kBlow = 10;

/// An overlap that sticks is left as it is from when the contact bears more than this share of the
/// most it may: each substep's push would only wind up the stress that locks them.
constexpr double kLocked = 0.1;

/// A joint may bear so many times more: levers and toggles multiply what they bear.
constexpr double kLever = 100;

/// How often an island is solved until its ties are closed; and at most, as long as each time
/// leaves no more than this share of what was open: near to where a linkage is stretched out it is
/// slow.
constexpr int kCloses = 8, kMostCloses = 40;
constexpr double kClosing = 0.8;

/// An island whose joints stay open by so many tolerances is given up for twice this long [s], and
/// twice as long with each time that it fails again; a tree for twice this less, so that it is
/// tried once more at once.
constexpr double kAjar = 100, kRest = 0.1;
constexpr std::uint32_t kMostMisses = 8;

/// Ties may be closed at other velocities, too, than those that a substep leads to: such that turn
/// bodies about. They are known by the energy that they add, as a share of what there is.
constexpr double kOtherRoot = 0.25;

/// More energy than so many times what there is did not come from what drives an island.
constexpr double kFlung = 4;

/// Bodies that fly about and overlap part at least at this share of their radius [1/s].
constexpr double kDrift = 0.3;

Vector3d velocity_at(const Bodies& b, std::uint32_t i, const Vector3d& arm) {
    return b.velocity[i] + b.angular_velocity[i].cross(arm);
}

/// A bound on the greatest eigenvalue: the greatest sum of a row.
double largest(const Symmetric3<double>& k) {
    const double xy = std::abs(k.xy), xz = std::abs(k.xz), yz = std::abs(k.yz);
    return std::max({k.xx + xy + xz, k.yy + xy + yz, k.zz + xz + yz});
}

/// Velocity along the normal that makes the gap what it shall be at the end of the substep [m/s].
double closing_velocity(double gap, double h, const PushOut& push_out) {
    const double left = overlap_left(gap, push_out.most);
    return -gap_below(gap - left, std::min(gap, 0.0) - left, push_out.share) / h;
}

bool does_stick(const IslandPoint& p) {
    return plumb::does_stick(p.impulse[0], p.impulse.segment<2>(1).squaredNorm(), p.cone.friction);
}

/// Of a driven axis, as far as its bounds or the substep before tell.
double greatest_impulse(const IslandRow& row) {
    double most = std::abs(row.impulse);
    for (int i = 0; i < row.drive->n; ++i)
        for (const double bound : {row.drive->rows[i].lowest, row.drive->rows[i].highest})
            if (std::isfinite(bound)) most = std::max(most, std::abs(bound));
    return most;
}

}  // namespace

IslandGroup::IslandGroup(const Plan& plan, Workers& workers, SolvedTies& solved)
    : workers_(workers),
      solved_(solved),
      has_friction_(plan.runs(Effect::friction)),
      resists_rolling_(plan.runs(Effect::turning_friction)),
      solvers_(workers.count()) {}

// ---- once a step

void IslandGroup::load(const World& world, std::vector<BodyPair>& pairs) {
    count_ = 0, costly_ = 0;
    set_aside_.clear();
    bodies_.clear(), points_.clear(), locked_.clear(), opening_.clear(), parting_.clear(),
        contacts_.clear(), ties_.clear(), solved_.clear();
    const ContactIslands& found = choice_.find(world, pairs);
    taken_.assign(pairs.size(), 0);
    for (const ContactIsland& island : found.islands()) {
        const IslandWay way = choice_.way_of(world, island, pairs);
        if (way == IslandWay::left) continue;
        if (take(world, island, found, pairs))
            choose_effort(world, members_[count_ - 1], way == IslandWay::swept);
        else
            set_aside(world, island, found, pairs);
    }

    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (!taken_[i]) pairs[kept++] = pairs[i];
    pairs.resize(kept);
    velocity_.resize(bodies_.size());
    start_.resize(bodies_.size());
    force_.resize(bodies_.size());
    shift_.resize(bodies_.size());
    take_geometry(world);
    take_memory(world);
    is_fresh_ = true;
}

/// The system of the island's pairs and ties, if its solution does not take too much.
bool IslandGroup::find_system(const World& world, Member& member, const ContactIsland& island,
                              const ContactIslands& found, const std::vector<BodyPair>& pairs) {
    pattern_.clear();
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const BodyPair& pair = pairs[found.pairs()[i]];
        if (std::max(pair.row_a, pair.row_b) < world.dynamic_count)
            pattern_.emplace_back(found.index_in_island(pair.row_a),
                                  found.index_in_island(pair.row_b));
    }
    for (std::uint32_t i = island.first_tie; i < island.last_tie; ++i) {
        tied_.clear();
        each_body(world, choice_.tie(found.ties()[i]), [&](std::uint32_t body) {
            const std::uint32_t here = index_in_island(world, found, body);
            if (here == kImmovable) return;
            for (const std::uint32_t other : tied_)
                if (other != here) pattern_.emplace_back(other, here);
            tied_.push_back(here);
        });
    }
    const std::uint32_t n = island.last_body - island.first_body;
    if (member.system.rows() == n && member.pattern == pattern_) return true;
    member.pattern = pattern_;
    return member.system.analyse(
        n, pattern_, is_large(world.settings, n) ? kMostProducts / kFewest : kAnyProducts);
}

/// Returns whether its solution does not take too much; else nothing is taken.
bool IslandGroup::take(const World& world, const ContactIsland& island, const ContactIslands& found,
                       const std::vector<BodyPair>& pairs) {
    if (count_ == members_.size()) members_.emplace_back();
    Member& member = members_[count_];
    if (!find_system(world, member, island, found, pairs)) return false;
    ++count_;
    const std::uint32_t n = island.last_body - island.first_body;
    member.is_large = is_large(world.settings, n);
    member.first_body = static_cast<std::uint32_t>(bodies_.size());
    member.first_point = static_cast<std::uint32_t>(points_.size());
    ties_.begin_island(member.ties);
    member.given_up = false;
    member.open = 0;
    member.may_be_disputed = choice_.is_loose_heap(island);
    member.is_driven = choice_.is_driven(island);
    member.may_give_up = member.is_driven || !choice_.is_hard(world, island, pairs);
    member.gains_nothing = !member.is_driven;
    member.is_meshed = choice_.is_meshed(island) && !member.is_driven;
    member.flies = choice_.flies(world, island, pairs);
    bodies_.resize(bodies_.size() + n);

    const auto place = [&](std::uint32_t body) {
        const std::uint32_t here = index_in_island(world, found, body);
        if (here != kImmovable) bodies_[member.first_body + here].body = body;
        return here;
    };
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const std::uint32_t at = found.pairs()[i];
        const BodyPair& pair = pairs[at];
        taken_[at] = 1;
        const Contact& first = world.contacts.found[pair.first];
        const std::uint32_t a = place(first.a), b = place(first.b);
        for (std::uint32_t k = 0; k < pair.count; ++k) add_point(world, pair.first + k, a, b);
    }
    for (std::uint32_t i = island.first_tie; i < island.last_tie; ++i) {
        const Tie& tie = choice_.tie(found.ties()[i]);
        each_body(world, tie, [&](std::uint32_t body) { place(body); });
        ties_.add(world, found, tie);
        solved_[tie] = 1;
        member.gains_nothing &= !can_do_work(world, tie);
    }
    member.last_body = static_cast<std::uint32_t>(bodies_.size());
    member.last_point = static_cast<std::uint32_t>(points_.size());
    const bool is_heap = !member.is_large && member.may_be_disputed && n > kHeap;
    member.moves = is_heap && !choice_.rests(world, island, pairs);
    member.moved_on = member.moves && choice_.moved_on(world, island, pairs);
    member.account = account_of(world, member);
    ties_.end_island(member.ties);
    return true;
}

/// What would take too much is left to sweeps, and tried again after a while.
void IslandGroup::set_aside(const World& world, const ContactIsland& island,
                            const ContactIslands& found, const std::vector<BodyPair>& pairs) {
    choice_.leave(world, island, pairs);
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i)
        set_aside_.push_back(pairs[found.pairs()[i]]);
    ++costly_;
}

/// Whether nothing in it overlaps by much.
bool IslandGroup::is_shallow(const World& world, const Member& member) const {
    const auto contacts =
        std::span(contacts_).subspan(member.first_point, member.last_point - member.first_point);
    return std::all_of(contacts.begin(), contacts.end(), [&](std::uint32_t i) {
        const Contact& contact = world.contacts.found[i];
        return -contact.gap <= kShallow * smaller_radius(world.bodies, contact);
    });
}

/// Of a large island, or of a heap that moves: with what it has taken in vain until now.
IslandAccount IslandGroup::account_of(const World& world, const Member& m) const {
    IslandAccount account;
    if (m.is_large)
        account = IslandAccount::of_large();
    else if (m.moves && !m.moved_on)
        account = IslandAccount::of_heap(m.system.block_products());
    if (!account.is_kept()) return account;
    for (std::uint32_t k = m.first_point; k < m.last_point; ++k) {
        const ContactMemory& memory = world.contacts.memory[contacts_[k]];
        if (memory.matched) account.recall(memory.missed);
    }
    return account;
}

void IslandGroup::choose_effort(const World& world, Member& member, bool swept) {
    member.disputed = member.settling = 0;
    member.stirred = false;
    for (std::uint32_t k = member.first_point; k < member.last_point; ++k)
        member.settling = std::max(member.settling, world.contacts.memory[contacts_[k]].settling);
    member.overlap = member.overlap_before = 0;
    member.is_deep = swept;
    member.splits = member.opens = false;
    member.effort = swept ? IslandEffort::swept : IslandEffort::full;
    if (!member.may_be_disputed) return;
    for (std::uint32_t k = member.first_point; k < member.last_point; ++k) {
        const ContactMemory& memory = world.contacts.memory[contacts_[k]];
        member.overlap += std::max(0.0, -world.contacts.found[contacts_[k]].gap);
        if (!memory.matched) continue;
        member.disputed = std::max(member.disputed, memory.disputed);
        member.overlap_before = std::max(member.overlap_before, double(memory.disputed_overlap));
    }
    const bool gives_way = member.overlap < kGivesWay * member.overlap_before;
    const bool begins =
        swept
            ? member.disputed == 0 || member.flies || (ends_sweeping(member.disputed) && gives_way)
            : effort_of(member.disputed) == IslandEffort::light && !is_shallow(world, member);
    if (begins) begin_dispute(member);
    member.effort = effort_of(member.disputed);
    member.splits = member.effort == IslandEffort::swept && !member.flies;
    member.opens = member.moves && member.splits && !is_shallow(world, member);
}

void IslandGroup::begin_dispute(Member& member) {
    member.disputed = kDisputed;
    member.overlap_before = member.overlap;
}

void IslandGroup::add_point(const World& world, std::uint32_t contact, std::uint32_t a,
                            std::uint32_t b) {
    const Vector3d n = to_eigen(world.contacts.found[contact].normal), x = tangent_of<double>(n);
    contacts_.push_back(contact);
    IslandPoint& p = points_.emplace_back();
    locked_.push_back(0), opening_.push_back(0), parting_.push_back(0);
    p.a = a, p.b = b;
    p.frame << n, x, n.cross(x);
    p.length = 1;
    p.impulse.setZero();
}

/// The impulses that the contacts remember of the step before. Sweeps cannot take back what a press
/// left in others.
void IslandGroup::take_memory(const World& world) {
    if (!world.settings.warm_start) return;
    for (std::size_t i = 0; i < count_; ++i) {
        const Member& m = members_[i];
        for (std::uint32_t k = m.first_point; k < m.last_point; ++k) {
            const ContactMemory& memory = world.contacts.memory[contacts_[k]];
            IslandPoint& p = points_[k];
            if (!memory.matched || (m.effort == IslandEffort::swept && !memory.exact)) continue;
            p.impulse.head<3>() = p.frame.transpose() * memory.friction_impulse;
            p.impulse[0] = memory.normal_impulse;
            if (p.cone.turns())
                p.impulse.tail<3>() = p.frame.transpose() * memory.rolling_impulse / p.length;
        }
    }
}

/// Inertia and arms at the poses now, and what follows from them.
void IslandGroup::take_geometry(const World& world) {
    const Bodies& all = world.bodies;
    for (IslandBody& body : bodies_) {
        body.mass = all.mass[body.body];
        body.inverse_inertia = all.world_inverse_inertia[body.body];
        body.inertia =
            rotated_diagonal(all.orientation[body.body].toRotationMatrix(), all.inertia[body.body]);
    }
    for (std::size_t k = 0; k < points_.size(); ++k) take_geometry(world, points_[k], contacts_[k]);
}

void IslandGroup::take_geometry(const World& world, IslandPoint& p, std::uint32_t contact) const {
    const Contact& c = world.contacts.found[contact];
    const SurfacePair& surface = world.surface_pair(c.a, c.b);
    const Vector3d n = p.frame.col(0), at = world.contacts.point[contact];
    p.arm_a = at - world.bodies.position[c.a];
    p.arm_b = at - world.bodies.position[c.b];
    const InverseMass<double> of_a = inverse_mass(world.bodies, c.a),
                              of_b = inverse_mass(world.bodies, c.b);
    p.mass = 1 / largest(point_response(of_a, p.arm_a) + point_response(of_b, p.arm_b));
    p.mass_normal = 1 / (response(of_a, p.arm_a, n, n) + response(of_b, p.arm_b, n, n));
    const double before = p.length;
    p.length = std::sqrt(1 / (largest(of_a.inertia + of_b.inertia) * p.mass));
    p.impulse.tail<3>() *= before / p.length;  // the torque stays
    p.cone = {};
    if (has_friction_) p.cone.friction = surface.friction;
    if (!resists_rolling_) return;
    p.cone.spinning = surface.spinning_friction / p.length;
    p.cone.rolling = surface.rolling_friction / p.length;
}

// ---- once a substep

std::uint32_t IslandGroup::begin(const World& world, double h, const PushOut& push_out) {
    if (!is_fresh_) take_geometry(world);
    is_fresh_ = false;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const std::uint32_t body = bodies_[i].body;
        start_[i] << world.bodies.velocity[body], world.bodies.angular_velocity[body];
        velocity_[i] = start_[i];
        shift_[i].setZero();
    }
    h_ = h;
    ties_.begin();
    for (std::size_t i = 0; i < count_; ++i) {
        const Member& m = members_[i];
        ties_.begin(world, substep_time(world, h), members_[i].ties);
        if (!m.is_meshed && !m.is_driven)
            ties_.stiffen(world, h, m.ties,
                          std::span(bodies_).subspan(m.first_body, m.last_body - m.first_body));
    }
    if (!world.settings.warm_start) forget_impulses();
    apply_impulses();
    std::uint32_t clamped = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        Member& member = members_[i];
        member.was_open = open_at_start(member) > kAjar * world.settings.joint_tolerance;
        member.was_torn = ties_.open_at_start(member.ties) > torn_from(world, member, h);
        ties_.ask(member.ties, velocities_of(member));
        member.speed = speed_of(world, member, h, push_out);
        const double most = strongest(world, member, h);
        const double thrust = thrust_of(world, member, h);
        for (IslandRow& row : ties_.rows(member.ties)) {
            row.most = kLever * most * row.length;
            row.is_rigid = row.softness == 0;
            if (row.is_rigid && thrust > 0)
                row.softness =
                    world.settings.joint_tolerance / (h * thrust * row.length * row.length);
        }
        member.parts = member.bounces = false;
        for (std::uint32_t k = member.first_point; k < member.last_point; ++k) {
            points_[k].cone.most = most;
            clamped += ask(world, member, k, h, push_out);
            member.parts |= member.gains_nothing && parting_[k] > 0;
            member.bounces |= restitution_velocity_of(world.contacts, contacts_[k]) > 0;
        }
    }
    return clamped;
}

/// How fast contacts approach or part, and joints open, if nothing pushes, or how fast an overlap
/// shall go [m/s].
double IslandGroup::speed_of(const World& world, const Member& member, double h,
                             const PushOut& push_out) {
    const ContactTable& c = world.contacts;
    double speed = 0;
    for (std::uint32_t k = member.first_point; k < member.last_point; ++k) {
        const Contact& contact = c.found[contacts_[k]];
        const double overlap = std::min(c.gap[contacts_[k]], 0.0);
        const double normal = to_eigen(contact.normal).dot(relative_velocity(world, contacts_[k]));
        speed = std::max({speed, std::abs(normal), closing_velocity(overlap, h, push_out)});
    }
    const std::span<const Vector6d> start = starts_of(member);
    for (const IslandRow& row : ties_.rows(member.ties)) {
        IslandRow bare = row;
        bare.impulse = 0, bare.most = std::numeric_limits<double>::infinity();
        const double asked = answer_of(bare, rate_of(row, start), row.mass).impulse;
        speed = std::max(speed, row.length * std::abs(asked) / row.mass);
    }
    return speed;
}

/// The most that its bodies' weight and speed give an island in a substep [N s].
double IslandGroup::thrust_of(const World& world, const Member& member, double h) const {
    double thrust = 0;
    for (std::uint32_t i = member.first_body; i < member.last_body; ++i)
        thrust += bodies_[i].mass * std::max(h * pull_on(world, bodies_[i].body), member.speed);
    return thrust;
}

/// More than any contact bears that can be satisfied [N s]; motors push as hard as they can.
double IslandGroup::strongest(const World& world, const Member& member, double h) {
    double mass = 0, weight = 0, driven = 0;
    for (std::uint32_t i = member.first_body; i < member.last_body; ++i) {
        mass += bodies_[i].mass;
        weight += bodies_[i].mass * pull_on(world, bodies_[i].body);
    }
    for (const IslandRow& row : ties_.rows(member.ties))
        if (row.drive) driven += greatest_impulse(row) / row.length;
    return kThrust * weight * h + kBlow * mass * member.speed + kBlow * driven;
}

/// What the substep asks of a point, and whether that leaves some of its overlap; velocities of
/// creep are asked for as 0.
bool IslandGroup::ask(const World& world, const Member& member, std::size_t k, double h,
                      const PushOut& push_out) {
    const ContactTable& c = world.contacts;
    const Settings& s = world.settings;
    const std::uint32_t contact = contacts_[k];
    IslandPoint& p = points_[k];
    const double least = kCreep * member.speed;
    const bool stays = member.splits || member.effort == IslandEffort::light;

    const double bounce = restitution_velocity_of(c, contact);
    const double gap = gap_to_solve_for(world, contact, push_out.most);
    double normal = closing_velocity(gap, h, push_out);
    const ContactMemory& before = c.memory[contact];
    locked_[k] = choice_.is_stuck(before, -c.found[contact].gap) &&
                 (before.jammed || p.impulse[0] > kLocked * p.cone.most);
    if (std::abs(normal) < least || (locked_[k] && normal > 0)) normal = 0;
    opening_[k] = member.splits && bounce == 0 ? std::max(0.0, normal) : 0;
    if (stays && normal > 0) normal = 0;
    if (bounce > 0) normal = bounce;

    Vector3d across = Vector3d::Zero();
    if (!c.anchor_slip.empty() && !stays) {
        across = p.frame.transpose() * (-s.anchor_stiffness / h * c.anchor_slip[contact]);
        across[0] = 0;
        if (across.cwiseAbs().maxCoeff() < least) across.setZero();
    }

    // what is immovable may move by itself, and a rim runs on
    Vector3d moving = Vector3d::Zero(), turning = Vector3d::Zero();
    if (!c.bend.empty()) moving = c.bend[contact];
    const auto add = [&](std::uint32_t body, const Vector3d& arm, double sign) {
        moving += sign * velocity_at(world.bodies, body, arm);
        turning += sign * world.bodies.angular_velocity[body];
    };
    if (p.a == kImmovable) add(c.found[contact].a, p.arm_a, 1);
    if (p.b == kImmovable) add(c.found[contact].b, p.arm_b, -1);

    parting_[k] = bounce > ContactTable::kParting ? bounce : 0;
    if (member.flies && bounce == 0)
        parting_[k] =
            std::max(0.0, normal - kDrift * smaller_radius(world.bodies, c.found[contact]));

    p.wanted.setZero();
    p.wanted.head<3>() = across - p.frame.transpose() * moving;
    p.wanted[0] += normal;
    if (p.cone.turns()) p.wanted.tail<3>() = -p.length * (p.frame.transpose() * turning);
    return is_clamped(c.gap[contact], gap, push_out.most);
}

/// From how far open on a joint is torn: farther than it may close in a substep. A driven island
/// that was iterated, as large ones are while they move fast, may be open by up to its smallest
/// body's radius [m].
double IslandGroup::torn_from(const World& world, const Member& m, double h) const {
    if (!m.is_driven || m.last_body - m.first_body <= kVerySmall)
        return h * world.settings.recovery_speed;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = m.first_body; i < m.last_body; ++i)
        least = std::min(least, world.bodies.bounding_radius[bodies_[i].body]);
    return least;
}

/// By how much the worst tie is open that is to be closed [m], [rad].
double IslandGroup::open_at_start(const Member& member) {
    if (!member.is_meshed) return 0;
    const std::span<Vector6d> rest(force_.data() + member.first_body, starts_of(member).size());
    std::fill(rest.begin(), rest.end(), Vector6d::Zero());
    return ties_.ask_to_close(member.ties, rest);
}

void IslandGroup::forget_impulses() {
    for (IslandPoint& p : points_) p.impulse.setZero();
    for (IslandRow& row : ties_.rows()) row.impulse = 0;
}

/// Impulses of the substep before take the push of gravity back where nothing changed. What joints
/// bore when a robot landed would whirl its links about, once its feet are off the ground, farther
/// than what joints are asked for at the end of the substep means anything: such are no start,
/// unless bodies turn more than half as fast without.
void IslandGroup::forget_what_whirls(const Member& m) {
    if (m.ties.empty() || m.is_meshed || m.is_driven) return;
    const Island island = island_of(m);
    const std::span<const Vector6d> start = starts_of(m);
    const auto rate = [](const Vector6d& v) { return v.tail<3>().norm(); };
    for (std::size_t i = 0; i < start.size(); ++i) {
        const double now = rate(island.velocity[i]);
        if (h_ * now <= kTrustedTurn || now <= 2 * rate(start[i])) continue;
        IslandSolver::forget(island);
        std::copy(start.begin(), start.end(), island.velocity.begin());
        return;
    }
}

/// The impulses that the substep starts from, to the velocities.
void IslandGroup::apply_impulses() {
    std::fill(force_.begin(), force_.end(), Vector6d::Zero());
    for (std::size_t i = 0; i < count_; ++i) {
        const Member& m = members_[i];
        const std::span<Vector6d> sums(force_.data() + m.first_body, m.last_body - m.first_body);
        for (std::uint32_t k = m.first_point; k < m.last_point; ++k)
            add_impulse(points_[k], points_[k].impulse, sums);
        for (const IslandRow& row : ties_.rows(m.ties)) add_impulse(row, row.impulse, sums);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        velocity_[i] += response(bodies_[i], force_[i]);
    for (std::size_t i = 0; i < count_; ++i) forget_what_whirls(members_[i]);
}

Island IslandGroup::island_of(const Member& m) {
    const std::size_t bodies = m.last_body - m.first_body, points = m.last_point - m.first_point;
    return {{bodies_.data() + m.first_body, bodies},
            {velocity_.data() + m.first_body, bodies},
            {points_.data() + m.first_point, points},
            ties_.rows(m.ties)};
}

std::span<const Vector6d> IslandGroup::starts_of(const Member& m) const {
    return {start_.data() + m.first_body, m.last_body - m.first_body};
}

std::span<const Vector6d> IslandGroup::velocities_of(const Member& m) const {
    return {velocity_.data() + m.first_body, m.last_body - m.first_body};
}

void IslandGroup::solve(const World& world, StepReport& report) {
    workers_.run([&](std::uint32_t worker) {
        for (std::size_t i = worker; i < count_; i += workers_.count()) {
            Member& m = members_[i];
            solve(world, solvers_[worker], m);
            const bool fails = m.given_up || m.effort == IslandEffort::swept;
            if (m.is_meshed && m.was_torn && fails) draw_together(solvers_[worker], m);
        }
    });
    report.costly_islands = costly_;
    for (std::size_t i = 0; i < count_; ++i) {
        const Member& member = members_[i];
        report.unsolved_islands += !member.solved;
        if (member.open > world.settings.joint_tolerance) note_open(report, member);
    }
}

void IslandGroup::note_open(StepReport& report, const Member& member) const {
    const Tie& tie = ties_.first_of(member.ties);
    if (tie.kind == TieKind::joint) report.open_trees.push_back({tie.index, member.open});
}

/// Whether kinematic bodies pull its ties apart: what these give is what their softness makes of an
/// impulse without bounds. As the start of the next substep it would throw the bodies about.
bool IslandGroup::is_pulled_apart(const World& world, const Member& m) {
    if (!m.is_driven) return false;
    const double ajar = kAjar * world.settings.joint_tolerance;
    if (!std::isfinite(m.open)) return true;
    const std::span<const IslandRow> rows = ties_.rows(m.ties);
    return std::any_of(rows.begin(), rows.end(), [&](const IslandRow& row) {
        return row.is_rigid && h_ * row.softness * std::abs(row.impulse) > ajar;
    });
}

/// Sweeps that begin with nothing pull no harder than what moves asks for.
void IslandGroup::give_way(IslandSolver& solver, Member& m) {
    const Island island = island_of(m);
    const std::span<const Vector6d> start = starts_of(m);
    std::copy(start.begin(), start.end(), island.velocity.begin());
    const auto ask = [&] { m.open = ties_.ask(m.ties, island.velocity); };
    solver.sweep_anew(island, ask);
    ask();
}

/// Whether sweeps gave what kinematic bodies drive much more energy than it had, or has at their
/// speed.
bool IslandGroup::is_flung(const Member& m) {
    if (!m.is_driven || m.ties.empty()) return false;
    const Island island = island_of(m);
    double mass = 0;
    for (const IslandBody& b : island.bodies) mass += b.mass;
    const double speed = ties_.scripted_speed(m.ties);
    const double most =
        kFlung * (kinetic_energy(island.bodies, starts_of(m)) + 0.5 * mass * speed * speed);
    return !(kinetic_energy(island.bodies, island.velocity) <= most);
}

/// What is pulled apart moves as if its ties had been made as they are, between bodies that stand
/// still: neither old errors nor what pulls get impulses or velocities.
void IslandGroup::hold_torn(IslandSolver& solver, Member& m) {
    const Island island = island_of(m);
    const std::span<const Vector6d> start = starts_of(m);
    const auto begin = [&] { std::copy(start.begin(), start.end(), island.velocity.begin()); };
    const auto ask = [&] { ties_.ask(m.ties, island.velocity, OldErrors::kept); };
    begin();
    solver.forget(island);  // of contacts, too, which held against what pulled
    ask();
    m.solved = solve_system(solver, m, m.effort);
    if (!m.solved) {
        begin();
        solver.sweep_anew(island, ask);
    }
    draw_together(solver, m);
}

/// Shifts the bodies so that what is open shares itself out and closes, unless that makes it worse:
/// rows that contradict each other in turning can lead anywhere.
void IslandGroup::draw_together(IslandSolver& solver, Member& m) {
    const Island island = island_of(m);
    const std::span<Vector6d> shift(shift_.data() + m.first_body, island.bodies.size());
    const double most = ties_.open_at_start(m.ties) + h_ * ties_.scripted_speed(m.ties);
    solver.close_apart(island, shift, [&] { ties_.ask(m.ties, shift); });
    m.open = ties_.open_at_end(m.ties, shift);
    const bool is_worse = !(m.open <= most);
    for (std::size_t i = 0; i < shift.size(); ++i)
        shift[i] = is_worse ? Vector6d(Vector6d::Zero()) : Vector6d(shift[i] - island.velocity[i]);
}

/// Returns whether it is solved.
bool IslandGroup::solve_system(IslandSolver& solver, Member& m, IslandEffort effort) {
    const IslandReport report = solver.solve(island_of(m), m.system, m.speed, effort,
                                             m.settling > 0 || m.stirred, m.account.left());
    m.stirred |= report.stirred;
    m.account.take(report.factorisations * m.system.block_products());
    return report.solved;
}

/// What has taken too much in vain is swept from now on.
void IslandGroup::give_up_if_in_vain(Member& m) {
    if (m.opens || !m.account.end_substep(m.solved)) return;
    m.splits = false;
    m.effort = IslandEffort::swept;
}

/// Ties are not linear: what a solution leaves open of them is asked for again.
void IslandGroup::solve(const World& world, IslandSolver& solver, Member& m) {
    m.account.begin_substep();
    const double tolerance = world.settings.joint_tolerance;
    const Island island = island_of(m);
    const auto gains = [&](double share = 0) {
        return !(kinetic_energy(island.bodies, island.velocity) <=
                 (1 + share) * kinetic_energy(island.bodies, starts_of(m)));
    };
    const auto ask = [&] { m.open = ties_.ask(m.ties, island.velocity); };
    if (m.splits) {
        m.solved = true;
        if (m.is_deep)
            solver.sweep(island);
        else
            m.solved = solve_system(solver, m, IslandEffort::light);
        give_up_if_in_vain(m);
        const std::size_t bodies = m.last_body - m.first_body;
        solver.open_apart(island, {opening_.data() + m.first_point, island.points.size()},
                          {shift_.data() + m.first_body, bodies});
        bound_speed(world, m);
        return;
    }
    if (m.was_torn && m.is_driven) return hold_torn(solver, m);
    if (m.effort == IslandEffort::swept) {
        solver.sweep(island);
        ask();
        m.solved = true;
        if (is_flung(m)) return hold_torn(solver, m);
        if (m.is_meshed && gains()) close_gently(solver, m);
        if (m.may_be_disputed) bound_speed(world, m);
        return;
    }
    const int most = m.is_meshed ? kMostCloses : kCloses;
    bool was_solved = false;  // before the last closing, which changes little
    for (int i = 0; i < most; ++i) {
        const double before = m.open;
        was_solved |= m.solved && i > 0;
        m.solved = solve_system(solver, m, m.effort);
        ask();
        const bool closes = !m.is_meshed && m.open <= 0.5 * before;
        if (!(m.open > tolerance) || (!m.solved && i > 0 && !closes)) break;
        if (i >= kCloses && !(m.open <= kClosing * before)) break;
    }
    if (!m.solved && m.may_be_disputed && m.effort == IslandEffort::full) {
        begin_dispute(m);
        m.effort = IslandEffort::swept;
        m.splits = !m.flies;
    }
    give_up_if_in_vain(m);
    if (m.parts) bound_energy(solver, m), ask();
    if (m.ties.empty()) return;
    if (is_pulled_apart(world, m)) return hold_torn(solver, m);
    if (m.is_meshed && gains(m.was_open ? 0 : kOtherRoot)) return close_gently(solver, m);
    if ((m.solved || (was_solved && !m.is_meshed)) && !(m.open > tolerance)) return;
    const bool ajar = m.open <= kAjar * tolerance;
    m.given_up |= !ajar && m.may_give_up;
    // motors of a tree may give some
    const double given = m.is_meshed || !ajar ? 0 : kOtherRoot;
    if ((m.is_meshed && m.solved && ajar) || !gains(given)) return;
    m.given_up = true;
    m.is_meshed ? close_gently(solver, m) : give_way(solver, m);
}

void IslandGroup::take_changes(Bodies& bodies) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const std::uint32_t body = bodies_[i].body;
        const Vector6d change = velocity_[i] - start_[i];
        bodies.velocity[body] += change.head<3>();
        bodies.turn_change[body] = change.tail<3>();
        bodies.angular_velocity[body] += change.tail<3>();
    }
}

void IslandGroup::open_apart(Bodies& bodies) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (shift_[i].isZero(0)) continue;
        const std::uint32_t body = bodies_[i].body;
        bodies.position[body] += h_ * shift_[i].head<3>();
        bodies.orientation[body] =
            turned(bodies.orientation[body], Vector3d(h_ * shift_[i].tail<3>()));
    }
}

void IslandGroup::add_impulses(ContactSums& sums) const {
    for (std::size_t k = 0; k < points_.size(); ++k) {
        const IslandPoint& p = points_[k];
        sums.add(contacts_[k], p.impulse[0], p.frame.rightCols<2>() * p.impulse.segment<2>(1));
    }
}

void IslandGroup::store_tie_impulses(World& world) const {
    for (std::size_t i = 0; i < count_; ++i)
        ties_.store_impulses(members_[i].ties, velocities_of(members_[i]), world);
}

void IslandGroup::rest_ties(World& world) {
    if (!some_rest_ && count_ == 0) return;
    some_rest_ = false;
    const auto go_on = [this](IslandRest& rest) {
        if (rest.steps > 0) some_rest_ |= --rest.steps > 0;
    };
    for (Joint& joint : world.joints.joints) go_on(joint.island_rest);
    for (Link& link : world.links) go_on(link.island_rest);
    for (std::size_t i = 0; i < count_; ++i)
        ties_.each(members_[i].ties, [&](const Tie& tie) {
            if (tie.kind == TieKind::coupling) return;  // its joints rest
            IslandRest& rest = rest_of(world, tie);
            if (members_[i].is_driven) {  // soon it is another one
                rest = {};
                return;
            }
            if (members_[i].effort == IslandEffort::swept) return;  // nothing is learnt by sweeps
            rest.misses = members_[i].given_up ? std::min(rest.misses + 1, kMostMisses) : 0;
            some_rest_ |= rest.misses > 0;
            // loops may contradict themselves; what a tree cannot do now it can in the next step
            const double shorter = members_[i].is_meshed ? 0 : 2;
            if (rest.misses > 0)
                rest.steps = static_cast<std::uint32_t>(
                    std::ceil(kRest * (std::exp2(rest.misses) - shorter) / world.settings.dt));
        });
}

void IslandGroup::store_impulses(ContactTable& contacts) const {
    for (std::size_t k = 0; k < points_.size(); ++k) {
        const IslandPoint& p = points_[k];
        ContactMemory& memory = contacts.memory[contacts_[k]];
        memory.normal_impulse = p.impulse[0];
        memory.friction_impulse = p.frame.rightCols<2>() * p.impulse.segment<2>(1);
        memory.rolling_impulse = p.length * (p.frame * p.impulse.tail<3>());
        memory.exact = true;
        memory.jammed = locked_[k] != 0;
        memory.gap = contacts.found[contacts_[k]].gap;
        memory.sticks = does_stick(p);
    }
    for (std::size_t i = 0; i < count_; ++i) {
        const Member& m = members_[i];
        const std::uint8_t settling = m.stirred ? kSettlingSteps : m.settling - (m.settling > 0);
        const bool in_vain = m.account.is_given_up();
        const std::uint8_t left =
            m.may_be_disputed && !in_vain ? disputed_after(m.disputed, m.solved) : 0;
        const std::uint8_t missed = m.account.missed();
        const bool moved = m.moves && (in_vain || (m.moved_on && (m.opens || !m.solved)));
        for (std::uint32_t k = m.first_point; k < m.last_point; ++k) {
            contacts.memory[contacts_[k]].disputed = left;
            contacts.memory[contacts_[k]].settling = settling;
            contacts.memory[contacts_[k]].missed = missed;
            contacts.memory[contacts_[k]].moved = moved;
            contacts.memory[contacts_[k]].disputed_overlap = static_cast<float>(m.overlap_before);
        }
    }
    for (const std::uint32_t contact : choice_.jammed()) contacts.memory[contact].jammed = true;
    for (const BodyPair& pair : set_aside_)
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            contacts.memory[k].missed = kTriesAgain;
}

}  // namespace plumb
