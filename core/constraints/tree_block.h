// SPDX-License-Identifier: MIT
/// What a body of a joint tree weighs with all that hangs on it, and how a joint passes that on to
/// its parent: block LDLᵀ of [M −Jᵀ; J s], leaves first.
///
///   M̂ b   mass of a body and its share of the right-hand side, M̂ Δv = b + Jᵀ λ
///   c p   child and parent of a joint
///   d     what the joint's rows ask for: J_c Δv_c + J_p Δv_p + s λ = d
///
/// Eliminating the child leaves S λ = d − J_p Δv_p − J_c M̂_c⁻¹ b_c with S = J_c M̂_c⁻¹ J_cᵀ + s, and
/// the parent gains J_pᵀ S⁻¹ J_p. A ball joint is eliminated in coordinates of its own, the
/// velocity u of its point and ω, where J_c = [E 0]: what is left of the child is its
/// articulated mass at the point, the Schur complement S⁻¹.
#pragma once

#include "constraints/joint_rows.h"
#include "constraints/tree_stiffness.h"
#include "math/dense.h"
#include "math/symmetric.h"

namespace plumb {

/// M̂ = [a b; bᵀ d] over (v, ω), and the right-hand side (f, t).
template <class T>
struct BodyBlock {
    Symmetric3<T> a, d;
    Vector3<T> b[3];  ///< columns
    Vector3<T> f, t;
};

/// What the bodies that hang on a body add to it: mass and right-hand side, and how their joints'
/// impulses stiffen its turn.
template <class T>
struct TreeShare {
    BodyBlock<T> block;
    Symmetric3<T> stiffness;

    static TreeShare none() {
        TreeShare x;
        const Symmetric3<T> zero{T(0), T(0), T(0), T(0), T(0), T(0)};
        x.block.a = x.block.d = x.stiffness = zero;
        for (Vector3<T>& column : x.block.b) column = Vector3<T>(T(0), T(0), T(0));
        x.block.f = x.block.t = x.block.b[0];
        return x;
    }
};

/// The same as numbers in a row.
inline constexpr int kShareNumbers = 36;
template <class T>
inline TreeShare<T> share_of(const T (&x)[kShareNumbers]) {
    TreeShare<T> s;
    s.block.a = {x[0], x[1], x[2], x[3], x[4], x[5]};
    s.block.d = {x[6], x[7], x[8], x[9], x[10], x[11]};
    s.stiffness = {x[12], x[13], x[14], x[15], x[16], x[17]};
    for (int j = 0; j < 3; ++j)
        s.block.b[j] = Vector3<T>(x[18 + 3 * j], x[19 + 3 * j], x[20 + 3 * j]);
    s.block.f = Vector3<T>(x[27], x[28], x[29]), s.block.t = Vector3<T>(x[30], x[31], x[32]);
    return s;
}
template <class T>
inline void put_share(const TreeShare<T>& s, T (&x)[kShareNumbers]) {
    const Symmetric3<T>* parts[3] = {&s.block.a, &s.block.d, &s.stiffness};
    for (int k = 0; k < 3; ++k) {
        const Symmetric3<T>& m = *parts[k];
        const T numbers[6] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
        for (int i = 0; i < 6; ++i) x[6 * k + i] = numbers[i];
    }
    for (int i = 0; i < 9; ++i) x[18 + i] = s.block.b[i / 3][i % 3];
    for (int i = 0; i < 3; ++i) x[27 + i] = s.block.f[i], x[30 + i] = s.block.t[i];
    for (int i = 33; i < kShareNumbers; ++i) x[i] = T(0);
}

/// A body with what hangs on it. `inertia`: world frame; `stiffness`: by the joint that it hangs by
/// itself; `own`: what the solver has changed of its velocity, whose momentum is asked back, so
/// that the impulses are found anew.
template <class T>
inline void add_body(TreeShare<T>& share, const T& mass, const Symmetric3<T>& inertia,
                     const Symmetric3<T>& stiffness, const Velocity<T>& own, bool balance) {
    BodyBlock<T>& block = share.block;
    block.a = block.a + Symmetric3<T>{mass, mass, mass, T(0), T(0), T(0)};
    block.d = block.d + inertia;
    if (!balance) return;
    block.d = block.d + safe_stiffness<T>(share.stiffness + stiffness, inertia);
    block.f -= own.v * mass;
    block.t -= inertia * own.w;
}

/// Column j of m [r]ₓ. Products with the zeros of [r]ₓ are left out; compilers may not.
template <class T>
inline Vector3<T> times_cross(const Symmetric3<T>& m, const Vector3<T>& r, int j) {
    if (j == 0)
        return Vector3<T>(m.xy * r[2] - m.xz * r[1], m.yy * r[2] - m.yz * r[1],
                          m.yz * r[2] - m.zz * r[1]);
    if (j == 1)
        return Vector3<T>(m.xz * r[0] - m.xx * r[2], m.yz * r[0] - m.xy * r[2],
                          m.zz * r[0] - m.xz * r[2]);
    return Vector3<T>(m.xx * r[1] - m.xy * r[0], m.xy * r[1] - m.yy * r[0],
                      m.xz * r[1] - m.yz * r[0]);
}

/// An articulated mass at the point of arm r, and an impulse there, become part of a body.
template <class T>
inline void add_at_point(BodyBlock<T>& body, const Symmetric3<T>& mass, const Vector3<T>& r,
                         const Vector3<T>& impulse) {
    Vector3<T> turned[3];  // columns of [r]ᵀ m [r]
    body.a = body.a + mass;
    for (int j = 0; j < 3; ++j) {
        const Vector3<T> column = times_cross<T>(mass, r, j);
        body.b[j] -= column;
        turned[j] = cross(column, r);
    }
    body.d = body.d + Symmetric3<T>{turned[0][0], turned[1][1], turned[2][2],
                                    turned[1][0], turned[2][0], turned[2][1]};
    body.f += impulse;
    body.t += cross(r, impulse);
}

/// A symmetric 3 × 3 matrix as L D Lᵀ.
template <class T>
struct Factors3 {
    T l10, l20, l21, i0, i1, i2;  ///< i: 1/D

    explicit Factors3(const Symmetric3<T>& k) {
        i0 = T(1) / k.xx;
        l10 = k.xy * i0, l20 = k.xz * i0;
        i1 = T(1) / (k.yy - l10 * k.xy);
        const T off = k.yz - l20 * k.xy;
        l21 = off * i1;
        i2 = T(1) / ((k.zz - l20 * k.xz) - l21 * off);
    }
    Factors3() = default;

    /// L⁻¹ x.
    Vector3<T> lower(const Vector3<T>& x) const {
        const T y = x[1] - l10 * x[0];
        return Vector3<T>(x[0], y, (x[2] - l20 * x[0]) - l21 * y);
    }
    /// (L D Lᵀ)⁻¹ x.
    Vector3<T> solve(const Vector3<T>& x) const {
        const Vector3<T> y = lower(x);
        const T x2 = y[2] * i2;
        const T x1 = y[1] * i1 - l21 * x2;
        return Vector3<T>((y[0] * i0 - l10 * x1) - l20 * x2, x1, x2);
    }
};

/// A body on a ball joint, eliminated: S⁻¹ u = λ + free.
template <class T>
struct BallElimination {
    Symmetric3<T> mass;    ///< S⁻¹: articulated mass at the point [kg]
    Vector3<T> free;       ///< and the impulse there without the joint's own [N s]
    Vector3<T> across[3];  /// columns: what ω has to do with u
    Factors3<T> turn;      ///< of ω alone
    Vector3<T> torque;     ///< right-hand side of ω about the point [N m s]
};

template <class T>
inline BallElimination<T> eliminate_ball(const BodyBlock<T>& body, const Vector3<T>& r) {
    BallElimination<T> e;
    Vector3<T> own[3], moved[3];  // columns of [r]ᵀB, rows of (B + A[r])ᵀ[r]
    for (int j = 0; j < 3; ++j) {
        e.across[j] = times_cross<T>(body.a, r, j) + body.b[j];
        own[j] = cross(body.b[j], r), moved[j] = cross(e.across[j], r);
    }
    const auto entry = [&](int i, int j) { return own[j][i] + moved[i][j]; };
    e.turn = Factors3<T>(body.d + Symmetric3<T>{entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1),
                                                entry(0, 2), entry(1, 2)});
    e.torque = body.t - cross(r, body.f);
    Vector3<T> z[3], scaled[3];
    for (int i = 0; i < 3; ++i) {
        z[i] = e.turn.lower(Vector3<T>(e.across[0][i], e.across[1][i], e.across[2][i]));
        scaled[i] = Vector3<T>(z[i][0] * e.turn.i0, z[i][1] * e.turn.i1, z[i][2] * e.turn.i2);
    }
    e.mass =
        body.a + Symmetric3<T>{-dot(z[0], scaled[0]), -dot(z[1], scaled[1]), -dot(z[2], scaled[2]),
                               -dot(z[0], scaled[1]), -dot(z[0], scaled[2]), -dot(z[1], scaled[2])};
    const Vector3<T> y = e.turn.lower(e.torque);
    e.free = body.f - Vector3<T>(dot(scaled[0], y), dot(scaled[1], y), dot(scaled[2], y));
    return e;
}

/// The child's velocity from that of the joint's point.
template <class T>
inline Velocity<T> substitute_ball(const BallElimination<T>& e, const Vector3<T>& r,
                                   const Vector3<T>& u) {
    const Vector3<T> w = e.turn.solve(
        e.torque - Vector3<T>(dot(e.across[0], u), dot(e.across[1], u), dot(e.across[2], u)));
    return {u - cross(w, r), w};
}

/// Of one joint: what it takes away and what it drives are six at the most; a distance joint, which
/// takes away one, has two of tension besides.
inline constexpr int kMostTreeRows = 6;

/// A body on a joint of any kind, eliminated. Only rows that are taken away are here.
template <class T>
struct RowsElimination {
    static constexpr int R = kMostTreeRows;
    int n = 0;
    T child[R][6], parent[R][6];  ///< J_c, J_p [row][v ω]
    T softness[R], wish[R];       ///< s, d
    T own[6][6], free[6];         ///< M̂_c = L D Lᵀ as factors, and L⁻¹ b_c
    T moved[R][6];                ///< L⁻¹ J_cᵀ [row]
    T response[R][R];             ///< factors of S
    T lambda[R];
};

template <class T>
inline void as_matrix(T (&m)[6][6], T (&rhs)[6], const BodyBlock<T>& body) {
    const Symmetric3<T>&a = body.a, &d = body.d;
    const T upper[3][3] = {{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}};
    const T lower[3][3] = {{d.xx, d.xy, d.xz}, {d.xy, d.yy, d.yz}, {d.xz, d.yz, d.zz}};
    for (int i = 0; i < 3; ++i) {
        rhs[i] = body.f[i], rhs[3 + i] = body.t[i];
        for (int j = 0; j < 3; ++j) {
            m[i][j] = upper[i][j], m[3 + i][3 + j] = lower[i][j];
            m[3 + i][j] = m[j][3 + i] = body.b[i][j];
        }
    }
}

/// Adds one row: `along` on v_a and −v_b, `on_a` on ω_a, −`on_b` on ω_b. `sign` is 1 where the
/// child is body a, else −1.
template <class T>
inline void append_row(RowsElimination<T>& e, const Vector3<T>& along, const Vector3<T>& on_a,
                       const Vector3<T>& on_b, T sign, T softness, T wish) {
    const Vector3<T>&on_child = sign > T(0) ? on_a : on_b, &on_parent = sign > T(0) ? on_b : on_a;
    for (int i = 0; i < 3; ++i) {
        e.child[e.n][i] = sign * along[i], e.child[e.n][3 + i] = sign * on_child[i];
        e.parent[e.n][i] = -sign * along[i], e.parent[e.n][3 + i] = -sign * on_parent[i];
    }
    e.softness[e.n] = softness, e.wish[e.n] = wish;
    ++e.n;
}

/// What a joint takes away, as rows.
template <class T>
inline void take_rows(RowsElimination<T>& e, const JointRows<T>& rows,
                      const JointGeometry<T>& joint, T sign, T inverse_h) {
    e.n = 0;
    for (int k = 0; k < 6; ++k) {
        if (!(joint.lock[k] > T(0))) continue;
        const Vector3<T> along = k < 3 ? rows.e[k] : Vector3<T>(Vector3<T>::Zero());
        append_row<T>(e, along, rows.g_a[k], rows.g_b[k], sign, joint.softness[k],
                      -rows.c[k] * inverse_h);
    }
}

/// x ← L⁻¹ x by the factors of an L D Lᵀ; returns D⁻¹ x in `scaled`.
template <class T, int N>
inline void solve_half(const T (&factors)[N][N], int n, T (&x)[N], T (&scaled)[N]) {
    solve_lower(factors, n, x);
    for (int i = 0; i < n; ++i) scaled[i] = x[i] * factors[i][i];
}

template <class T>
inline void eliminate_rows(RowsElimination<T>& e, const BodyBlock<T>& body) {
    as_matrix(e.own, e.free, body);
    factor_ldlt(e.own, 6);
    T scaled[6];
    solve_lower(e.own, 6, e.free);
    for (int k = 0; k < e.n; ++k) {
        for (int i = 0; i < 6; ++i) e.moved[k][i] = e.child[k][i];
        solve_half(e.own, 6, e.moved[k], scaled);
        for (int l = 0; l <= k; ++l) {
            T sum = k == l ? e.softness[k] : T(0);
            for (int i = 0; i < 6; ++i) sum += scaled[i] * e.moved[l][i];
            e.response[k][l] = sum;
        }
        for (int i = 0; i < 6; ++i) e.wish[k] -= scaled[i] * e.free[i];
    }
    factor_ldlt(e.response, e.n);
}

/// J_pᵀ S⁻¹ J_p and J_pᵀ S⁻¹ d become part of the parent. With S = L D Lᵀ and W = L⁻¹ J_p that is
/// Wᵀ D⁻¹ W and Wᵀ D⁻¹ L⁻¹ d.
template <class T>
inline void add_rows(BodyBlock<T>& parent, const RowsElimination<T>& e) {
    constexpr int R = kMostTreeRows;
    T half[6][R], scaled[6][R], wish[R];  // W and D⁻¹ W [v ω][row]
    for (int k = 0; k < e.n; ++k) wish[k] = e.wish[k];
    solve_lower(e.response, e.n, wish);
    for (int j = 0; j < 6; ++j) {
        for (int k = 0; k < e.n; ++k) half[j][k] = e.parent[k][j];
        solve_half(e.response, e.n, half[j], scaled[j]);
    }
    const auto product = [&](const T(&x)[R], const T(&y)[R]) {
        T sum = T(0);
        for (int k = 0; k < e.n; ++k) sum += x[k] * y[k];
        return sum;
    };
    const auto entry = [&](int i, int j) { return product(half[i], scaled[j]); };
    const auto corner = [&](int i) {
        return Symmetric3<T>{entry(i, i),     entry(i + 1, i + 1), entry(i + 2, i + 2),
                             entry(i, i + 1), entry(i, i + 2),     entry(i + 1, i + 2)};
    };
    parent.a = parent.a + corner(0);
    parent.d = parent.d + corner(3);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) parent.b[j][i] += entry(i, 3 + j);
        parent.f[i] += product(scaled[i], wish), parent.t[i] += product(scaled[3 + i], wish);
    }
}

/// The child's velocity from its parent's; leaves λ in `e`.
template <class T>
inline Velocity<T> substitute_rows(RowsElimination<T>& e, const Velocity<T>& parent) {
    for (int k = 0; k < e.n; ++k) {
        e.lambda[k] = e.wish[k];
        for (int i = 0; i < 3; ++i)
            e.lambda[k] -= e.parent[k][i] * parent.v[i] + e.parent[k][3 + i] * parent.w[i];
    }
    solve_factored(e.response, e.n, e.lambda);
    T x[6];
    for (int i = 0; i < 6; ++i) {
        x[i] = e.free[i];
        for (int k = 0; k < e.n; ++k) x[i] += e.moved[k][i] * e.lambda[k];
    }
    solve_upper(e.own, 6, x);
    return {Vector3<T>(x[0], x[1], x[2]), Vector3<T>(x[3], x[4], x[5])};
}

/// A root that hangs by nothing: M̂ Δv = b.
template <class T>
inline Velocity<T> solve_block(const BodyBlock<T>& body) {
    T m[6][6], x[6];
    as_matrix(m, x, body);
    factor_ldlt(m, 6);
    solve_factored(m, 6, x);
    return {Vector3<T>(x[0], x[1], x[2]), Vector3<T>(x[3], x[4], x[5])};
}

}  // namespace plumb
