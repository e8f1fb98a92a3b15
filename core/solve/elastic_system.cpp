// SPDX-License-Identifier: MIT
#include "solve/elastic_system.h"

#include "math/bracket.h"
#include "solve/contact_stiffness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumb {
namespace {

/// The end is reached where a step changes velocities by no more than this share of what gravity
/// does in a substep, or of the greatest velocity, or of the size of the whole in a substep: less
/// is rounding.
constexpr double kEnoughOfGravity = 1e-4, kEnoughOfSpeed = 1e-4, kRounding = 1e-12;
/// Or where all that it changes has no more than the square of this share of the energy of motion:
/// a fold that is about to buckle goes on for long, and moves hardly anything.
constexpr double kEnoughOfMotion = 1e-4;

/// Factors are kept as long as so many steps with them leave no more than this share to do.
constexpr int kLook = 5;
constexpr double kQuick = 0.4;

/// Minima of a substep, each with the contacts' impulses of the one before: shared among its calls,
/// but no fewer than the least in each.
constexpr std::uint32_t kRounds = 10, kLeastRounds = 2;
/// They have found them where those would change velocities by no more than this times as much as
/// is enough otherwise.
constexpr double kEnoughOfContacts = 10;
/// Until then, as far as this share of what they changed in the round before is near enough to a
/// minimum, but no more than kRoughest times as much as otherwise, and kFirstRound times at first.
constexpr double kShareOfContacts = 0.1, kFirstRound = 10, kRoughest = 100;

/// Ties are asked to close what is open as long as each round asks for no more than this share of
/// what the one before did.
constexpr double kClosing = 0.8;

/// A call that has gained more than this share of the energy before is not taken; nor one in which
/// points that others move at v gave all that hangs on them more than this times m v².
constexpr double kGain = 0.1, kPulled = 2;

/// Steps to a minimum: a substep makes as many calls as position iterations.
constexpr int kSteps = 20;

/// Steps with new factors are taken whole where each finds no more than this share of what the one
/// before had to do.
constexpr double kGood = 0.9;

/// What was foreseen from earlier steps is not taken where this times as much is left at its end.
constexpr double kTooMuch = 2;

/// Kept factors that lead no farther than this share of the way are of contacts and joints that
/// were elsewhere.
constexpr double kShort = 0.1;

/// A line is searched until the slope is this share of that at its start.
constexpr double kFlat = 0.2;
constexpr int kCuts = 6;

}  // namespace

ElasticSystem::ElasticSystem(const World& world, const Plan& plan)
    : parts_(elastic_parts(world, plan)), factors_(world, parts_) {
    const std::uint32_t calls = std::max(1u, world.settings.position_iterations);
    rounds_ = std::max(kLeastRounds, kRounds / calls);
    h_ = world.settings.dt / world.settings.substeps;
    for (auto* column : {&start_, &x_, &before_step_, &own_, &elastic_})
        column->assign(parts_.particles(), Vector3d::Zero());
}

void ElasticSystem::load(const World& world, std::vector<BodyPair>& pairs) {
    if (parts_.may_have_bodies)
        parts_.contacts.load(world, parts_.first_body_row(), pairs, parts_.ties);
    size_rows();
    factors_.begin_step(world, parts_, h_);
}

void ElasticSystem::load_pieces(const FreePieces& pieces) {
    match_.load(parts_.contacts, parts_.ties, pieces);
}

void ElasticSystem::store(World& world) {
    factors_.store(world);
    parts_.contacts.store(world);
}

void ElasticSystem::store_ties(World& world) {
    if (parts_.ties.empty()) return;
    parts_.gather(v_, of_bodies_);
    parts_.ties.store(of_bodies_, world);
}

/// Memory for as many attached rows as there may be.
void ElasticSystem::size_rows() {
    const std::size_t most = parts_.most_rows();
    for (auto* rows : {&v_, &target_, &best_, &begin_, &force_, &direction_, &way_, &before_}) {
        rows->reserve(most);
        rows->assign(parts_.rows(), Vector3d::Zero());
    }
    earlier_.reserve(most);
}

void ElasticSystem::begin(const World& world, double h, double stiffness, double recovery) {
    h_ = h;
    const Particles& p = world.particles;
    double fastest = 0, furthest = 0, motion = 0;
    Vector3d momentum = Vector3d::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        momentum += parts_.mass[i] * p.velocity[i], mass += parts_.mass[i];
    const Vector3d mean = mass > 0 ? Vector3d(momentum / mass) : momentum;
    for (std::size_t i = 0; i < p.size(); ++i) {
        start_[i] = p.position[i] - p.position[0];
        own_[i].setZero();
        const double square = (p.velocity[i] - mean).squaredNorm();
        fastest = std::max(fastest, square), motion += parts_.mass[i] * square;
        furthest = std::max(furthest, start_[i].squaredNorm());
    }
    enough_ = kEnoughOfGravity * world.settings.gravity.norm() * h +
              kEnoughOfSpeed * std::sqrt(fastest) + kRounding * std::sqrt(furthest) / h;
    enough_size_ = kEnoughOfMotion * std::sqrt(motion);
    near_ = parts_.are_alone() ? 1 : kFirstRound;
    for (const auto& elements : parts_.elements) elements->begin(start_, h);
    parts_.contacts.begin(world, h, stiffness, recovery);
    parts_.ties.begin(world, h);
    if (!parts_.are_alone()) {
        x_ = start_;
        find_elastic_forces();
        elastic_start_ = elastic_energy_;
    }
    fall_ = h * world.settings.gravity;
    is_first_ = true, is_settled_ = false;
}

/// At the places now.
void ElasticSystem::find_elastic_forces() {
    std::fill(elastic_.begin(), elastic_.end(), Vector3d::Zero());
    elastic_energy_ = 0;
    for (const auto& elements : parts_.elements)
        elastic_energy_ += elements->add_forces(x_, elastic_);
    parts_.balloons.add_forces(x_, elastic_, elastic_energy_);
}

/// What pulls at each row at the velocities now, which is 0 at the minimum; and the energy.
void ElasticSystem::find_forces() {
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = start_[i] + h_ * v_[i];
    find_elastic_forces();
    sum_forces();
}

/// The same, where the places are those of the last elastic forces.
void ElasticSystem::sum_forces() {
    energy_ = elastic_energy_;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (parts_.mass[i] == 0) continue;
        const Vector3d missing = target_[i] - v_[i];
        force_[i] = parts_.mass[i] * missing + h_ * elastic_[i];
        energy_ += 0.5 * parts_.mass[i] * missing.squaredNorm();
    }
    energy_ += parts_.contacts.add_forces(target_, v_, force_);
    if (!parts_.ties.empty()) {
        parts_.gather(v_, of_bodies_);
        on_bodies_.assign(of_bodies_.size(), Vector6d::Zero());
        energy_ += parts_.ties.add_forces(of_bodies_, on_bodies_);
        parts_.add_to_rows(on_bodies_, force_);
    }
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (parts_.mass[i] == 0) force_[i].setZero();
}

/// Where the factors lead from here.
ElasticSystem::Move ElasticSystem::find_direction() {
    direction_ = force_;
    factors_.solve(direction_);
    double greatest = 0;
    for (std::size_t i = 0; i < x_.size(); ++i)
        greatest = std::max(greatest, direction_[i].squaredNorm());
    for (const ElasticContacts::Body& body : parts_.contacts.bodies())
        greatest = std::max(greatest, direction_[body.row].squaredNorm());
    return {std::sqrt(greatest), std::sqrt(product(direction_, direction_))};
}

/// xᵀ M y of velocities [J].
double ElasticSystem::product(const std::vector<Vector3d>& x,
                              const std::vector<Vector3d>& y) const {
    double sum = 0;
    for (std::size_t i = 0; i < parts_.mass.size(); ++i) sum += parts_.mass[i] * x[i].dot(y[i]);
    for (const ElasticContacts::Body& body : parts_.contacts.bodies())
        sum += body.mass * x[body.row].dot(y[body.row]) +
               x[body.row + 1].dot(body.inertia * y[body.row + 1]);
    return sum;
}

/// Along `way_`.
void ElasticSystem::advance(double step) {
    for (std::size_t i = 0; i < v_.size(); ++i) v_[i] += step * way_[i];
}

/// How fast the energy rises along `way_`.
double ElasticSystem::slope() const {
    double sum = 0;
    for (std::size_t i = 0; i < way_.size(); ++i) sum -= way_[i].dot(force_[i]);
    return sum;
}

/// Share of `way_` where the energy is least, about: of the contacts as it is, of all else as the
/// factors have it. For the one has kinks, and across a fold the other is no guide.
double ElasticSystem::share_of_way() {
    if (parts_.are_alone()) return 1;
    const auto push_along = [this](double share) {
        return parts_.contacts.push_along(share) + parts_.ties.push_along(share);
    };
    parts_.contacts.begin_line(way_);
    parts_.gather(way_, of_bodies_);
    parts_.ties.begin_line(of_bodies_);
    const double fall = -slope(), of_contacts = push_along(0);
    const double bend =
        std::max(0.0, fall - stiffness_along(factors_.made_of(), parts_.first_body_row(), way_));
    const auto rise = [&](double share) {
        return of_contacts - fall + share * bend - push_along(share);
    };
    Bracket line{0, 1, -fall, rise(1)};
    if (!(fall > 0) || line.at_high <= kFlat * fall) return 1;
    for (int i = 0; i < kCuts; ++i) {
        const double share = line.guess(0.1), here = rise(share);
        if (std::abs(here) <= kFlat * fall) return share;
        line.narrow(share, here);
    }
    return line.low > 0 ? line.low : line.high;
}

/// From the end of a whole step to where the energy along it is least, about, which makes `way_`
/// that much shorter.
void ElasticSystem::search_line() {
    const double at_end = slope();
    advance(-1);
    find_forces();
    Bracket line{0, 1, slope(), at_end};
    const double enough = kFlat * std::abs(line.at_low);
    double at = 0;
    for (int i = 0; i < kCuts; ++i) {
        const double step = line.guess(0.05);
        advance(step - at);
        at = step;
        find_forces();
        const double here = slope();
        if (std::abs(here) <= enough) break;
        line.narrow(step, here);
    }
    for (Vector3d& way : way_) way *= at;
}

/// From velocities whose forces are known: Newton's method, in which factors are kept while they
/// lead on, and Anderson's acceleration makes up for what their stiffness leaves out. Whether they
/// do is seen from what they find left to do at the end of a step (the natural test of Deuflhard
/// 2011, §3.3): a test by energy would stop at every fold, for what moves across a stiff sheet
/// stretches it in second order, and the next step takes that back. Where the end is not reached,
/// the least energy of all steps stands; returns whether it was.
bool ElasticSystem::descend() {
    const auto dot = [this](const auto& x, const auto& y) { return product(x, y); };
    before_step_ = x_;
    keep_best();
    earlier_.clear(v_.size());
    Move move;
    bool known = false;
    int steps = 0;  // with these factors
    // how far was left to go, with these factors and with new ones
    double at_look = 0, at_new = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kSteps; ++i) {
        const bool are_new = !factors_.exist();
        if (are_new) {
            if (!factors_.make(parts_, x_, before_step_, h_)) break;
            steps = 0;
            earlier_.clear(v_.size());
        }
        if (are_new || !known) move = find_direction();
        if (!std::isfinite(move.size)) {
            factors_.drop();
            break;
        }
        if (steps == 0) at_look = move.size;
        const bool goes_round = are_new && !(move.size < kGood * at_new);
        if (are_new) at_new = move.size;
        const bool is_foreseen = !earlier_.empty();
        earlier_.find(direction_, way_, dot);
        std::swap(before_, direction_);
        before_step_ = x_;
        const double share = share_of_way();
        if (share < kShort && !are_new && steps == 0) {
            factors_.drop();
            known = false;
            std::swap(before_, direction_);
            continue;
        }
        if (share < 1)
            for (Vector3d& way : way_) way *= share;
        advance(1);
        const bool is_end = move.greatest <= enough_ || move.size <= enough_size_;
        if (is_end) near_ = 1;
        if (is_end || move.greatest <= near_ * enough_ || move.size <= near_ * enough_size_)
            return true;
        find_forces();
        if (goes_round && slope() > 0) search_line();
        const Move next = find_direction();
        if (is_foreseen && !(next.size < kTooMuch * move.size)) {
            advance(-1);
            find_forces();
            before_step_ = x_;
            factors_.drop();
            continue;
        }
        if (energy_ < least_) keep_best();
        if (!is_foreseen && !(next.size < move.size)) {
            factors_.drop();
            continue;
        }
        earlier_.add(way_, before_, direction_, dot);
        if (++steps % kLook == 0) {
            if (!(next.size < kQuick * at_look)) factors_.drop();
            at_look = next.size;
        }
        known = true;
        move = next;
    }
    v_ = best_;
    return false;
}

void ElasticSystem::keep_best() { best_ = v_, least_ = energy_; }

/// By how much that changes what a row of ties is asked for [m/s].
double ElasticSystem::ask_ties() {
    if (parts_.ties.empty()) return 0;
    parts_.gather(v_, of_bodies_);
    return parts_.ties.ask(of_bodies_);
}

/// Minima, each with the contacts' impulses of the one before, until they change it no more.
void ElasticSystem::go_rounds() {
    is_settled_ = false;
    double asked = std::numeric_limits<double>::infinity();
    bool closes = true;
    ask_ties();
    find_forces();
    for (std::uint32_t round = 0; round < rounds_ && !is_settled_; ++round) {
        if (round > 0) sum_forces();
        const bool is_there = descend();
        if (parts_.are_alone()) {
            is_settled_ = is_there;
            return;
        }
        find_forces();
        // short of the minimum, forces of contacts are not near those that hold anything up
        if (!is_there) continue;
        double changed = std::max(parts_.contacts.take_forces(), parts_.ties.take_forces());
        if (closes) {
            const double before = std::exchange(asked, ask_ties());
            closes = asked <= kClosing * before;
            changed = std::max(changed, asked);
        }
        is_settled_ = near_ <= 1 && changed <= kEnoughOfContacts * enough_;
        near_ = enough_ > 0 ? std::clamp(kShareOfContacts * changed / enough_, 1.0, kRoughest) : 1;
    }
}

/// Whether anything else has changed velocities since the last call.
bool ElasticSystem::has_moved(const std::vector<Vector3d>& velocity) const {
    double most = 0;
    for (std::size_t i = 0; i < velocity.size(); ++i)
        most = std::max(most, (velocity[i] - v_[i]).squaredNorm());
    for (const ElasticContacts::Body& body : parts_.contacts.bodies())
        most = std::max({most, (body.v.v - v_[body.row]).squaredNorm(),
                         (body.size * (body.v.w - v_[body.row + 1])).squaredNorm()});
    return most > enough_ * enough_;
}

/// Contacts and implicit steps only take energy, but for what contacts give by themselves and what
/// points that are moved by others pull along.
bool ElasticSystem::gains_energy() const {
    // what hangs on a point that is moved may overtake it at twice its speed
    const double tied = 2 * parts_.ties.scripted_speed();
    double mass = 0, pull = tied * tied;
    for (std::size_t i = 0; i < parts_.mass.size(); ++i) {
        mass += parts_.mass[i];
        if (parts_.mass[i] == 0) pull = std::max(pull, target_[i].squaredNorm());
    }
    for (const ElasticContacts::Body& body : parts_.contacts.bodies()) mass += body.mass;
    const double before = 0.5 * product(target_, target_) + elastic_start_;
    const double now = 0.5 * product(v_, v_) + elastic_energy_;
    return now > (1 + kGain) * before + parts_.contacts.driven_energy() +
                     parts_.ties.driven_energy() + kPulled * mass * pull;
}

void ElasticSystem::solve(std::vector<Vector3d>& velocity, const FreePieces& pieces) {
    if (is_settled_ && !has_moved(velocity)) return;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        v_[i] = target_[i] = velocity[i];
        if (parts_.mass[i] > 0) target_[i] -= own_[i] / parts_.mass[i];
    }
    std::fill(v_.begin() + parts_.particles(), v_.end(), Vector3d::Zero());
    parts_.contacts.find_targets(v_, target_, parts_.ties);
    if (is_first_) guess_rest();
    begin_ = v_;
    go_rounds();
    if (!parts_.are_alone() && gains_energy()) {
        // thrown by what held something up before, or by what Newton's method left
        parts_.contacts.forget(), parts_.ties.forget();
        v_ = begin_;
        go_rounds();
        if (gains_energy()) {
            parts_.ties.let_go();
            v_ = begin_;
            go_rounds();
            if (gains_energy()) {
                parts_.contacts.let_go();
                v_ = begin_;
                go_rounds();
            }
        }
    }
    if (!parts_.are_alone())
        match_.match(v_, target_, parts_.mass, start_, pieces, parts_.contacts, parts_.ties);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        own_[i] = parts_.mass[i] * (v_[i] - target_[i]);
        velocity[i] = v_[i];
    }
}

/// Most of what touches is held up by something: it moves on as it did, and does not fall.
void ElasticSystem::guess_rest() {
    is_first_ = false;
    if (parts_.are_alone()) return;
    for (std::size_t i = 0; i < x_.size(); ++i)
        if (parts_.mass[i] > 0) v_[i] -= fall_;
    for (const ElasticContacts::Body& body : parts_.contacts.bodies()) v_[body.row] -= fall_;
}

}  // namespace plumb
