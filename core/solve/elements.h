// SPDX-License-Identifier: MIT
/// The energies of deformables, as one system takes them: forces and stiffness of all elements of a
/// formula.
///
///   E = Σ ½ k |C(x) − C₀|²,  k = (h + τ)/(h α),  C₀ = the share that damping takes off
///
/// which is what the rows of constraints/points.h minimise one by one. The stiffness has the
/// squares of gradients, and how a pull stiffens an element across itself; what is left out would
/// make it indefinite. The pull is the one that the step before foresaw, as if stresses were
/// unknowns of their own: a step across a stiff element stretches it in second order, which the
/// next one takes back, and until then the pull is much too great.
#pragma once

#include "constraints/formulas.h"
#include "math/sparse_ldlt.h"
#include "world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace plumb {

/// [particle], of the places at the end of the substep [m].
using ParticlePlaces = std::vector<Vector3d>;

class Elements {
public:
    virtual ~Elements() = default;

    /// Pairs of particles that an element has in common.
    virtual void add_pairs(std::vector<SparseLdlt::Pair>& pairs) const = 0;
    virtual void find_slots(const SparseLdlt& system) = 0;

    /// Once a substep of length h [s], from the places at its start.
    virtual void begin(const ParticlePlaces& start, double h) = 0;

    /// Adds −∇E to the forces of the particles [N], and returns E [J].
    virtual double add_forces(const ParticlePlaces& x, std::vector<Vector3d>& force) const = 0;
    /// `scale` times the stiffness [N/m] at x, to which a step led from `before`; it follows from
    /// these places and the length of the substep alone.
    virtual void add_stiffness(const ParticlePlaces& x, const ParticlePlaces& before, double scale,
                               SparseLdlt& system) const = 0;
};

template <class F>
class ElementsOf final : public Elements {
public:
    /// Substeps are h [s] long.
    ElementsOf(const World& world, double h) {
        const Particles& p = world.particles;
        for (const Deformable& d : world.deformables)
            F::each(d, [&](const auto& points, const auto& numbers, const auto& compliances) {
                Element e{};
                for (int i = 0; i < kPoints; ++i) {
                    e.node[i] = d.first + points[i];
                    e.moves[i] = p.inverse_mass[e.node[i]] > 0;
                }
                std::copy_n(numbers, Size::kNumbers, e.numbers);
                if constexpr (Size::kIsLinear)
                    e.compliance[0] = compliances;
                else
                    std::copy_n(compliances, Size::kRows, e.compliance);
                e.damping = d.spec.elasticity.damping;
                e.is_weak = Size::kIsLinear && is_weak(e, p, h);
                elements_.push_back(e);
            });
    }

    bool empty() const { return elements_.empty(); }

    void add_pairs(std::vector<SparseLdlt::Pair>& pairs) const override {
        for (const Element& e : elements_)
            each_pair(e, [&](int i, int j, int) { pairs.emplace_back(e.node[i], e.node[j]); });
    }

    void find_slots(const SparseLdlt& system) override {
        for (Element& e : elements_)
            each_pair(e,
                      [&](int i, int j, int k) { e.slot[k] = system.slot(e.node[i], e.node[j]); });
    }

    void begin(const ParticlePlaces& start, double h) override {
        for (Element& e : elements_) {
            const double lag = point_lag(e.damping, h);
            for (int r = 0; r < kRows; ++r) e.rest[r] = 0;
            for (int r = 0; r < Size::kCompliances; ++r)
                e.stiffness[r] = (h + e.damping) / (h * e.compliance[r]);
            if (!(lag > 0)) continue;
            const Here here(e, start);
            for (int r = 0; r < kRows; ++r) e.rest[r] = lag * here.c[r];
        }
    }

    double add_forces(const ParticlePlaces& x, std::vector<Vector3d>& force) const override {
        double energy = 0;
        for (const Element& e : elements_) {
            const Here here(e, x);
            for (int r = 0; r < kRows; ++r)
                energy += 0.5 * here.force(e, r) * (here.c[r] - e.rest[r]);
            for (int i = 0; i < kPoints; ++i) {
                Vector3d sum = Vector3d::Zero();
                if constexpr (Size::kIsLinear) {
                    for (int r = 0; r < 3; ++r) sum[r] = here.force(e, r) * e.numbers[i];
                } else {
                    for (int r = 0; r < kRows; ++r)
                        sum += here.force(e, r) * here.rows.gradient[r][i];
                }
                force[e.node[i]] -= sum;
            }
        }
        return energy;
    }

    void add_stiffness(const ParticlePlaces& x, const ParticlePlaces& before, double scale,
                       SparseLdlt& system) const override {
        for (const Element& e : elements_) {
            if constexpr (Size::kIsLinear) {
                const double k = scale * e.stiffness[0];
                double all = 0;
                for (const double weight : e.numbers) all += std::abs(weight);
                if (e.is_weak) {
                    // not less than the whole: |wᵢ| Σ |wⱼ| on the diagonal
                    for (int i = 0; i < kPoints; ++i)
                        if (e.moves[i])
                            system.add(e.node[i],
                                       k * std::abs(e.numbers[i]) * all * Matrix3d::Identity());
                    continue;
                }
                add(e, system, [&](int i, int j) -> Matrix3d {
                    return (k * e.numbers[i] * e.numbers[j]) * Matrix3d::Identity();
                });
            } else {
                const Here here(e, x);
                Eigen::Matrix<double, kPoints, kPoints> across =
                    Eigen::Matrix<double, kPoints, kPoints>::Zero();
                if constexpr (requires { &F::tension; }) {
                    const Here there(e, before);
                    double force[kRows];
                    for (int r = 0; r < kRows; ++r)
                        force[r] = e.stiffness[r] * there.foreseen(e, r, x, before);
                    across = F::tension(here.place, e.numbers, force);
                }
                add(e, system, [&](int i, int j) -> Matrix3d {
                    Matrix3d sum = across(i, j) * Matrix3d::Identity();
                    for (int r = 0; r < kRows; ++r)
                        sum += (e.stiffness[r] * here.rows.gradient[r][i]) *
                               here.rows.gradient[r][j].transpose();
                    return scale * sum;
                });
            }
        }
    }

private:
    using Size = FormulaSize<F>;
    static constexpr int kPoints = F::kPoints, kRows = Size::kRows;
    static constexpr int kPairs = kPoints * (kPoints - 1) / 2;

    /// Beside the inertia of its points, an element that is weaker than this share of it needs no
    /// blocks of its own off the diagonal.
    static constexpr double kWeak = 0.1;

    struct Element {
        std::uint32_t node[kPoints];
        bool moves[kPoints];
        bool is_weak;
        SparseLdlt::Slot slot[kPairs];
        double numbers[Size::kNumbers], compliance[Size::kCompliances];
        double damping;
        double stiffness[Size::kCompliances], rest[kRows];  ///< k and C₀ of this substep
    };

    /// An element at the given places.
    struct Here {
        Vector3d place[kPoints];
        PointRows<double, kPoints, kRows> rows;  ///< of what is linear, C alone
        double c[kRows];

        Here(const Element& e, const ParticlePlaces& x) {
            for (int i = 0; i < kPoints; ++i) place[i] = x[e.node[i]] - x[e.node[0]];
            if constexpr (Size::kIsLinear) {
                Vector3d sum = Vector3d::Zero();
                for (int i = 0; i < kPoints; ++i) sum += e.numbers[i] * place[i];
                for (int r = 0; r < 3; ++r) c[r] = sum[r];
            } else {
                rows = F::rows(place, e.numbers);
                for (int r = 0; r < kRows; ++r) c[r] = rows.c[r];
            }
        }
        /// k (C − C₀) of a row.
        double force(const Element& e, int r) const {
            return e.stiffness[Size::kIsLinear ? 0 : r] * (c[r] - e.rest[r]);
        }
        /// C of a row at x, as its gradient at the places here foresees it.
        double foreseen(const Element& e, int r, const ParticlePlaces& x,
                        const ParticlePlaces& here) const {
            double sum = c[r];
            for (int i = 0; i < kPoints; ++i)
                sum += rows.gradient[r][i].dot(x[e.node[i]] - here[e.node[i]]);
            return sum;
        }
    };

    static bool is_weak(const Element& e, const Particles& p, double h) {
        double all = 0, lightest = std::numeric_limits<double>::infinity(), largest = 0;
        for (int i = 0; i < kPoints; ++i) {
            all += std::abs(e.numbers[i]);
            largest = std::max(largest, std::abs(e.numbers[i]));
            if (e.moves[i]) lightest = std::min(lightest, p.mass[e.node[i]]);
        }
        const double stiffness = h * (h + e.damping) / e.compliance[0];
        return stiffness * largest * all < kWeak * lightest;
    }

    /// Calls visit(i, j, k) for each pair of points that both move and feel each other.
    template <class Visit>
    static void each_pair(const Element& e, Visit visit) {
        if (e.is_weak) return;
        int k = 0;
        for (int i = 0; i < kPoints; ++i)
            for (int j = i + 1; j < kPoints; ++j, ++k)
                if (e.moves[i] && e.moves[j]) visit(i, j, k);
    }

    template <class Block>
    static void add(const Element& e, SparseLdlt& system, Block block) {
        for (int i = 0; i < kPoints; ++i)
            if (e.moves[i]) system.add(e.node[i], block(i, i));
        each_pair(e, [&](int i, int j, int k) { system.add(e.slot[k], block(i, j)); });
    }

    std::vector<Element> elements_;
};

/// The elements of all formulas that the world's deformables call for.
template <class... F>
inline std::vector<std::unique_ptr<Elements>> make_elements(const World& world, double h,
                                                            FormulaList<F...>) {
    std::vector<std::unique_ptr<Elements>> all;
    const auto add = [&](auto elements) {
        if (!elements->empty()) all.push_back(std::move(elements));
    };
    (add(std::make_unique<ElementsOf<F>>(world, h)), ...);
    return all;
}

}  // namespace plumb
