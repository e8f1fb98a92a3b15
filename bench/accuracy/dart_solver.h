// SPDX-License-Identifier: MIT
/// DART's solvers, and its constraint that closes a loop.
#pragma once

#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>

#include <memory>

namespace plumb::bench {

/// `iterations`: 0 for Dantzig's, the default.
inline std::unique_ptr<dart::constraint::ConstraintSolver> dart_solver(int iterations) {
    using namespace dart::constraint;
    if (iterations == 0) return std::make_unique<BoxedLcpConstraintSolver>();
    const auto sweeps = std::make_shared<PgsBoxedLcpSolver>();
    sweeps->setOption(PgsBoxedLcpSolver::Option(iterations, 0, 0));
    return std::make_unique<BoxedLcpConstraintSolver>(sweeps, nullptr);
}

/// A ball joint's three rows. Hinges leave one without effect, so a share of the mass is too little
/// to keep its diagonal from 0, and a constant is added.
class Closure : public dart::constraint::BallJointConstraint {
public:
    using BallJointConstraint::BallJointConstraint;

protected:
    void applyUnitImpulse(std::size_t index) override {
        row_ = index;
        BallJointConstraint::applyUnitImpulse(index);
    }
    void getVelocityChange(double* change, bool with_mixing) override {
        BallJointConstraint::getVelocityChange(change, with_mixing);
        if (with_mixing) change[row_] += kMixing;
    }

private:
    static constexpr double kMixing = 1e-9;  ///< [1/kg]
    std::size_t row_ = 0;
};

}  // namespace plumb::bench
