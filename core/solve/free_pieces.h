// SPDX-License-Identifier: MIT
/// Connected pieces of deformables that nothing immovable holds: each has a momentum of its own to
/// keep.
#pragma once

#include "math/disjoint_sets.h"
#include "math/types.h"
#include "solve/joined_bodies.h"
#include "world/world.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace plumb {

class FreePieces {
public:
    struct Piece {
        std::uint32_t first, last;  ///< of its members
        double mass = 0;            ///< [kg]
        double size = 0;            ///< radius of gyration [m]
        Matrix3d inverse_inertia = Matrix3d::Zero();
        bool is_left = false;  ///< it has no momentum to keep in this step
    };

    /// `mass` outlives the pieces.
    FreePieces(const World& world, const ParticleMass& mass)
        : mass_(mass), piece_of_(world.particles.size(), kNoIndex) {
        for (const Deformable& d : world.deformables) add_pieces(d);
        arm_.assign(world.particles.size(), Vector3d::Zero());
    }

    std::uint32_t size() const { return static_cast<std::uint32_t>(pieces_.size()); }
    const Piece& operator[](std::size_t i) const { return pieces_[i]; }

    /// Of the particle, or kNoIndex: of none, or of one that is left.
    std::uint32_t piece_of(std::uint32_t particle) const {
        const std::uint32_t i = piece_of_[particle];
        return i == kNoIndex || pieces_[i].is_left ? kNoIndex : i;
    }
    /// Of the particle, from the centre of its piece [m].
    const Vector3d& arm(std::uint32_t particle) const { return arm_[particle]; }

    template <class Visit>
    void each_member(const Piece& piece, Visit visit) const {
        for (std::uint32_t k = piece.first; k < piece.last; ++k) visit(member_[k]);
    }

    /// Once a step: pieces that touch what does not move have no momentum to keep. `touches`:
    /// [particle]
    void leave(const std::vector<std::uint8_t>& touches) {
        for (Piece& piece : pieces_) {
            piece.is_left = false;
            each_member(piece, [&](std::uint32_t i) { piece.is_left |= touches[i] != 0; });
        }
    }

    /// Once a substep: where the particles are, and their moments of inertia.
    void begin(const World& world) {
        const Particles& p = world.particles;
        for (Piece& piece : pieces_) {
            Vector3d centre = Vector3d::Zero();
            piece.mass = 0;
            const Vector3d& near = p.position[member_[piece.first]];
            each_member(piece, [&](std::uint32_t i) {
                piece.mass += mass_.mass[i], centre += mass_.mass[i] * (p.position[i] - near);
            });
            centre = near + centre / piece.mass;
            Matrix3d inertia = Matrix3d::Zero();
            each_member(piece, [&](std::uint32_t i) {
                arm_[i] = p.position[i] - centre;
                inertia += mass_.mass[i] * (arm_[i].squaredNorm() * Matrix3d::Identity() -
                                            arm_[i] * arm_[i].transpose());
            });
            piece.size = std::sqrt(inertia.trace() / piece.mass);
            // a straight string has no inertia about itself, and nothing turns it there
            inertia += 1e-13 * inertia.trace() * Matrix3d::Identity();
            piece.inverse_inertia = inertia.inverse();
        }
    }

private:
    /// The free pieces of a deformable, by their lowest points.
    void add_pieces(const Deformable& d) {
        DisjointSets points;
        points.reset(d.count);
        const auto hang_together = [&](const auto& elements) {
            for (const auto& element : elements)
                for (const std::uint32_t point : element) points.unite(element[0], point);
        };
        hang_together(d.spec.segments), hang_together(d.spec.triangles);
        hang_together(d.spec.tetrahedra);
        std::vector<std::vector<std::uint32_t>> pieces(d.count);
        for (std::uint32_t i = 0; i < d.count; ++i) pieces[points.lowest(i)].push_back(d.first + i);
        for (const std::vector<std::uint32_t>& piece : pieces) {
            const bool is_free = std::all_of(piece.begin(), piece.end(),
                                             [&](std::uint32_t i) { return mass_.inverse[i] > 0; });
            // nothing inside of a single point pushes it
            if (piece.size() < 2 || !is_free) continue;
            const auto first = static_cast<std::uint32_t>(member_.size());
            for (const std::uint32_t i : piece) piece_of_[i] = size();
            member_.insert(member_.end(), piece.begin(), piece.end());
            pieces_.push_back({first, static_cast<std::uint32_t>(member_.size())});
        }
    }

    const ParticleMass& mass_;
    std::vector<Piece> pieces_;
    std::vector<std::uint32_t> member_;    ///< particles, piece by piece
    std::vector<std::uint32_t> piece_of_;  ///< [particle], or kNoIndex
    std::vector<Vector3d> arm_;            ///< [particle] from the centre of its piece [m]
};

}  // namespace plumb
