// SPDX-License-Identifier: MIT
/// The constraints of one formula among particles, in coloured blocks of W lanes.
#pragma once

#include "kernels/point_kernels.h"
#include "schedule/colouring.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/joined_bodies.h"
#include "solve/patch_solver.h"

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <vector>

namespace plumb {

template <class F, class Real, int W>
class PointGroup final : public ConstraintGroup<Real> {
public:
    PointGroup(const World& world, const ParticleMass& mass, Workers& workers)
        : kernels_(point_kernels<Real, W>()), workers_(workers) {
        const double h = world.settings.dt / world.settings.substeps;
        for (const Deformable& d : world.deformables)
            F::each(d, [&](const auto& points, const auto& numbers, const auto& compliances) {
                add(world, mass, d, points, numbers, compliances, h);
            });
        colouring_.colour(links_, world.moving_count());
        lay_out(world);
        if constexpr (HasPatches<F>)
            if (world.settings.multilevel) make_patches(world, mass);
    }

    Stage stage() const override { return Stage::particles; }
    bool empty() const override { return blocks_.empty(); }

    std::uint32_t rounds() const override {
        if constexpr (HasPatches<F>) return has_patches() ? patches_->kSmoothing : 1;
        return 1;
    }

    void begin(const World&, const BodyRows<Real>& rows, const PassSettings<Real>& pass,
               double) override {
        std::fill(pushes_.begin(), pushes_.end(), Pushes{});
        workers_.run([&](std::uint32_t worker) { iterate(kernels_.begin, rows, pass, worker); });
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        if constexpr (HasPatches<F>)
            if (has_patches()) {
                if (pass.round == 0) patches_->iterate(rows, pass.h, worker);
                if constexpr (HasFollowing<F>)
                    iterate(
                        [this](Block* blocks, const BodyRows<Real>& to, Real h, std::uint32_t first,
                               std::uint32_t last) {
                            kernels_.follow(blocks, pushes_.data(), to, h, first, last);
                        },
                        rows, pass, worker);
                else
                    iterate(kernels_.solve, rows, pass, worker);
                return;
            }
        if (pass.round + 1 == pass.rounds) iterate(kernels_.solve, rows, pass, worker);
    }

private:
    using Size = FormulaSize<F>;
    using Block = FormulaBlock<F, Real, W>;
    using Kernels = FormulaKernels<F, Real, W>;
    using Pushes = FormulaPushBlock<F, Real, W>;

    bool has_patches() const requires HasPatches<F> { return patches_ && !patches_->empty(); }

    /// One constraint, as it goes into a lane.
    struct Item {
        std::array<double, F::kPoints> inverse_mass;
        std::array<double, Size::kNumbers> numbers;
        std::array<double, Size::kCompliances> softness;
        double damped;
    };

    template <class Points, class Compliances>
    void add(const World& world, const ParticleMass& mass, const Deformable& d,
             const Points& points, const double (&numbers)[Size::kNumbers],
             const Compliances& compliances, double h) {
        const double damping = d.spec.elasticity.damping;
        Item item;
        LinkedRows<F::kPoints> link;
        for (int i = 0; i < F::kPoints; ++i) {
            const std::uint32_t particle = d.first + points[i];
            link.rows[i] = world.particle_row(particle);
            item.inverse_mass[i] = mass.inverse[particle];
        }
        std::copy_n(numbers, Size::kNumbers, item.numbers.begin());
        if constexpr (Size::kIsLinear)
            item.softness[0] = point_softness(compliances, damping, h);
        else
            for (int k = 0; k < Size::kRows; ++k)
                item.softness[k] = point_softness(compliances[k], damping, h);
        item.damped = point_lag(damping, h);
        links_.push_back(link), items_.push_back(item);
    }

    /// Calls visit(first, last), places in the colouring's order, for each block of a batch.
    template <class Visit>
    static void each_block(const Batch& batch, Visit visit) {
        const std::uint32_t width = batch.independent ? W : 1;
        for (std::uint32_t i = batch.first; i < batch.last; i += width)
            visit(i, std::min(i + width, batch.last));
    }
    template <class Visit>
    void each_block(Visit visit) const {
        for (const Batch& batch : colouring_.batches()) each_block(batch, visit);
    }

    void lay_out(const World& world) {
        for (const Batch& batch : colouring_.batches()) {
            const auto first = static_cast<std::uint32_t>(blocks_.size());
            each_block(batch, [&](std::uint32_t i, std::uint32_t last) {
                add_block(world.zero_row(), i, last);
            });
            ranges_.push_back(
                {first, static_cast<std::uint32_t>(blocks_.size()), batch.independent});
        }
    }

    void add_block(std::int32_t zero_row, std::uint32_t first, std::uint32_t last) {
        Block& block = blocks_.emplace_back();
        for (auto& rows : block.row) std::fill(std::begin(rows), std::end(rows), zero_row);
        // a lane without an item has a system that can be solved
        for (auto& softness : block.softness)
            std::fill(std::begin(softness), std::end(softness), Real(1));
        for (auto& numbers : block.numbers)
            std::fill(std::begin(numbers), std::end(numbers), Real(1));
        for (std::uint32_t i = first; i < last; ++i) {
            const std::uint32_t at = colouring_.order()[i], lane = i - first;
            const Item& item = items_[at];
            const auto put = [&](auto& columns, const auto& numbers) {
                for (std::size_t k = 0; k < numbers.size(); ++k)
                    columns[k][lane] = static_cast<Real>(numbers[k]);
            };
            for (int k = 0; k < F::kPoints; ++k) block.row[k][lane] = links_[at].rows[k];
            put(block.inverse_mass, item.inverse_mass);
            put(block.numbers, item.numbers);
            put(block.softness, item.softness);
            block.damped[lane] = static_cast<Real>(item.damped);
        }
    }

    /// Over the constraints as they were told, in their places in the blocks.
    void make_patches(const World& world, const ParticleMass& mass) {
        using Patches = PatchSolver<F, Real, W>;
        std::vector<typename Patches::Element> elements(items_.size());
        if constexpr (HasFollowing<F>) pushes_.resize(blocks_.size());
        auto block_at = blocks_.begin();
        each_block([&](std::uint32_t first, std::uint32_t last) {
            Block& block = *block_at++;
            for (std::uint32_t i = first; i < last; ++i) {
                const std::uint32_t lane = i - first;
                auto& element = elements[colouring_.order()[i]];
                for (int k = 0; k < F::kPoints; ++k) element.row[k] = block.row[k][lane];
                for (int k = 0; k < Size::kNumbers; ++k)
                    element.numbers[k] = block.numbers[k][lane];
                for (int k = 0; k < Size::kRows; ++k) element.softness[k] = block.softness[k][lane];
                element.impulse = &block.impulse[0][lane], element.lag = &block.lag[0][lane];
                if constexpr (HasFollowing<F>)
                    element.push = &pushes_[std::size_t(&block - blocks_.data())].push[0][lane];
                element.stride = W;
            }
        });
        std::vector<std::array<Vector3d, F::kPoints>> corners;
        std::vector<std::uint32_t> ends;
        for (const Deformable& d : world.deformables) {
            F::each(d, [&](const auto& points, const auto&, const auto&) {
                auto& at = corners.emplace_back();
                for (int k = 0; k < F::kPoints; ++k) at[k] = d.spec.points[points[k]];
            });
            ends.push_back(static_cast<std::uint32_t>(corners.size()));
        }
        if (!elements.empty())
            patches_.emplace(elements, corners, ends, mass.inverse, world.particle_row(0),
                             world.zero_row(), workers_);
    }

    /// Every worker takes its share of blocks that are independent, and waits for the others.
    template <class Kernel>
    void iterate(Kernel kernel, const BodyRows<Real>& rows, const PassSettings<Real>& pass,
                 std::uint32_t worker) {
        for (std::size_t i = 0; i < ranges_.size(); ++i) {
            const BlockRange& range = ranges_[pass.forwards ? i : ranges_.size() - 1 - i];
            Range share = workers_.share(range.last - range.first, worker);
            if (!range.independent)
                share = worker == 0 ? Range{0, range.last - range.first} : Range{0, 0};
            kernel(blocks_.data(), rows, pass.h, range.first + share.first,
                   range.first + share.last);
            workers_.barrier();
        }
    }

    const Kernels& kernels_;
    Workers& workers_;
    std::vector<LinkedRows<F::kPoints>> links_;
    std::vector<Item> items_;
    Colouring colouring_;
    std::vector<Block> blocks_;
    std::vector<Pushes> pushes_;  ///< [block], where what was pushed follows its elements
    std::vector<BlockRange> ranges_;
    struct None {};
    std::conditional_t<HasPatches<F>, std::optional<PatchSolver<F, Real, W>>, None> patches_;
};

}  // namespace plumb
