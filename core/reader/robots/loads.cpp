// SPDX-License-Identifier: MIT
#include "reader/robots/loads.h"

#include <algorithm>
#include <cmath>

namespace plumb::reader {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sums over stiffly tied bodies, about the world's origin.
struct Load {
    double mass = 0;                     // [kg]
    Vector3d first = Vector3d::Zero();   // Σ m c [kg m]
    Matrix3d second = Matrix3d::Zero();  // tensor of inertia [kg m²]

    friend Load operator+(const Load& a, const Load& b) {
        return {a.mass + b.mass, a.first + b.first, a.second + b.second};
    }
    friend Load operator-(const Load& a, const Load& b) {
        return {a.mass - b.mass, a.first - b.first, a.second - b.second};
    }

    /// Moment of inertia about the axis through p along the unit vector a.
    double about(const Vector3d& p, const Vector3d& a) const {
        return a.dot(second * a) - 2 * first.cross(a).dot(p.cross(a)) +
               mass * p.cross(a).squaredNorm();
    }
};

/// A body in the world.
struct PlacedMass {
    double mass;      // [kg]
    Vector3d centre;  // [m]
    Matrix3d tensor;  // about the centre [kg m²]
};

PlacedMass placed(const LinkGroup& group, const MovingMass& mass) {
    const Placement frame = group.world * mass.frame;
    const Matrix3d r = frame.rotation.toRotationMatrix();
    return {mass.mass, frame.position, r * mass.moments.asDiagonal() * r.transpose()};
}

Load load_of(const PlacedMass& b) {
    const Vector3d& c = b.centre;
    return {b.mass, b.mass * c,
            b.tensor + b.mass * (c.squaredNorm() * Matrix3d::Identity() - c * c.transpose())};
}

/// Speed along or about a joint's axis that a unit impulse gives a body [1/kg], [1/(kg m²)].
double response_of(const PlacedMass& b, const Vector3d& p, const Vector3d& a, bool slides) {
    const Vector3d turn = slides ? (p - b.centre).cross(a) : a;
    return (slides ? 1 / b.mass : 0) + turn.dot(b.tensor.inverse() * turn);
}

/// Whether a group hangs on nothing.
bool is_free(const LinkGroup& group) {
    return !group.joint || group.joint->kind == RobotJointKind::floating;
}

}  // namespace

std::vector<double> frequency_factors(const std::vector<LinkGroup>& groups,
                                      const std::vector<std::optional<MovingMass>>& masses) {
    std::vector<std::optional<PlacedMass>> bodies(groups.size());
    std::vector<Load> branch(groups.size());  // a group and all that hangs on it
    for (std::size_t i = groups.size(); i-- > 0;) {
        if (masses[i]) bodies[i] = placed(groups[i], *masses[i]);
        if (bodies[i]) branch[i] = branch[i] + load_of(*bodies[i]);
        if (!is_free(groups[i])) branch[groups[i].parent] = branch[groups[i].parent] + branch[i];
    }

    std::vector<double> factors(groups.size(), 1.0);
    std::vector<std::size_t> root(groups.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        root[i] = is_free(groups[i]) ? i : root[groups[i].parent];
        if (is_free(groups[i]) || !groups[i].joint->has_coordinate()) continue;
        const Vector3d p = groups[i].world.position;
        const Vector3d a = groups[i].world.rotation * axis_of(*groups[i].joint);
        const bool slides = groups[i].joint->is_slider();
        const auto inertia = [&](const Load& load) {
            return slides ? load.mass : load.about(p, a);
        };
        double load = inertia(branch[i]);
        if (bodies[root[i]]) load = std::max(load, inertia(branch[root[i]] - branch[i]));
        double response = response_of(*bodies[i], p, a, slides);
        if (const auto& parent = bodies[groups[i].parent])
            response += response_of(*parent, p, a, slides);
        factors[i] = std::sqrt(load * response);
    }
    return factors;
}

}  // namespace plumb::reader
