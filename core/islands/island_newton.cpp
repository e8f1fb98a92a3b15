// SPDX-License-Identifier: MIT
#include "islands/island_newton.h"

#include "math/bracket.h"
#include "math/matrices.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

/// γ of what a joint takes away: it is never let go, so that no search is needed for it.
constexpr double kJoint = 1e-7;

/// γ of what drives a joint need not be more than this.
constexpr double kGentle = 1e-3;

/// A line is searched until the slope is this share of what it was, in so many steps at most.
constexpr double kFlat = 0.1;
constexpr int kLineSteps = 20;

Matrix6d mass_matrix(const SolvedBody& b) {
    Matrix6d m = Matrix6d::Zero();
    m.diagonal().head<3>().setConstant(b.mass);
    m.bottomRightCorner<3, 3>() = matrix_of(b.inertia);
    return m;
}

/// Between the bounds of what holds an axis [N s], [N m s]: an error must not take it from one to
/// the other.
double span_of(const AxisDrive& drive) {
    double span = std::numeric_limits<double>::infinity();
    for (int i = 0; i < drive.n; ++i) {
        const DriveRow& row = drive.rows[i];
        if (!(row.softness > 0) && row.highest > row.lowest)
            span = std::min(span, row.highest - row.lowest);
    }
    return span;
}

/// How the impulse of a point yields to the velocity there, in the world's frame: force against
/// velocity, force against turning, torque against turning.
struct PointStiffness {
    Matrix3d along, mixed = Matrix3d::Zero(), about = Matrix3d::Zero();

    /// `stiffness` is that of what is inside of its cone; else ∂λ/∂z takes a share of it.
    template <int N>
    PointStiffness(const IslandPoint& p, double stiffness, const ContactVector<N>& z,
                   const ConePoint<N>& at)
        : along(stiffness * Matrix3d::Identity()) {
        const double squared = p.length * p.length;
        if (at.inside()) {
            if (p.cone.turns()) about = stiffness * squared * Matrix3d::Identity();
            return;
        }
        const Eigen::Matrix<double, N, N> d = stiffness * cone_derivative(z, at, p.cone);
        const auto in_world = [&](const auto& block) -> Matrix3d {
            return p.frame * block * p.frame.transpose();
        };
        along = in_world(d.template topLeftCorner<3, 3>());
        if (N == 3 || !p.cone.turns()) return;
        mixed = p.length * in_world(d.template topRightCorner<3, 3>());
        about = squared * in_world(d.template bottomRightCorner<3, 3>());
    }
};

/// The blocks of a pair of bodies, summed over its points: of each [E, −[r]ₓ]ᵀ K [E, −[r]ₓ].
class PairBlocks {
public:
    void begin(const IslandPoint& p) {
        a_ = p.a, b_ = p.b;
        is_empty_ = true;
        along_.setZero();
        upper_a_.setZero(), upper_b_.setZero();
        about_a_.setZero(), about_b_.setZero(), about_both_.setZero();
    }
    bool is_of(const IslandPoint& p) const { return p.a == a_ && p.b == b_; }

    void add(const IslandPoint& p, const PointStiffness& k) {
        is_empty_ = false;
        along_ += k.along;
        const auto upper = [&](const Vector3d& arm) -> Matrix3d {
            return k.mixed - times_skew(k.along, arm);
        };
        const auto about = [&](const Vector3d& left, const Matrix3d& right_upper,
                               const Vector3d& right) -> Matrix3d {
            return k.about + skew_times(left, right_upper) - times_skew(k.mixed.transpose(), right);
        };
        // what is immovable has no block
        if (a_ != kImmovable) {
            const Matrix3d upper_a = upper(p.arm_a);
            upper_a_ += upper_a, about_a_ += about(p.arm_a, upper_a, p.arm_a);
        }
        if (b_ == kImmovable) return;
        const Matrix3d upper_b = upper(p.arm_b);
        upper_b_ += upper_b, about_b_ += about(p.arm_b, upper_b, p.arm_b);
        if (a_ != kImmovable) about_both_ += about(p.arm_a, upper_b, p.arm_b);
    }

    void add_to(IslandSystem& system) const {
        if (is_empty_) return;
        const auto block = [&](const Matrix3d& left, const Matrix3d& right, const Matrix3d& about) {
            Matrix6d m;
            m << along_, right, left.transpose(), about;
            return m;
        };
        if (a_ != kImmovable) system.add(a_, block(upper_a_, upper_a_, about_a_));
        if (b_ != kImmovable) system.add(b_, block(upper_b_, upper_b_, about_b_));
        if (a_ != kImmovable && b_ != kImmovable)
            system.add(a_, b_, -block(upper_a_, upper_b_, about_both_));
    }

private:
    std::uint32_t a_ = kImmovable, b_ = kImmovable;
    bool is_empty_ = true;  // none of the points pushes
    Matrix3d along_, upper_a_, upper_b_, about_a_, about_b_, about_both_;
};

}  // namespace

template <int N>
void IslandNewton<N>::begin(const Island& island, double softness, double error, bool shifts,
                            double creep) {
    island_ = island;
    change_.assign(island.bodies.size(), Vector6d::Zero());
    work_.resize(island.points.size());
    for (std::size_t k = 0; k < work_.size(); ++k) {
        const IslandPoint& p = island.points[k];
        PointWork& w = work_[k];
        w.stiffness = p.mass / softness;
        w.impulse = p.impulse.template head<N>();
        w.cone = p.cone;
        ContactVector<N> lack = p.wanted.template head<N>() - velocity_of<N>(p, island.velocity);
        if (shifts) lack[0] -= slip_shift(w.impulse, lack, creep, p.cone);
        w.z = w.impulse + w.stiffness * lack;
    }
    row_work_.clear();
    for (const TieRow& row : island.rows) {
        const double hardest = row.mass / (row.drive || row.is_one_sided() ? softness : kJoint);
        double gentle = hardest;
        if (row.drive)
            gentle = std::max(span_of(*row.drive) * row.length / error, row.mass / kGentle);
        const RowLaw law(row, std::min(hardest, gentle));
        row_work_.push_back({law, rate_of(row, island.velocity), 0});
    }
}

template <int N>
bool IslandNewton<N>::minimise(IslandSystem& system, double enough, int steps,
                               std::uint32_t& factorisations, std::uint64_t most) {
    for (int i = 0; i < steps && factorisations < most; ++i) {
        const double off = find_downhill();
        if (off <= enough) return true;
        assemble(system);
        ++factorisations;
        if (!system.factor()) return false;
        direction_ = downhill_;
        system.solve(direction_);
        double decrease = 0;
        for (std::size_t b = 0; b < direction_.size(); ++b)
            decrease += direction_[b].dot(downhill_[b]);
        if (!(decrease > 0)) return true;
        momentum_ = inertia_ = 0;
        for (std::size_t b = 0; b < direction_.size(); ++b) {
            const Vector6d along = momentum(island_.bodies[b], direction_[b]);
            momentum_ += change_[b].dot(along), inertia_ += direction_[b].dot(along);
        }
        for (std::size_t k = 0; k < work_.size(); ++k)
            work_[k].direction = velocity_of<N>(island_.points[k], direction_);
        for (std::size_t k = 0; k < row_work_.size(); ++k)
            row_work_[k].direction = rate_of(island_.rows[k], direction_);
        const double step = step_length(decrease);
        for (std::size_t b = 0; b < direction_.size(); ++b) change_[b] += step * direction_[b];
        for (PointWork& w : work_) w.z -= (step * w.stiffness) * w.direction;
        for (RowWork& w : row_work_) w.rate += step * w.direction;
    }
    return false;
}

/// The force that leads downhill, into downhill_; returns the fastest velocity that it would make,
/// by the energy that it would give a body: turning counts by the radius of gyration.
template <int N>
double IslandNewton<N>::find_downhill() {
    downhill_.resize(island_.bodies.size());
    for (std::size_t b = 0; b < downhill_.size(); ++b)
        downhill_[b] = -momentum(island_.bodies[b], change_[b]);
    for (std::size_t k = 0; k < work_.size(); ++k) {
        PointWork& w = work_[k];
        w.at = nearest_on_cone(w.z, w.cone);
        const ContactVector<N> more = w.at.impulse - w.impulse;
        if (!more.isZero(0)) add_impulse(island_.points[k], more, downhill_);
    }
    for (std::size_t k = 0; k < row_work_.size(); ++k) {
        const RowWork& w = row_work_[k];
        const double more = w.answer(w.rate).impulse - w.law.impulse;
        add_impulse(island_.rows[k], more, downhill_);
    }
    double off = 0;
    for (std::size_t b = 0; b < downhill_.size(); ++b) {
        const SolvedBody& body = island_.bodies[b];
        off = std::max(off, downhill_[b].dot(response(body, downhill_[b])) / body.mass);
    }
    return std::sqrt(off);
}

/// Second derivatives, block by block: M, those of the points, and of each row on k onᵀ.
template <int N>
void IslandNewton<N>::assemble(IslandSystem& system) const {
    system.clear();
    for (std::size_t b = 0; b < island_.bodies.size(); ++b)
        system.add(static_cast<std::uint32_t>(b), mass_matrix(island_.bodies[b]));
    PairBlocks blocks;
    for (std::size_t k = 0; k < work_.size(); ++k) {
        const IslandPoint& p = island_.points[k];
        const PointWork& w = work_[k];
        if (k == 0 || !blocks.is_of(p)) blocks.begin(p);
        if (w.at.pushes) blocks.add(p, PointStiffness(p, w.stiffness, w.z, w.at));
        if (k + 1 == work_.size() || !blocks.is_of(island_.points[k + 1])) blocks.add_to(system);
    }
    for (std::size_t k = 0; k < row_work_.size(); ++k) {
        const TieRow& row = island_.rows[k];
        const double slope = row_work_[k].answer(row_work_[k].rate).slope;
        if (slope == 0) continue;
        for (std::uint32_t i = 0; i < row.count; ++i) {
            const RowSide& a = row.side[i];
            const Vector6d answer = slope * a.on;
            for (std::uint32_t j = i; j < row.count; ++j)
                system.add_product(a.body, answer, row.side[j].body, row.side[j].on);
        }
    }
}

/// Derivative of what is minimised along the direction; rises with the step.
template <int N>
double IslandNewton<N>::slope(double step) const {
    double sum = momentum_ + step * inertia_;
    for (const PointWork& w : work_) {
        const ContactVector<N> z = w.z - (step * w.stiffness) * w.direction;
        sum -= (nearest_on_cone(z, w.cone).impulse - w.impulse).dot(w.direction);
    }
    for (const RowWork& w : row_work_)
        sum -= (w.answer(w.rate + step * w.direction).impulse - w.law.impulse) * w.direction;
    return sum;
}

/// The step at which the slope is about 0: 1, or less.
template <int N>
double IslandNewton<N>::step_length(double decrease) const {
    const double enough = kFlat * decrease;
    Bracket line{0, 1, -decrease, slope(1)};
    if (line.at_high <= enough) return 1;
    double step = 1;
    for (int i = 0; i < kLineSteps; ++i) {
        step = line.guess(0.05);
        const double here = slope(step);
        if (std::abs(here) <= enough) break;
        line.narrow(step, here);
    }
    return step;
}

template class IslandNewton<3>;
template class IslandNewton<6>;

}  // namespace plumb
