// SPDX-License-Identifier: MIT
/// Finds points near surfaces that deform, which no collider knows: particles of other deformables
/// and of the same one, and the corners of bodies.
#pragma once

#include "contacts/facets.h"
#include "geometry/corner_points.h"
#include "schedule/box_tree.h"
#include "schedule/workers.h"
#include "world/joined_points.h"
#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class SurfaceDetector {
public:
    /// Takes the surfaces and the bodies' corners of a world, until bodies come or go.
    explicit SurfaceDetector(const World& world);

    /// Fills World::surface_contacts with what may touch within dt [s].
    void detect(World& world, Workers& workers, double dt);

private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners;  ///< particles
        std::uint32_t deformable;
        std::array<bool, 3> rim;  ///< [corner] whether the edge across from it is of one triangle
        std::array<bool, 3> on_rim;  ///< [corner] whether it is the end of such an edge
        bool has(std::uint32_t particle) const {
            return corners[0] == particle || corners[1] == particle || corners[2] == particle;
        }
    };
    struct Probe {
        WorldPoint point;
        std::uint32_t deformable = kNoIndex;  ///< of the point; else it is of a body
        double radius = 0;                    ///< [m]
    };
    /// How a triangle faces now.
    struct Face {
        Vector3d normal;  ///< twice its area long [m²]
        double size;      ///< twice its area [m²]
    };
    struct Near {
        std::uint32_t triangle;
        std::array<double, 3> weights;
        Vector3d apart;          ///< from the triangle to the point [m]
        double distance;         ///< [m]
        double facing;           ///< cosine between that and the triangle's normal
        std::int8_t side = 0;    ///< of an open surface on which the point belongs
        bool is_beyond = false;  ///< it is on the other one
    };
    /// As of DeformableSpec.
    struct Filter {
        std::uint32_t group, mask;
    };
    /// What the step before knew of a probe.
    struct Known {
        std::uint32_t first = 0, last = 0;  ///< in before_
    };
    /// Where a probe is, and the box that it may be in within the step.
    struct Place {
        Vector3d at, low, high;
    };
    /// A triangle that a probe may come near, as the Sight of it says.
    struct Candidate {
        std::uint32_t triangle;
        float square;
        bool may_face;
    };
    /// The candidate of a surface whose box is nearest, and beyond what square none counts that is
    /// not faced [m²].
    struct Closest {
        float square, limit;
        Near near;
    };
    /// What a worker finds, probe by probe.
    struct Search {
        std::vector<SurfaceContact> found;
        std::vector<Candidate> candidates;
        std::vector<Closest> closest;    ///< [deformable]
        std::vector<std::uint32_t> met;  ///< triangles that count
        std::vector<Near> near;
        std::uint32_t next_known = 0;  ///< in before_
    };

    void add_probes(const World& world);
    void build_tree(const World& world);
    void find_rims(const Deformable& deformable, std::size_t first);
    void follow(const World& world, Workers& workers, double dt);
    void look(const World& world, const Probe& probe, double dt, Search& search) const;
    void find_near(const World& world, const Probe& probe, double dt, Search& search) const;
    void find_candidates(const World& world, const Probe& probe, const Place& place,
                         Search& search) const;
    Near near_point(const World& world, std::uint32_t triangle, const Vector3d& place) const;
    Known known_of(const Probe& probe, std::uint32_t& next) const;
    void find_side(const World& world, const Probe& probe, const Known& known, Near& near,
                   double dt) const;
    std::int8_t known_side(const World& world, const Known& known, const Near& near,
                           double most) const;
    bool is_at_rim(const World& world, const Near& near, double most) const;
    bool meets(const World& world, const Probe& probe, const Place& place,
               std::uint32_t triangle) const;
    bool is_behind(const World& world, const Probe& probe, const Triangle& triangle) const;
    bool may_meet(const World& world, const Probe& probe, const Triangle& triangle) const;
    double speed_of(const World& world, const WorldPoint& point) const;  ///< [m/s]
    void keep_nearest(const World& world, const Probe& probe, Search& search) const;
    /// Whether it became a contact.
    bool add(const World& world, const Probe& probe, const Near& near,
             std::vector<SurfaceContact>& found) const;

    std::vector<Triangle> triangles_;
    std::vector<Probe> probes_;
    std::vector<std::uint8_t> closed_;  ///< [deformable] whether its surface has an inside
    std::vector<double> thickness_;     ///< [deformable] of solids [m]
    std::vector<Filter> filters_;       ///< [deformable]
    JoinedPoints joined_;
    std::vector<double> speed_;  ///< [particle] [m/s]
    BoxTree tree_;
    std::vector<Vector3d> low_, high_;    ///< [triangle]
    std::vector<Face> faces_;             ///< [triangle]
    Facets facets_;                       ///< [place in the tree]
    std::vector<Search> searches_;        ///< [worker]
    std::vector<SurfaceContact> before_;  ///< of the step before, in the order of the probes
};

}  // namespace plumb
