// SPDX-License-Identifier: MIT
/// N numbers side by side, with the operators of one number.
///
/// A formula written over a number type T runs on a float, a double, or Lanes<T, N>, and gives the
/// same bits in each lane as on the scalar: there is no fused multiply-add, no reciprocal estimate
/// and no reordering. Lanes are kept in the widest registers that the translation unit is compiled
/// for; N may be a multiple of those.
#pragma once

#include "math/types.h"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace plumb {

#if defined(__AVX512F__)
inline constexpr std::size_t kRegisterBytes = 64;
#elif defined(__AVX2__)
inline constexpr std::size_t kRegisterBytes = 32;
#else
inline constexpr std::size_t kRegisterBytes = 16;
#endif

/// Number of T in one register that holds part of N lanes.
template <class T, int N>
inline constexpr int kPartSize = N * sizeof(T) < kRegisterBytes
                                     ? N
                                     : static_cast<int>(kRegisterBytes / sizeof(T));

template <class T, int N>
struct Lanes {
    static constexpr int kPart = kPartSize<T, N>;
    static constexpr int kParts = N / kPart;
    typedef T Register __attribute__((vector_size(kPart * sizeof(T))));

    Register part[kParts];

    Lanes() = default;
    /// A scalar stands for N equal lanes.
    template <class Scalar, class = std::enable_if_t<std::is_arithmetic_v<Scalar>>>
    Lanes(Scalar x) {  // NOLINT: implicit, as for numbers
        for (auto& p : part) p = static_cast<T>(x) - Register{};
    }

    static Lanes load(const T* from) {
        Lanes r;
        __builtin_memcpy(&r, __builtin_assume_aligned(from, sizeof(Register)), sizeof r);
        return r;
    }
    void store(T* to) const {
        __builtin_memcpy(__builtin_assume_aligned(to, sizeof(Register)), this, sizeof *this);
    }

    Lanes& operator+=(const Lanes& o) { return *this = *this + o; }
    Lanes& operator-=(const Lanes& o) { return *this = *this - o; }
    Lanes& operator*=(const Lanes& o) { return *this = *this * o; }
    Lanes& operator/=(const Lanes& o) { return *this = *this / o; }

    template <class Op>
    static Lanes zip(const Lanes& a, const Lanes& b, Op op) {
        Lanes r;
        for (int i = 0; i < kParts; ++i) r.part[i] = op(a.part[i], b.part[i]);
        return r;
    }
    friend Lanes operator+(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](Register x, Register y) { return x + y; });
    }
    friend Lanes operator-(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](Register x, Register y) { return x - y; });
    }
    friend Lanes operator*(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](Register x, Register y) { return x * y; });
    }
    friend Lanes operator/(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](Register x, Register y) { return x / y; });
    }
    friend Lanes operator-(const Lanes& a) {
        return zip(a, a, [](Register x, Register) { return -x; });
    }

    friend Lanes min(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](Register x, Register y) { return x < y ? x : y; });
    }
    friend Lanes max(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](Register x, Register y) { return x > y ? x : y; });
    }
    /// In each lane: where a > b, x; else y.
    friend Lanes select_greater(const Lanes& a, const Lanes& b, const Lanes& x, const Lanes& y) {
        Lanes r;
        for (int i = 0; i < kParts; ++i) r.part[i] = a.part[i] > b.part[i] ? x.part[i] : y.part[i];
        return r;
    }
    /// Whether a > b in any lane.
    friend bool any_greater(const Lanes& a, const Lanes& b) {
        bool any = false;
        for (int i = 0; i < kParts; ++i) {
            const auto mask = a.part[i] > b.part[i];
            for (int k = 0; k < kPart; ++k) any |= mask[k] != 0;
        }
        return any;
    }
    friend Lanes sqrt(const Lanes& a) {
        Lanes r;
        for (int i = 0; i < kParts; ++i) r.part[i] = sqrt_register(a.part[i]);
        return r;
    }

private:
    static Register sqrt_register(Register x) {
        if constexpr (sizeof(Register) == 16 && sizeof(T) == 4)
            return (Register)_mm_sqrt_ps((__m128)x);
        else if constexpr (sizeof(Register) == 16 && sizeof(T) == 8)
            return (Register)_mm_sqrt_pd((__m128d)x);
#if defined(__AVX2__)
        else if constexpr (sizeof(Register) == 32 && sizeof(T) == 4)
            return (Register)_mm256_sqrt_ps((__m256)x);
        else if constexpr (sizeof(Register) == 32 && sizeof(T) == 8)
            return (Register)_mm256_sqrt_pd((__m256d)x);
#endif
#if defined(__AVX512F__)
        else if constexpr (sizeof(Register) == 64 && sizeof(T) == 4)
            return (Register)_mm512_maskz_sqrt_ps(0xffff, (__m512)x);
        else if constexpr (sizeof(Register) == 64 && sizeof(T) == 8)
            return (Register)_mm512_maskz_sqrt_pd(0xff, (__m512d)x);
#endif
        else {
            for (int i = 0; i < kPart; ++i) x[i] = std::sqrt(x[i]);
            return x;
        }
    }
};

// The same functions on one number, so that a formula needs no cases.
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline float sqrt(float a) { return std::sqrt(a); }
inline float select_greater(float a, float b, float x, float y) { return a > b ? x : y; }
inline double min(double a, double b) { return a < b ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }
inline double sqrt(double a) { return std::sqrt(a); }
inline double select_greater(double a, double b, double x, double y) { return a > b ? x : y; }
inline bool any_greater(double a, double b) { return a > b; }

/// The number type of N constraints solved side by side: T itself for one.
template <class T, int N>
struct NumberOf {
    using type = Lanes<T, N>;
};
template <class T>
struct NumberOf<T, 1> {
    using type = T;
};
template <class T, int N>
using Number = typename NumberOf<T, N>::type;

/// One lane of a number, and how many it has.
inline double number_of(double x, int) { return x; }
template <int N>
inline double number_of(const Lanes<double, N>& x, int lane) {
    return x.part[lane / Lanes<double, N>::kPart][lane % Lanes<double, N>::kPart];
}
inline void set_number(double& x, int, double value) { x = value; }
template <int N>
inline void set_number(Lanes<double, N>& x, int lane, double value) {
    x.part[lane / Lanes<double, N>::kPart][lane % Lanes<double, N>::kPart] = value;
}
template <class T>
inline constexpr int kLaneCount = 1;
template <class T, int N>
inline constexpr int kLaneCount<Lanes<T, N>> = N;

/// And the other way round: what one number of T's is.
template <class T>
struct ScalarOfLanes {
    using type = T;
};
template <class T, int N>
struct ScalarOfLanes<Lanes<T, N>> {
    using type = T;
};
template <class T>
using ScalarOf = typename ScalarOfLanes<T>::type;

/// Reads N numbers that stand side by side.
template <class T, int N>
inline Number<T, N> load(const T (&from)[N]) {
    if constexpr (N == 1)
        return from[0];
    else
        return Lanes<T, N>::load(from);
}
template <class T, int N>
inline Vector3<Number<T, N>> load_vector(const T (&from)[3][N]) {
    return Vector3<Number<T, N>>(load(from[0]), load(from[1]), load(from[2]));
}
template <class T, int N>
inline void store(T (&to)[N], const Number<T, N>& x) {
    if constexpr (N == 1)
        to[0] = x;
    else
        x.store(to);
}
template <class T, int N>
inline void store_vector(T (&to)[3][N], const Vector3<Number<T, N>>& x) {
    for (int i = 0; i < 3; ++i) store(to[i], x[i]);
}

}  // namespace plumb

namespace Eigen {
template <class T, int N>
struct NumTraits<plumb::Lanes<T, N>> : GenericNumTraits<plumb::Lanes<T, N>> {
    using Real = plumb::Lanes<T, N>;
    using NonInteger = plumb::Lanes<T, N>;
    using Nested = plumb::Lanes<T, N>;
    using Literal = T;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 0,
        ReadCost = 1,
        AddCost = 1,
        MulCost = 1
    };
};
}  // namespace Eigen
