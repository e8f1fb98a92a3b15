// SPDX-License-Identifier: MIT
#include "solve/elastic_system.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// A kept volume resists as if this were the bulk modulus of what fills it [Pa].
constexpr double kFilling = 1e8;

/// The end is reached where a step changes velocities by no more than this share of what gravity
/// does in a substep, or of the greatest velocity, or of the size of the whole in a substep: less
/// is rounding.
constexpr double kEnoughOfGravity = 1e-4, kEnoughOfSpeed = 1e-6, kRounding = 1e-12;

/// Factors are kept as long as each step is at most this share of the one before.
constexpr double kQuick = 0.3;

/// Steps of a call: a substep makes as many calls as position iterations.
constexpr int kSteps = 4;

/// A step of new factors is taken whole where no more than this share is left to do at its end.
constexpr double kGood = 0.7;

/// A line is searched until the slope is this share of that at its start.
constexpr double kFlat = 0.2;
constexpr int kCuts = 6;

}  // namespace

ElasticSystem::ElasticSystem(const World& world)
    : elements_(make_elements(world, world.settings.dt / world.settings.substeps, Formulas())) {
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        mass_.push_back(p.inverse_mass[i] > 0 ? p.mass[i] : 0);
    h_ = world.settings.dt / world.settings.substeps;
    for (auto* column : {&start_, &x_, &v_, &target_, &own_, &elastic_})
        column->assign(p.size(), Vector3d::Zero());
    std::vector<SparseLdlt::Pair> pairs;
    for (const auto& elements : elements_) elements->add_pairs(pairs);
    system_.order(particles(), pairs);
    for (const auto& elements : elements_) elements->find_slots(system_);
    make_balloons(world);
    attach_balloons();
    for (auto* rows : {&force_, &direction_, &way_})
        rows->assign(particles() + system_.more(), Vector3d::Zero());
}

void ElasticSystem::make_balloons(const World& world) {
    for (const Deformable& d : world.deformables) {
        if (d.spec.kind != DeformableKind::balloon) continue;
        const double volume = kept_volume(d.spec);
        balloons_.push_back({&d.spec.triangles, d.first, d.count, volume,
                             d.spec.pressure.value_or(0), d.spec.pressure ? 0 : kFilling / volume,
                             std::vector<Vector3d>(d.count)});
    }
}

/// The pressure that keeps a balloon's volume is an unknown of its own, for it acts on all its
/// particles.
void ElasticSystem::attach_balloons() {
    std::vector<SparseLdlt::Pair> pairs;
    std::uint32_t row = particles();
    for (const Balloon& balloon : balloons_) {
        if (!balloon.keeps_volume()) continue;
        for (std::uint32_t i = 0; i < balloon.count; ++i)
            pairs.emplace_back(balloon.first + i, row);
        ++row;
    }
    system_.attach(row - particles(), pairs);
}

void ElasticSystem::load(const World& world) {
    const Particles& p = world.particles;
    if (p.factored == factored_) return;
    drop_factors();
    if (p.factored.size() != p.size()) return;
    x_ = p.factored;
    for (const auto& elements : elements_) elements->begin(x_, h_);
    factor();
}

void ElasticSystem::store(Particles& particles) const {
    if (particles.factored != factored_) particles.factored = factored_;
}

void ElasticSystem::begin(const World& world, double h) {
    h_ = h;
    const Particles& p = world.particles;
    double fastest = 0, furthest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        start_[i] = p.position[i] - p.position[0];
        own_[i].setZero();
        fastest = std::max(fastest, p.velocity[i].squaredNorm());
        furthest = std::max(furthest, start_[i].squaredNorm());
    }
    enough_ = kEnoughOfGravity * world.settings.gravity.norm() * h +
              kEnoughOfSpeed * std::sqrt(fastest) + kRounding * std::sqrt(furthest) / h;
    for (const auto& elements : elements_) elements->begin(start_, h);
}

/// Volume of a balloon at the places now, and its gradient.
double ElasticSystem::measure(Balloon& balloon) const {
    std::fill(balloon.gradient.begin(), balloon.gradient.end(), Vector3d::Zero());
    const Vector3d& origin = x_[balloon.first];
    return volume_of(
        *balloon.triangles,
        [&](std::uint32_t i) -> Vector3d { return x_[balloon.first + i] - origin; },
        &balloon.gradient);
}

/// What pulls at each row at the velocities now, which is 0 at the minimum; and the energy.
void ElasticSystem::find_forces() {
    for (std::size_t i = 0; i < v_.size(); ++i) x_[i] = start_[i] + h_ * v_[i];
    std::fill(elastic_.begin(), elastic_.end(), Vector3d::Zero());
    energy_ = 0;
    for (const auto& elements : elements_) energy_ += elements->add_forces(x_, elastic_);
    for (Balloon& balloon : balloons_) {
        const double missing = balloon.volume - measure(balloon);
        const double push = balloon.pressure + balloon.stiffness * missing;
        energy_ += 0.5 * (balloon.pressure + push) * missing;
        for (std::uint32_t i = 0; i < balloon.count; ++i)
            elastic_[balloon.first + i] += push * balloon.gradient[i];
    }
    for (std::size_t i = 0; i < v_.size(); ++i) {
        if (mass_[i] == 0) continue;
        const Vector3d missing = target_[i] - v_[i];
        force_[i] = mass_[i] * missing + h_ * elastic_[i];
        energy_ += 0.5 * mass_[i] * missing.squaredNorm();
    }
}

/// Second derivatives at the velocities now, without what would make them indefinite.
void ElasticSystem::assemble() {
    system_.clear();
    for (std::uint32_t i = 0; i < particles(); ++i)
        system_.add(i, (mass_[i] > 0 ? mass_[i] : 1) * Matrix3d::Identity());
    for (const auto& elements : elements_) elements->add_stiffness(x_, h_ * h_, system_);
    assemble_balloons();
}

void ElasticSystem::assemble_balloons() {
    std::size_t pair = 0;
    std::uint32_t row = particles();
    for (Balloon& balloon : balloons_) {
        if (!balloon.keeps_volume()) continue;
        measure(balloon);
        Matrix3d block = Matrix3d::Identity();  // two of three numbers mean nothing
        block(0, 0) = -1 / balloon.stiffness;
        system_.add(row++, block);
        for (std::uint32_t i = 0; i < balloon.count; ++i, ++pair) {
            if (mass_[balloon.first + i] == 0) continue;
            block.setZero();
            block.col(0) = h_ * balloon.gradient[i];
            system_.add_pair(pair, block);
        }
    }
}

bool ElasticSystem::factor() {
    assemble();
    has_factors_ = system_.factor();
    factored_ = x_;
    if (!has_factors_) drop_factors();
    return has_factors_;
}

void ElasticSystem::drop_factors() {
    has_factors_ = false;
    factored_.clear();
}

/// Where the factors lead from here.
ElasticSystem::Move ElasticSystem::find_direction() {
    direction_ = force_;
    system_.solve(direction_);
    double greatest = 0, energy = 0;
    for (std::size_t i = 0; i < v_.size(); ++i) {
        const double square = direction_[i].squaredNorm();
        greatest = std::max(greatest, square), energy += mass_[i] * square;
    }
    return {std::sqrt(greatest), std::sqrt(energy)};
}

/// Along `way_`.
void ElasticSystem::advance(double step) {
    for (std::size_t i = 0; i < v_.size(); ++i) v_[i] += step * way_[i];
}

/// How fast the energy rises along `way_`.
double ElasticSystem::slope() const {
    double sum = 0;
    for (std::size_t i = 0; i < v_.size(); ++i) sum -= way_[i].dot(force_[i]);
    return sum;
}

/// From the end of a whole step to where the energy along it is least, about.
void ElasticSystem::search_line() {
    double low = 0, high = 1, at_high = slope();
    advance(-1);
    find_forces();
    double at_low = slope(), at = 0;
    const double enough = kFlat * std::abs(at_low);
    for (int i = 0; i < kCuts; ++i) {
        const double guess = low - at_low * (high - low) / (at_high - at_low);
        const double inset = 0.05 * (high - low);
        const double step = std::clamp(guess, low + inset, high - inset);
        advance(step - at);
        at = step;
        find_forces();
        const double here = slope();
        if (std::abs(here) <= enough) break;
        if (here > 0)
            high = step, at_high = here;
        else
            low = step, at_low = here;
    }
}

/// Newton's method. A step is good where the same factors find less left to do at its end (the
/// natural test of Deuflhard 2011, §3.3): a test by energy would stop at every fold, for what moves
/// across a stiff sheet stretches it in second order, and the next step takes that back. Where the
/// end is not reached, the least energy of all steps stands.
void ElasticSystem::descend() {
    find_forces();
    best_ = v_, least_ = energy_;
    Move move;
    bool fresh = false, known = false;
    for (int i = 0; i < kSteps; ++i) {
        if (!has_factors_) {
            if (!factor()) break;
            fresh = true, known = false;
        }
        if (!known) move = find_direction();
        if (!std::isfinite(move.size)) {
            drop_factors();
            break;
        }
        std::swap(way_, direction_);
        advance(1);
        if (move.greatest <= enough_) return;
        find_forces();
        Move next = find_direction();
        if (!fresh && !(next.size <= kQuick * move.size)) {
            advance(-1);
            find_forces();
            drop_factors();
            continue;
        }
        if (!(next.size < kGood * move.size) && slope() > 0) {
            search_line();
            next = find_direction();
        }
        if (energy_ < least_) best_ = v_, least_ = energy_;
        known = next.size <= kQuick * move.size;
        if (!known) drop_factors();
        fresh = false;
        move = next;
    }
    v_ = best_;
}

void ElasticSystem::solve(std::vector<Vector3d>& velocity) {
    for (std::size_t i = 0; i < v_.size(); ++i) {
        v_[i] = target_[i] = velocity[i];
        if (mass_[i] > 0) target_[i] -= own_[i] / mass_[i];
    }
    descend();
    for (std::size_t i = 0; i < v_.size(); ++i) {
        own_[i] = mass_[i] * (v_[i] - target_[i]);
        velocity[i] = v_[i];
    }
}

}  // namespace plumb
