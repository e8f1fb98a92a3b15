// SPDX-License-Identifier: MIT
/// Items of 3, 4 or 6 doubles of W bodies into lanes and back, transposed in registers.
#pragma once

#include "kernels/gather.h"

#include <cstddef>
#include <cstdint>

namespace plumb::kernels {

/// W is a multiple of 4, and one register holds W numbers.
template <int W>
struct ItemLanes {
    using L = Lanes<double, W>;
    using Register = typename L::Register;
    typedef double Two __attribute__((vector_size(16)));
    typedef double Four __attribute__((vector_size(32)));
    static_assert(W % 4 == 0 && L::kParts == 1);

    /// `to[c]` lane i = column[at[i] N + c].
    template <int N>
    static void read(const double* column, const std::uint32_t (&at)[W], L (&to)[N]) {
        for (int chunk = 0; chunk < N; chunk += 4) {
            Register m[4];
            for (int i = 0; i < 4; ++i)
                m[i] = rows(
                    [&](int row) {
                        return load_items(column + std::size_t(at[row]) * N + chunk, N - chunk);
                    },
                    i);
            transpose<4>(m);
            for (int c = 0; c < 4 && chunk + c < N; ++c) to[chunk + c].part[0] = m[c];
        }
    }

    template <int N>
    static void write(double* column, const std::uint32_t (&at)[W], const L (&from)[N]) {
        for (int chunk = 0; chunk < N; chunk += 4) {
            Register m[4];
            for (int c = 0; c < 4; ++c) m[c] = chunk + c < N ? from[chunk + c].part[0] : Register{};
            transpose<4>(m);
            for (int i = 0; i < 4; ++i) {
                store_items(column + std::size_t(at[i]) * N + chunk, low(m[i]), N - chunk);
                if constexpr (W == 8)
                    store_items(column + std::size_t(at[i + 4]) * N + chunk, high(m[i]), N - chunk);
            }
        }
    }

private:
    /// The items of body i, and beside them, in a register of eight, those of body i + 4.
    template <class Load>
    static Register rows(Load load, int i) {
        if constexpr (W == 4)
            return load(i);
        else
            return join_halves<Register>(load(i), load(i + 4), std::make_index_sequence<8>());
    }
    static Four low(const Register& r) {
        if constexpr (W == 4)
            return r;
        else
            return half_of<Four, false>(r, std::make_index_sequence<4>());
    }
    static Four high(const Register& r) {
        return half_of<Four, true>(r, std::make_index_sequence<4>());
    }

    static Four load_items(const double* from, int count) {
        if (count >= 4) return load_register<Four>(from);
        const Two first = load_register<Two>(from);
        const Two last = count == 3 ? Two{from[2], 0} : Two{0, 0};
        return join_halves<Four>(first, last, std::make_index_sequence<4>());
    }
    static void store_items(double* to, const Four& items, int count) {
        if (count >= 4) return store_register(to, items);
        store_register(to, half_of<Two, false>(items, std::make_index_sequence<2>()));
        if (count == 3) to[2] = items[2];
    }
};

}  // namespace plumb::kernels
