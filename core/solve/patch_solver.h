// SPDX-License-Identifier: MIT
/// The elements of one formula, patch by patch: each patch bears a stress of its own beside what
/// its elements bear, from the whole down to a few of them.
///
/// Sweeps over n rows of elements take n² of them until the first row feels the last. With a patch
/// of them, whose rows are Ĉ = Σ aᵢ Cᵢ and which pushes with aᵢ λ̂ on each of them, what runs
/// through the whole is one unknown more: an aggregation of the system G w Gᵀ + s (Vaněk, Mandel
/// and Brezina 1996) for the impulses of the elements, with stresses constant by patches, in place
/// of one for places. The impulses of patches are handed down to the elements, so that velocities
/// remain what the elements' impulses made them, and a sweep goes on from there.
///
/// A cycle takes C and its gradient once, at the places at the end of the substep as things stand,
/// and is linear from there on. Sweeps over the elements have to follow it.
#pragma once

#include "kernels/point_kernels.h"
#include "math/dense.h"
#include "schedule/workers.h"
#include "solve/patch_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace plumb {

template <class F, class Real, int W>
class PatchSolver {
public:
    static constexpr int kPoints = F::kPoints, kRows = FormulaSize<F>::kRows;
    /// Sweeps over the elements after a cycle. Patches push along gradients of before, which throws
    /// what is taut across itself; fewer sweeps leave that trembling.
    static constexpr int kSmoothing = 7;

    /// A constraint as its group has it, and where that keeps what it has pushed and what damping
    /// takes off; from row to row there are `stride` numbers.
    struct Element {
        std::int32_t row[kPoints];  ///< in the velocity table
        Real numbers[F::kNumbers], softness[kRows];
        Real* impulse;
        const Real* lag;
        Real* push;  ///< at its points but the first, where the formula follows
        std::ptrdiff_t stride;
    };

    /// `elements` and their `corners` at rest, [element][corner] [m]; those of a deformable end at
    /// `ends`. `inverse_mass`: [particle] [1/kg]; the first one has `first_row`.
    PatchSolver(const std::vector<Element>& elements,
                const std::vector<std::array<Vector3d, kPoints>>& corners,
                const std::vector<std::uint32_t>& ends, const std::vector<double>& inverse_mass,
                std::int32_t first_row, std::int32_t zero_row, Workers& workers)
        : tree_(parts(elements, corners, first_row), ends, kLeast),
          first_row_(first_row),
          workers_(workers),
          look_(static_cast<const FormulaKernels<F, Real, W>&>(point_kernels<Real, W>()).look) {
        for (const std::uint32_t i : tree_.order()) elements_.push_back({elements[i], {}});
        for (const PatchPoint& point : tree_.points()) {
            particle_.push_back(point.particle);
            inverse_mass_.push_back(static_cast<Real>(inverse_mass[point.particle]));
        }
        patches_.resize(tree_.patches().size());
        slopes_.resize(tree_.points().size());
        change_.assign(inverse_mass.size(), Vector::Zero());
        for (Bearer& e : elements_) e.share = static_cast<Real>(F::share(e.element.numbers));
        if constexpr (HasAxes<F>) find_axes(corners);
        fill_blocks(zero_row);
        each_from_smallest([&](const Patch& patch, State& state) {
            if (!patch.is_smallest())
                for (int r = 0; r < kRows; ++r)
                    state.softness[r] = half(patch, 0).softness[r] + half(patch, 1).softness[r];
            else
                for (std::uint32_t i = patch.first; i < patch.last; ++i)
                    for (int r = 0; r < kRows; ++r)
                        state.softness[r] += elements_[i].share * elements_[i].share *
                                             elements_[i].element.softness[r];
        });
    }

    /// Whether no deformable is large enough for patches.
    bool empty() const { return patches_.empty(); }

    /// One cycle, called by every worker; ends with all of them at a barrier.
    void iterate(const BodyRows<Real>& rows, Real h, std::uint32_t worker) {
        const Range mine = workers_.share(static_cast<std::uint32_t>(blocks_.size()), worker);
        look_(blocks_.data(), corner_slopes_[0].row[0].data(), rows, h, mine.first, mine.last);
        for (std::uint32_t i = mine.first; i < mine.last; ++i) add_impulses(h, i);
        workers_.barrier();
        if (worker == 0) {
            gather();
            std::fill(change_.begin(), change_.end(), Vector::Zero());
            for (int i = 0; i < kSweeps; ++i) {
                if (i > 0)
                    each_from_smallest([&](auto& patch, State& state) { sum_up(patch, state); });
                solve();
                hand_to_elements();
            }
            add_changes(rows);
        }
        workers_.barrier();
    }

private:
    /// Elements of the smallest patches: where there are fewer, a sweep does as well.
    static constexpr std::uint32_t kLeast = 4;
    /// Sweeps over all patches to one look at the elements: two lead nearly as far as two cycles.
    static constexpr int kSweeps = 2;

    /// Of four, so that it fills a register; the last is 0.
    using Vector = Eigen::Matrix<Real, 4, 1>;
    /// ∂C/∂p of an element's rows as the kernels write them: where kRows is odd, one more that is
    /// 0.
    struct CornerSlope {
        Vector row[2 * kSlopeRows<F>];
    };
    struct Slope {
        Vector row[kRows];  ///< ∂Ĉ/∂p
    };
    /// Axes against those of what an element or patch is part of: cos 2θ and sin 2θ.
    struct Turn {
        Real cosine = 1, sine = 0;
        bool is_none() const { return cosine == 1 && sine == 0; }
        Turn back() const { return {cosine, -sine}; }
    };
    struct Bearer {
        Element element;
        Turn turn;
        Real share = 0, c[kRows] = {};  ///< a; a ((C − lag)/h + s P), in the patch's axes
    };
    struct State {
        Turn turn;
        Real softness[kRows] = {}, c[kRows] = {};
        Real factors[kRows][kRows] = {};  ///< of Ĝ w Ĝᵀ + ŝ
        Real impulse[kRows] = {};         ///< of this cycle, with those of all that it is part of
    };

    static std::vector<PatchTree::Element> parts(
        const std::vector<Element>& elements,
        const std::vector<std::array<Vector3d, kPoints>>& corners, std::int32_t first_row) {
        std::vector<PatchTree::Element> parts(elements.size());
        for (std::size_t i = 0; i < elements.size(); ++i) {
            parts[i].middle = Vector3d::Zero();
            for (int k = 0; k < kPoints; ++k) {
                parts[i].particles.push_back(
                    static_cast<std::uint32_t>(elements[i].row[k] - first_row));
                parts[i].middle += corners[i][k] / kPoints;
            }
        }
        return parts;
    }

    /// Each patch has an axis in its mean plane; what is nearly flat turns little against it.
    void find_axes(const std::vector<std::array<Vector3d, kPoints>>& corners) {
        struct Plane {
            Vector3d along, normal;
        };
        const auto turn_of = [](const Plane& part, const Plane& whole) {
            const Vector3d across = part.normal.cross(part.along);
            const double angle = std::atan2(whole.along.dot(across), whole.along.dot(part.along));
            return Turn{static_cast<Real>(std::cos(2 * angle)),
                        static_cast<Real>(std::sin(2 * angle))};
        };
        std::vector<Plane> of_element, of_patch;
        for (const std::uint32_t i : tree_.order()) {
            const Vector3d along = corners[i][1] - corners[i][0];
            of_element.push_back({along.normalized(), along.cross(corners[i][2] - corners[i][0])});
        }
        for (const Patch& patch : tree_.patches()) {
            Vector3d normal = Vector3d::Zero();
            for (std::uint32_t i = patch.first; i < patch.last; ++i) normal += of_element[i].normal;
            normal.normalize();
            const Vector3d x = std::abs(normal.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
            of_patch.push_back({(x - normal * normal.dot(x)).normalized(), normal});
        }
        for (Plane& plane : of_element) plane.normal.normalize();
        for (std::size_t p = 0; p < of_patch.size(); ++p) {
            const Patch& patch = tree_.patches()[p];
            if (patch.parent != kNoIndex)
                patches_[p].turn = turn_of(of_patch[p], of_patch[patch.parent]);
            if (!patch.is_smallest()) continue;
            for (std::uint32_t i = patch.first; i < patch.last; ++i)
                elements_[i].turn = turn_of(of_element[i], of_patch[p]);
        }
    }

    static void turn_rows(Real (&rows)[kRows], const Turn& turn) {
        if constexpr (HasAxes<F>) F::turn(rows, turn.cosine, turn.sine);
    }
    static void turn_rows(Slope& slope, const Turn& turn) {
        if constexpr (HasAxes<F>) F::turn(slope.row, turn.cosine, turn.sine);
    }

    void fill_blocks(std::int32_t zero_row) {
        const std::size_t blocks = (elements_.size() + W - 1) / W;
        blocks_.resize(blocks);
        corner_slopes_.resize(blocks * W * kPoints);
        for (CornerSlope& slope : corner_slopes_)  // kernels of one lane leave the fourth alone
            for (Vector& row : slope.row) row.setZero();
        for (std::size_t i = 0; i < blocks * W; ++i) {
            // an empty lane looks at an element that is nowhere
            const Bearer& e = elements_[std::min(i, elements_.size() - 1)];
            Block& block = blocks_[i / W];
            const std::size_t lane = i % W;
            for (int k = 0; k < kPoints; ++k) {
                block.row[k][lane] = i < elements_.size() ? e.element.row[k] : zero_row;
                block.slope[k][lane] = static_cast<std::int32_t>((i * kPoints + k) * kSlopeRows<F>);
            }
            for (int k = 0; k < F::kNumbers; ++k) block.numbers[k][lane] = e.element.numbers[k];
            block.share[lane] = e.share;
            block.cosine[lane] = e.turn.cosine, block.sine[lane] = e.turn.sine;
        }
    }

    /// What the elements of a block have pushed so far, and what damping takes off.
    void add_impulses(Real h, std::uint32_t block) {
        const std::size_t first = std::size_t(block) * W;
        for (std::size_t i = first; i < std::min(first + W, elements_.size()); ++i) {
            Bearer& e = elements_[i];
            const Element& own = e.element;
            for (int r = 0; r < kRows; ++r)
                e.c[r] = e.share * (own.softness[r] * own.impulse[r * own.stride] -
                                    own.lag[r * own.stride] / h);
            turn_rows(e.c, e.turn);
            for (int r = 0; r < kRows; ++r) e.c[r] += blocks_[block].c[r][i - first];
        }
    }

    /// From the smallest patches to the whole: Ĉ, its gradient, and the system of each.
    void gather() {
        each_from_smallest([&](const Patch& patch, State& state) {
            sum_up(patch, state);
            Vector squares[kRows][kRows];
            for (auto& row : squares)
                for (Vector& square : row) square.setZero();
            for (std::uint32_t i = patch.point; i < patch.point_end; ++i) {
                const Slope& slope = slopes_[i] = slope_at(patch, tree_.points()[i]);
                for (int r = 0; r < kRows; ++r) {
                    const Vector response = inverse_mass_[i] * slope.row[r];
                    for (int s = 0; s <= r; ++s)
                        squares[r][s] += response.cwiseProduct(slope.row[s]);
                }
            }
            for (int r = 0; r < kRows; ++r) {
                for (int s = 0; s <= r; ++s) state.factors[r][s] = squares[r][s].sum();
                state.factors[r][r] += state.softness[r];
            }
            factor_ldlt<Real, kRows>(state.factors, kRows);
        });
    }

    /// Ĉ of a patch, from those of its halves or elements.
    void sum_up(const Patch& patch, State& state) {
        std::fill(std::begin(state.c), std::end(state.c), Real(0));
        if (patch.is_smallest()) {
            for (std::uint32_t i = patch.first; i < patch.last; ++i)
                for (int r = 0; r < kRows; ++r) state.c[r] += elements_[i].c[r];
        } else {
            for (int k = 0; k < 2; ++k) {
                Real c[kRows];
                std::copy_n(half(patch, k).c, kRows, c);
                turn_rows(c, half(patch, k).turn);
                for (int r = 0; r < kRows; ++r) state.c[r] += c[r];
            }
        }
    }

    Slope slope_at(const Patch& patch, const PatchPoint& point) const {
        Slope sum;
        for (Vector& row : sum.row) row.setZero();
        if (patch.is_smallest()) {
            for (std::uint32_t i = point.from[0]; i < point.from[1]; ++i)
                for (int r = 0; r < kRows; ++r)
                    sum.row[r] += corner_slopes_[tree_.corners()[i]].row[r];
            return sum;
        }
        for (int k = 0; k < 2; ++k) {
            if (point.from[k] == kNoIndex) continue;
            Slope part = slopes_[point.from[k]];
            if (!half(patch, k).turn.is_none()) turn_rows(part, half(patch, k).turn);
            for (int r = 0; r < kRows; ++r) sum.row[r] += part.row[r];
        }
        return sum;
    }

    /// From the whole to the smallest patches, each with what those before it have changed.
    void solve() {
        for (std::size_t p = 0; p < patches_.size(); ++p) {
            const Patch& patch = tree_.patches()[p];
            State& state = patches_[p];
            std::fill(std::begin(state.impulse), std::end(state.impulse), Real(0));
            if (patch.parent != kNoIndex) {
                std::copy_n(patches_[patch.parent].impulse, kRows, state.impulse);
                turn_rows(state.impulse, state.turn.back());
            }
            Vector moved[kRows];
            for (Vector& row : moved) row.setZero();
            for (std::uint32_t i = patch.point; i < patch.point_end; ++i)
                for (int r = 0; r < kRows; ++r)
                    moved[r] += slopes_[i].row[r].cwiseProduct(change_[particle_[i]]);
            Real push[kRows];
            for (int r = 0; r < kRows; ++r)
                push[r] = -(state.c[r] + state.softness[r] * state.impulse[r] + moved[r].sum());
            solve_lower<Real, kRows>(state.factors, kRows, push);
            solve_upper<Real, kRows>(state.factors, kRows, push);
            for (std::uint32_t i = patch.point; i < patch.point_end; ++i) {
                Vector sum = push[0] * slopes_[i].row[0];
                for (int r = 1; r < kRows; ++r) sum += push[r] * slopes_[i].row[r];
                change_[particle_[i]] += inverse_mass_[i] * sum;
            }
            for (int r = 0; r < kRows; ++r) state.impulse[r] += push[r];
        }
    }

    /// Impulses to the elements.
    void hand_to_elements() {
        for (std::size_t p = 0; p < patches_.size(); ++p) {
            const Patch& patch = tree_.patches()[p];
            if (!patch.is_smallest()) continue;
            for (std::uint32_t i = patch.first; i < patch.last; ++i) {
                Bearer& e = elements_[i];
                Real impulse[kRows];
                std::copy_n(patches_[p].impulse, kRows, impulse);
                for (int r = 0; r < kRows; ++r)
                    e.c[r] += e.share * e.share * e.element.softness[r] * impulse[r];
                if constexpr (HasFollowing<F>) add_push(i, impulse);
                turn_rows(impulse, e.turn.back());
                for (int r = 0; r < kRows; ++r)
                    e.element.impulse[r * e.element.stride] += e.share * impulse[r];
            }
        }
    }

    /// To what an element has pushed; the impulse is in the patch's axes, as its gradients are.
    void add_push(std::uint32_t i, const Real (&impulse)[kRows]) {
        const Element& element = elements_[i].element;
        for (int k = 1; k < kPoints; ++k) {
            const CornerSlope& slope = corner_slopes_[std::size_t(i) * kPoints + k];
            for (int x = 0; x < 3; ++x) {
                Real& push = element.push[(3 * (k - 1) + x) * element.stride];
                for (int r = 0; r < kRows; ++r) push += slope.row[r][x] * impulse[r];
            }
        }
    }

    void add_changes(const BodyRows<Real>& rows) {
        for (std::size_t i = 0; i < change_.size(); ++i) {
            Real* x = rows.change + (first_row_ + static_cast<std::ptrdiff_t>(i)) * kBodyRowSize;
            for (int k = 0; k < 3; ++k) x[k] += change_[i][k];
        }
    }

    template <class Visit>
    void each_from_smallest(Visit visit) {
        for (std::size_t p = patches_.size(); p-- > 0;) visit(tree_.patches()[p], patches_[p]);
    }
    const State& half(const Patch& patch, int k) const { return patches_[patch.half[k]]; }

    PatchTree tree_;
    std::int32_t first_row_;
    Workers& workers_;
    using Block = FormulaPatchBlock<F, Real, W>;
    void (*look_)(Block*, Real*, const BodyRows<Real>&, Real, std::uint32_t, std::uint32_t);
    std::vector<Block> blocks_;               ///< of the elements, in the tree's order
    std::vector<Bearer> elements_;            ///< in the tree's order
    std::vector<State> patches_;              ///< as in the tree
    std::vector<Slope> slopes_;               ///< [point of the tree]
    std::vector<CornerSlope> corner_slopes_;  ///< [element][corner]
    std::vector<std::uint32_t> particle_;     ///< [point of the tree]
    std::vector<Real> inverse_mass_;          ///< [point of the tree] [1/kg]
    std::vector<Vector> change_;              ///< [particle] in this cycle [m/s]
};

}  // namespace plumb
