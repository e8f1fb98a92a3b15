// SPDX-License-Identifier: MIT
/// The contact sets of two colliders for the same bodies at the same poses, measured against each
/// other pair by pair.
///
/// Compared are: whether both report the pair, the deepest gaps, the normals there, and the patch
/// that the points span. The number of points is never compared: a face may be held by three
/// corners or by eight.
///
/// Normals more than the tolerance apart are left out of the count, as ambiguous, where they are
/// two axes about equally good: their gaps along their own normals (of the true shapes) differ by
/// less than L/1000, and along the normal half-way between them the gap is less than along both.
/// The second condition tells two axes from one axis and an error: around the one best axis the
/// gap falls off to all sides, so half-way towards a wrong normal it is between both.
#pragma once

#include "measure/contact_patch.h"
#include "measure/contact_tolerances.h"
#include "geometry/shape_support.h"
#include "measure/spread.h"

#include <plumb/contact_set.h>

#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

/// What a comparison knows of a body.
struct ComparedBody {
    const Shape* shape = nullptr;  ///< nullptr: none, it touches nothing
    Pose local{};                  ///< shape frame → body frame
};

/// Two answers to one question; both sorted by (a, b), and of bodies and numbers that exist.
struct ContactAnswers {
    std::span<const Contact> first, second;
    std::span<const Pose> poses;  ///< [body]
    double margin = 0;            ///< [m]
    std::uint64_t step = 0;
    double time = 0;  ///< [s]
};

/// What two answers may differ in.
enum class Aspect : std::uint32_t { pair, gap, deep_gap, normal, deep_normal, extent };
inline constexpr std::size_t kAspectCount = 6;

/// Errors of one kind, and how many of them are within their pair's tolerance.
struct AspectTotals {
    std::uint64_t within = 0;
    Spread errors;  ///< gaps in L (meshes: in sagittas); normals in degrees; extents as deficit
    double share() const {
        const auto count = static_cast<double>(errors.count());
        return count > 0 ? static_cast<double>(within) / count : 1;
    }
};

struct ComparisonTotals {
    std::uint64_t agreed = 0, only_first = 0, only_second = 0;  ///< pairs of bodies
    std::uint64_t grazing = 0;    ///< pairs of one side alone, within a band: left out
    std::uint64_t apart = 0;      ///< pairs of one side alone that do not overlap: left out
    std::uint64_t ambiguous = 0;  ///< pairs whose normals are two equally good axes
    AspectTotals gap, deep_gap, normal, deep_normal, extent;

    std::uint64_t compared() const { return agreed + only_first + only_second; }
    double pair_share() const;
    /// Whether all judged aspects keep their shares; deep normals are not judged.
    bool agrees() const;
};

/// One pair of bodies at one moment on which the answers differ, with both answers whole.
struct Disagreement {
    Aspect aspect;
    double error;      ///< [m], [degrees], or the extent's deficit
    double tolerance;  ///< of the same kind
    std::uint32_t a, b;
    std::uint64_t step;
    double time;  ///< [s]
    Pose pose_a, pose_b;
    std::vector<Contact> first, second;
    double severity() const { return error / tolerance; }
};

class ContactComparison {
public:
    static constexpr std::size_t kKept = 5;  ///< worst disagreements of each aspect

    ContactComparison(std::vector<ComparedBody> bodies, const ComparisonKind& kind);

    void add(const ContactAnswers& answers);

    const ComparisonTotals& convex() const { return convex_; }
    const ComparisonTotals& meshes() const { return meshes_; }  ///< pairs with a mesh
    bool agrees() const { return convex_.agrees() && meshes_.agrees(); }

    /// The worst disagreements, aspect by aspect, the worst first; each pair of bodies once an
    /// aspect.
    std::vector<Disagreement> worst() const;

private:
    struct Pair;

    PairTolerances tolerances_of(const Pair& pair) const;
    void compare(const Pair& pair);
    void missing(const Pair& pair);
    void compare_gaps(const Pair& pair);
    void compare_normals(const Pair& pair);
    void compare_extents(const Pair& pair);
    bool equal_axes(const Pair& pair, const Vector3d& n, const Vector3d& m) const;
    void keep(const Pair& pair, Aspect aspect, double error, double tolerance);

    std::vector<ComparedBody> bodies_;
    std::vector<double> extent_, sagitta_, edge_;  ///< [body], [m]
    std::vector<bool> mesh_;                       ///< [body]
    ComparisonKind kind_;
    ComparisonTotals convex_, meshes_;
    std::vector<Disagreement> worst_[kAspectCount];
};

}  // namespace plumb
