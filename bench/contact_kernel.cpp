// SPDX-License-Identifier: MIT
/// Nanoseconds a contact and iteration of the contact kernels: 4000 contacts between random pairs
/// of 2000 bodies, with friction, coloured and laid out as the solver does it.
#include "kernels/contact_kernels.h"
#include "schedule/colouring.h"
#include "schedule/contact_batches.h"

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace plumb {
namespace {

constexpr std::int32_t kBodies = 2000;
constexpr std::uint32_t kContacts = 4000;

template <class Real, int W>
class Problem {
public:
    Problem() : change_((kBodies + 1) * kBodyRowSize, Real(0)), start_(change_) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> number(-1, 1);
        std::vector<BodyPair> pairs;
        for (std::uint32_t i = 0; i < kContacts; ++i) {
            const auto a = static_cast<std::int32_t>(random() % kBodies);
            auto b = static_cast<std::int32_t>(random() % kBodies);
            if (a == b) b = (b + 1) % kBodies;
            pairs.push_back({a, b, i, 1, 0});
        }
        Colouring colouring;
        colouring.colour(pairs, kBodies);
        batches_.lay_out(pairs, colouring, ContactVariant::friction, kBodies);
        for (std::size_t p = 0; p < pairs.size(); ++p) fill(batches_.slot(p), random, number);
        for (Real& v : start_) v = static_cast<Real>(number(random));
        run(kernels().prepare);
        run(kernels().begin);
    }

    static const ContactKernels<Real, W>& kernels() {
        return contact_kernels<Real, W>(ContactVariant::friction);
    }

    void run(ContactPass<Real, W> pass) {
        const PassSettings<Real> settings{Real(0.01), Real(100), Real(0.2), Real(0.01),
                                          true,       true,      true,      true};
        const BodyRows<Real> bodies{change_.data(), start_.data(), kBodies};
        for (const BlockRange& range : batches_.ranges())
            pass(batches_.arrays(), bodies, settings, range.first, range.last);
    }

private:
    template <class Slot>
    void fill(Slot slot, std::mt19937& random, std::uniform_real_distribution<double>& number) {
        PairBlock<Real, W>& block = batches_.arrays().blocks[slot.block];
        NormalRow<Real, W>& row = batches_.arrays().normals[block.first_row];
        block.inverse_mass_a[slot.lane] = block.inverse_mass_b[slot.lane] = Real(1);
        for (int i = 0; i < 3; ++i) {
            block.inverse_inertia_a[i][slot.lane] = block.inverse_inertia_b[i][slot.lane] = Real(6);
            row.normal[i][slot.lane] = i == 1 ? Real(1) : Real(0);
            row.arm_a[i][slot.lane] = static_cast<Real>(0.5 * number(random));
            row.arm_b[i][slot.lane] = static_cast<Real>(0.5 * number(random));
        }
        batches_.arrays().frictions[block.first_row].friction[slot.lane] = Real(0.5);
    }

    std::vector<Real> change_, start_;
    ContactBatches<Real, W> batches_;
};

template <class Real, int W>
void pass_of(benchmark::State& state, ContactPass<Real, W> ContactKernels<Real, W>::*pass) {
    if (W > widest_lanes()) return state.SkipWithError("this processor does not run so many lanes");
    Problem<Real, W> problem;
    for (auto _ : state) problem.run(Problem<Real, W>::kernels().*pass);
    state.counters["per contact"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * kContacts,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <class Real, int W>
void velocity_pass(benchmark::State& state) {
    pass_of<Real, W>(state, &ContactKernels<Real, W>::solve_velocities);
}
template <class Real, int W>
void position_pass(benchmark::State& state) {
    pass_of<Real, W>(state, &ContactKernels<Real, W>::solve_positions);
}

BENCHMARK(velocity_pass<float, 1>)->Name("velocity, single, scalar");
BENCHMARK(velocity_pass<float, 4>)->Name("velocity, single, 4 lanes");
BENCHMARK(velocity_pass<float, 8>)->Name("velocity, single, 8 lanes");
BENCHMARK(velocity_pass<float, 16>)->Name("velocity, single, 16 lanes");
BENCHMARK(position_pass<float, 1>)->Name("position, single, scalar");
BENCHMARK(position_pass<float, 4>)->Name("position, single, 4 lanes");
BENCHMARK(position_pass<float, 8>)->Name("position, single, 8 lanes");
BENCHMARK(position_pass<float, 16>)->Name("position, single, 16 lanes");
BENCHMARK(velocity_pass<double, 1>)->Name("velocity, double, scalar");
BENCHMARK(velocity_pass<double, 4>)->Name("velocity, double, 4 lanes");
BENCHMARK(velocity_pass<double, 8>)->Name("velocity, double, 8 lanes");
BENCHMARK(velocity_pass<double, 16>)->Name("velocity, double, 16 lanes");

}  // namespace
}  // namespace plumb

BENCHMARK_MAIN();
