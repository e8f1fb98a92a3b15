// SPDX-License-Identifier: MIT
/// FCL's own passage through libccd: GJK while parts are apart, its expanding polytope when they
/// overlap. The steps are called one by one, in place of `fcl::distance`, for five reasons:
///
///  * FCL's assertions, which in the installed library end the process in configurations that are
///    merely degenerate, are exceptions here;
///  * support points come from the true shapes, with no object to build for each question;
///  * questions are asked at unit size about the origin, since FCL's tolerances are absolute;
///  * round shapes are asked about by their cores (a point, a segment), so that they overlap only
///    when the cores do;
///  * the polytope's loop has no end of its own where rounding keeps it going: here it has.
#include "fcl/closest.h"

#include "manifold/support.h"

#include <fcl/geometry/shape/convex.h>

#include <cassert>
#include <stdexcept>

namespace plumb::by_fcl {
[[noreturn]] static void refuse() { throw std::logic_error("FCL's assertion does not hold"); }
}  // namespace plumb::by_fcl

// All that FCL's header needs stands above, so that nothing in it defines the macro again.
#undef NDEBUG
#undef assert
#define assert(holds) ((holds) ? static_cast<void>(0) : ::plumb::by_fcl::refuse())
#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd.h>
#undef assert

namespace plumb::by_fcl {
namespace {

namespace steps = fcl::detail::libccd_extension;

constexpr int kMostSupports = 400;  ///< of one part, in one question

/// One part in a question.
struct Asked {
    const Part& part;
    const double radius;  ///< of the skin that is part of the question [m]
    const Vec3 origin;    ///< of the question, and
    const double unit;    ///< its unit of length, in the world [m]
    int calls = 0;

    bool exhausted() const { return calls > kMostSupports; }
};

ccd_vec3_t to_ccd(Vec3 v) { return {{v.x, v.y, v.z}}; }
Vec3 from_ccd(const ccd_vec3_t& v) { return {v.v[0], v.v[1], v.v[2]}; }

/// libccd's support function. Past the limit all points coincide, which ends every loop.
void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    Asked& asked = *static_cast<Asked*>(const_cast<void*>(object));
    const Vec3 d = from_ccd(*direction);
    if (++asked.calls > kMostSupports) {
        *point = to_ccd({0, 0, 0});
        return;
    }
    Vec3 p = core_support(asked.part, d);
    if (asked.radius > 0) p = p + asked.radius * unit_or(d, {0, 1, 0});
    *point = to_ccd(1 / asked.unit * (p - asked.origin));
}

Vec3 middle_of(const Part& part) {
    return to_outer(part.world, 0.5 * (part.own_bounds.low + part.own_bounds.high));
}

/// From the middle of a towards that of b, which is the origin.
void first_direction(const void* a, const void*, ccd_vec3_t* direction) {
    const Asked& asked = *static_cast<const Asked*>(a);
    *direction =
        to_ccd(unit_or(1 / asked.unit * (asked.origin - middle_of(asked.part)), {1, 0, 0}));
}

ccd_t question() {
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = support;
    ccd.first_dir = first_direction;
    ccd.max_iterations = 100;
    ccd.dist_tolerance = 1e-9;
    ccd.epa_tolerance = 1e-6;
    return ccd;
}

/// The polytope of one question.
struct Polytope {
    Polytope() { ccdPtInit(&all); }
    Polytope(const Polytope&) = delete;
    Polytope& operator=(const Polytope&) = delete;
    ~Polytope() { ccdPtDestroy(&all); }
    ccd_pt_t all;
};

/// Difference a − b of the nearest point of the surface: its direction, and how far it lies.
struct Way {
    Vec3 direction;  ///< out of the polytope where it holds the origin
    Vec3 on_a, on_b;
};

/// How to part what overlaps. False where the polytope came to nothing.
bool way_out(Way& way, Asked& a, Asked& b, const ccd_t& ccd, ccd_simplex_t& simplex) {
    Polytope polytope;
    ccd_pt_el_t* nearest = nullptr;
    if (steps::__ccdEPA(&a, &b, &ccd, &simplex, &polytope.all, &nearest) != 0 || !nearest)
        return false;
    if (a.exhausted() || b.exhausted()) return false;
    ccd_vec3_t on_a, on_b;
    steps::penEPAPosClosest(nearest, &on_a, &on_b);
    way = {from_ccd(nearest->witness), from_ccd(on_a), from_ccd(on_b)};
    if (nearest->type == CCD_PT_FACE)
        way.direction = from_ccd(steps::faceNormalPointingOutward(
            &polytope.all, reinterpret_cast<ccd_pt_face_t*>(nearest)));
    return true;
}

bool ask_cores(Witness& witness, const Part& part_a, const Part& part_b, bool with_skins) {
    const double ra = core_radius(part_a), rb = core_radius(part_b);
    const double size = size_of(part_a) + size_of(part_b);
    const Vec3 origin = middle_of(part_b);
    Asked a{part_a, with_skins ? ra : 0, origin, size},
        b{part_b, with_skins ? rb : 0, origin, size};
    const ccd_t ccd = question();
    ccd_simplex_t simplex;
    Way way;
    double side = 1;
    if (steps::__ccdGJK(&a, &b, &ccd, &simplex) == 0) {
        if (!way_out(way, a, b, ccd, simplex)) return false;
        side = -1;
    } else {
        ccd_vec3_t on_a = {}, on_b = {};
        const double distance = steps::_ccdDist(&a, &b, &ccd, &simplex, &on_a, &on_b);
        if (a.exhausted() || b.exhausted() || !(distance > 1e-9)) return false;
        way = {from_ccd(on_a) - from_ccd(on_b), from_ccd(on_a), from_ccd(on_b)};
    }
    const double length = norm(way.direction);
    if (!(length > 1e-14)) return false;
    const Vec3 n = (side / length) * way.direction;
    const double skin_a = with_skins ? 0 : ra, skin_b = with_skins ? 0 : rb;
    const Vec3 middle = origin + 0.5 * size * (way.on_a + way.on_b);
    witness = {n, middle + 0.5 * (skin_b - skin_a) * n,
               size * dot(n, way.on_a - way.on_b) - skin_a - skin_b};
    return finite(n) && finite(witness.point);
}

}  // namespace

Answer signed_distance(Witness& witness, const Part& a, const Part& b) {
    try {
        if (ask_cores(witness, a, b, false)) return Answer::found;
        // Cores that touch name no direction; with their skins they overlap, which does.
        const bool skins = core_radius(a) > 0 || core_radius(b) > 0;
        if (skins && ask_cores(witness, a, b, true)) return Answer::found;
    } catch (const std::exception&) {
        // FCL's way of giving up
    }
    return Answer::silent;
}

}  // namespace plumb::by_fcl
