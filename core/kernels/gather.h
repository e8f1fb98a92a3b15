// SPDX-License-Identifier: MIT
/// Rows of bodies into lanes and back.
///
/// A body's row has eight numbers; W rows are read whole and transposed in registers.
#pragma once

#include "constraints/connector.h"
#include "math/lanes.h"
#include "schedule/contact_rows.h"

#include <type_traits>
#include <utility>

namespace plumb::kernels {

/// One exchange of a transposition: blocks of D elements cross over between two registers.
template <int D, bool Upper, class Register, std::size_t... K>
inline Register exchange(Register a, Register b, std::index_sequence<K...>) {
    constexpr int n = sizeof...(K);
    if constexpr (Upper)
        return __builtin_shufflevector(a, b, (K & D ? n + int(K) : int(K) + D)...);
    else
        return __builtin_shufflevector(a, b, (K & D ? n + int(K) - D : int(K))...);
}

/// Transposes the first Rows × Rows elements (and, in wider registers, each further group of Rows
/// alike).
template <int Rows, class Register, int D = 1>
inline void transpose(Register (&m)[Rows]) {
    if constexpr (D < Rows) {
        constexpr std::size_t n = sizeof(Register) / sizeof(m[0][0]);
        for (int i = 0; i < Rows; ++i) {
            if (i & D) continue;
            const Register a = m[i], b = m[i + D];
            m[i] = exchange<D, false>(a, b, std::make_index_sequence<n>());
            m[i + D] = exchange<D, true>(a, b, std::make_index_sequence<n>());
        }
        transpose<Rows, Register, 2 * D>(m);
    }
}

template <class Register, class Real>
inline Register load_register(const Real* from) {
    Register r;
    __builtin_memcpy(&r, from, sizeof r);
    return r;
}
template <class Register, class Real>
inline void store_register(Real* to, const Register& r) {
    __builtin_memcpy(to, &r, sizeof r);
}

/// Two halves side by side, and each half again, in registers all the way.
template <class Register, class Half, std::size_t... K>
inline Register join_halves(Half low, Half high, std::index_sequence<K...>) {
    return __builtin_shufflevector(low, high, int(K)...);
}
template <class Half, bool Upper, class Register, std::size_t... K>
inline Half half_of(Register whole, std::index_sequence<K...>) {
    return __builtin_shufflevector(whole, whole, (Upper ? int(sizeof...(K) + K) : int(K))...);
}

/// Items of n numbers side by side, in a register that is wider: those of `at(0)`, `at(Stride)`,
/// and so on. And back again, calling put(k, item) for the k-th of them.
template <int n, int Stride, class Register, class At>
inline Register load_beside(At at, int i = 0) {
    constexpr int size = sizeof(Register) / sizeof(Register{}[0]);
    if constexpr (size == n) {
        return load_register<Register>(at(i));
    } else {
        typedef std::remove_reference_t<decltype(Register{}[0])> Number;
        typedef Number Half __attribute__((vector_size(sizeof(Register) / 2)));
        return join_halves<Register>(load_beside<n, Stride, Half>(at, i),
                                     load_beside<n, Stride, Half>(at, i + Stride * (size / 2 / n)),
                                     std::make_index_sequence<size>());
    }
}
template <int n, int Stride, class Register, class Put>
inline void part_again(const Register& all, Put put, int i = 0) {
    constexpr int size = sizeof(Register) / sizeof(Register{}[0]);
    if constexpr (size == n) {
        put(i, all);
    } else {
        typedef std::remove_reference_t<decltype(Register{}[0])> Number;
        typedef Number Half __attribute__((vector_size(sizeof(Register) / 2)));
        constexpr auto elements = std::make_index_sequence<size / 2>();
        part_again<n, Stride>(half_of<Half, false>(all, elements), put, i);
        part_again<n, Stride>(half_of<Half, true>(all, elements), put, i + Stride * (size / 2 / n));
    }
}

/// The first Size components of W bodies: component c of lane i.
template <class Real, int W, int Size = kBodyRowSize>
struct RowLanes {
    Lanes<Real, W> component[Size];
};

template <class Real, int W, int Size>
inline void read_rows(const Real* rows, const std::int32_t* index, RowLanes<Real, W, Size>& out) {
    using L = Lanes<Real, W>;
    using Register = typename L::Register;
    constexpr int n = L::kPart;
    for (int part = 0; part < L::kParts; ++part) {
        const std::int32_t* at = index + part * n;
        if constexpr (n <= Size) {
            for (int chunk = 0; chunk < Size / n; ++chunk) {
                Register m[n];
                for (int i = 0; i < n; ++i)
                    m[i] = load_register<Register>(rows + at[i] * kBodyRowSize + chunk * n);
                transpose<n>(m);
                for (int i = 0; i < n; ++i) out.component[chunk * n + i].part[part] = m[i];
            }
        } else {  // several rows to a register
            Register m[Size];
            for (int i = 0; i < Size; ++i)
                m[i] = load_beside<Size, Size, Register>(
                    [&](int k) { return rows + at[k] * kBodyRowSize; }, i);
            transpose<Size>(m);
            for (int c = 0; c < Size; ++c) out.component[c].part[part] = m[c];
        }
    }
}

/// Writes the rows of dynamic bodies only, so that no two threads ever write one row.
template <class Real, int W, int Size>
inline void write_rows(Real* rows, const std::int32_t* index, std::int32_t dynamic_count,
                       const RowLanes<Real, W, Size>& in) {
    using L = Lanes<Real, W>;
    using Register = typename L::Register;
    constexpr int n = L::kPart;
    for (int part = 0; part < L::kParts; ++part) {
        const std::int32_t* at = index + part * n;
        if constexpr (n <= Size) {
            for (int chunk = 0; chunk < Size / n; ++chunk) {
                Register m[n];
                for (int i = 0; i < n; ++i) m[i] = in.component[chunk * n + i].part[part];
                transpose<n>(m);
                for (int i = 0; i < n; ++i)
                    if (at[i] < dynamic_count)
                        store_register(rows + at[i] * kBodyRowSize + chunk * n, m[i]);
            }
        } else {
            Register m[Size];
            for (int c = 0; c < Size; ++c) m[c] = in.component[c].part[part];
            transpose<Size>(m);
            for (int i = 0; i < Size; ++i)
                part_again<Size, Size>(
                    m[i],
                    [&](int k, const auto& row) {
                        if (at[k] < dynamic_count) store_register(rows + at[k] * kBodyRowSize, row);
                    },
                    i);
        }
    }
}

/// Velocities of W bodies.
template <class Real, int W>
inline Velocity<Number<Real, W>> read_velocities(const Real* rows, const std::int32_t (&index)[W]) {
    using T = Number<Real, W>;
    if constexpr (W == 1) {
        const Real* r = rows + index[0] * kBodyRowSize;
        return {Vector3<T>(r[0], r[1], r[2]), Vector3<T>(r[4], r[5], r[6])};
    } else {
        RowLanes<Real, W> m;
        read_rows(rows, index, m);
        const auto& c = m.component;
        return {Vector3<T>(c[0], c[1], c[2]), Vector3<T>(c[4], c[5], c[6])};
    }
}

/// Inverse masses and inertias of W bodies, from rows of seven numbers and one to spare.
template <class Real, int W>
inline void read_masses(const Real* rows, const std::int32_t (&index)[W], Real (&mass)[W],
                        Real (&inertia)[6][W]) {
    if constexpr (W == 1) {
        const Real* r = rows + index[0] * kBodyRowSize;
        mass[0] = r[0];
        for (int i = 0; i < 6; ++i) inertia[i][0] = r[1 + i];
    } else {
        RowLanes<Real, W> m;
        read_rows(rows, index, m);
        store(mass, m.component[0]);
        for (int i = 0; i < 6; ++i) store(inertia[i], m.component[1 + i]);
    }
}

template <class Real, int W>
inline void write_velocities(Real* rows, const std::int32_t (&index)[W], std::int32_t dynamic_count,
                             const Velocity<Number<Real, W>>& x) {
    if constexpr (W == 1) {
        if (index[0] >= dynamic_count) return;
        Real* r = rows + index[0] * kBodyRowSize;
        for (int i = 0; i < 3; ++i) r[i] = x.v[i], r[4 + i] = x.w[i];
    } else {
        const Lanes<Real, W> zero(Real(0));
        const RowLanes<Real, W> m{{x.v[0], x.v[1], x.v[2], zero, x.w[0], x.w[1], x.w[2], zero}};
        write_rows(rows, index, dynamic_count, m);
    }
}

/// The same of particles, whose rows have velocities in their first half alone.
template <class Real, int W>
inline Vector3<Number<Real, W>> read_points(const Real* rows, const std::int32_t (&index)[W]) {
    using T = Number<Real, W>;
    if constexpr (W == 1) {
        const Real* r = rows + index[0] * kBodyRowSize;
        return Vector3<T>(r[0], r[1], r[2]);
    } else {
        RowLanes<Real, W, kBodyRowSize / 2> m;
        read_rows(rows, index, m);
        return Vector3<T>(m.component[0], m.component[1], m.component[2]);
    }
}

template <class Real, int W>
inline void write_points(Real* rows, const std::int32_t (&index)[W], std::int32_t dynamic_count,
                         const Vector3<Number<Real, W>>& x) {
    if constexpr (W == 1) {
        if (index[0] >= dynamic_count) return;
        Real* r = rows + index[0] * kBodyRowSize;
        for (int i = 0; i < 3; ++i) r[i] = x[i];
    } else {
        const RowLanes<Real, W, kBodyRowSize / 2> m{{x[0], x[1], x[2], Lanes<Real, W>(Real(0))}};
        write_rows(rows, index, dynamic_count, m);
    }
}

}  // namespace plumb::kernels
