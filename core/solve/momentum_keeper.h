// SPDX-License-Identifier: MIT
/// Forces inside of a deformable have neither a resultant nor a torque.
///
/// Its constraints push where their points will be at the end of the substep, which is stable, and
/// leaves a torque about where the points are at its start; rounding leaves a resultant. Both are
/// taken out again after each iteration as the motion of a rigid body, so that momentum and angular
/// momentum stay to rounding: of each piece that hangs together, for others are none of its
/// business. Pieces that hang on the world have no momentum to keep.
#pragma once

#include "math/types.h"
#include "schedule/workers.h"
#include "solve/free_pieces.h"
#include "solve/particle_rows.h"
#include "world/world.h"

#include <vector>

namespace plumb {

template <class Real>
class MomentumKeeper {
public:
    /// `mass` outlives the keeper.
    MomentumKeeper(const World& world, const ParticleMass& mass, Workers& workers)
        : workers_(workers), mass_(mass), pieces_(world, mass), before_(pieces_.size()) {}

    const FreePieces& pieces() const { return pieces_; }

    /// Once a substep.
    void begin(const World& world) {
        first_row_ = world.particle_row(0);
        pieces_.begin(world);
    }

    /// As FreePieces::leave.
    void leave(const std::vector<std::uint8_t>& touches) { pieces_.leave(touches); }

    /// Before and after the constraints of an iteration.
    void note(const BodyRows<Real>& rows, std::uint32_t worker) {
        each(worker, [&](std::uint32_t i) { before_[i] = momentum(pieces_[i], rows); });
    }
    void restore(const BodyRows<Real>& rows, std::uint32_t worker) {
        each(worker, [&](std::uint32_t i) {
            const FreePieces::Piece& piece = pieces_[i];
            const Momentum now = momentum(piece, rows);
            const Vector3d v = (now.linear - before_[i].linear) / piece.mass;
            const Vector3d w = piece.inverse_inertia * (now.angular - before_[i].angular);
            pieces_.each_member(piece, [&](std::uint32_t k) {
                add_change(rows, row(k), -(v + w.cross(pieces_.arm(k))));
            });
        });
    }

private:
    struct Momentum {
        Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
    };

    std::int32_t row(std::uint32_t particle) const {
        return first_row_ + static_cast<std::int32_t>(particle);
    }

    Momentum momentum(const FreePieces::Piece& piece, const BodyRows<Real>& rows) const {
        Momentum sum;
        pieces_.each_member(piece, [&](std::uint32_t i) {
            const Vector3d p = mass_.mass[i] * change_of(rows, row(i));
            sum.linear += p, sum.angular += pieces_.arm(i).cross(p);
        });
        return sum;
    }

    template <class Visit>
    void each(std::uint32_t worker, Visit visit) {
        const Range share = workers_.share(pieces_.size(), worker);
        for (std::uint32_t i = share.first; i < share.last; ++i)
            if (!pieces_[i].is_left) visit(i);
        workers_.barrier();
    }

    Workers& workers_;
    const ParticleMass& mass_;
    FreePieces pieces_;
    std::vector<Momentum> before_;  ///< [piece]
    std::int32_t first_row_ = 0;
};

}  // namespace plumb
