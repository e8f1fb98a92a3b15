// SPDX-License-Identifier: MIT
/// What the conformance suite stands on: a plugin loaded as the host would load it, and a small
/// world of bodies.
///
/// No back-end is linked here: its global symbols would take the place of the plugin's own.
#pragma once

#include <plumb/plugin.h>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

namespace plumb::test {

using V = Eigen::Vector3d;
using Q = Eigen::Quaterniond;

struct Place {
    V x = V::Zero();  ///< [m]
    Q q = Q::Identity();
};
inline Place operator*(const Place& outer, const Place& inner) {
    return {outer.x + outer.q * inner.x, outer.q * inner.q};
}

inline V v(const Vec3& p) { return {p.x, p.y, p.z}; }
inline Vec3 vec(const V& p) { return {p.x(), p.y(), p.z()}; }
Pose pose(const Place& place);

/// A table of a plugin, loaded once a process with RTLD_NOW | RTLD_LOCAL. Fails the process where
/// it is missing.
const PluginTable& plugin(const std::string& name);

/// Names of the plugins that were built, for INSTANTIATE_TEST_SUITE_P.
std::vector<std::string> plugin_names();

/// What a plugin can do with two kinds.
std::uint32_t ability(const std::string& name, ShapeKind a, ShapeKind b);

/// Shapes; memory behind hulls and meshes lives until the end of the process.
Shape plane();
Shape sphere(double radius);
Shape box(double hx, double hy, double hz);
Shape capsule(double radius, double half_height);
Shape cylinder(double radius, double half_height);
Shape cone(double radius, double half_height);
Shape box_hull(double hx, double hy, double hz);
Shape octahedron(double radius);
Shape grid_mesh(double half, int cells);  ///< flat, at y = 0, facing +y
Shape torus_mesh(double major, double minor, int around, int across);  ///< its axis is y
Shape compound(const std::vector<std::pair<Shape, Place>>& parts);

/// Bodies of one collider, and the last answer.
class World {
public:
    explicit World(const std::string& name);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    Status add(std::uint32_t id, const Shape& shape, const Place& place,
               Mobility mobility = Mobility::dynamic, std::uint32_t group = 1,
               std::uint32_t mask = ~0u, const Place& local = {});
    void move(std::uint32_t id, const Place& place);
    void move_raw(std::uint32_t id, const Pose& raw);
    const std::vector<Contact>& detect(double margin, std::uint32_t flags = 0);
    const std::vector<Contact>& last() const { return contacts_; }
    Status status() const { return status_; }
    Proximity& collider() { return *collider_; }
    std::vector<double> sweeps;  ///< [body] or empty [m]

private:
    const PluginTable& table_;
    Proximity* collider_;
    std::vector<Pose> poses_;
    std::vector<Contact> contacts_;
    Status status_{};
};

/// The deepest of some contacts.
const Contact& deepest(const std::vector<Contact>& contacts);

/// Area spanned by the contacts' points on a, seen along the normal of the first [m²].
double spanned_area(const std::vector<Contact>& contacts);

/// Checks what holds for every contact set: signs, units, order, unique features.
void expect_sound(const std::vector<Contact>& contacts, double margin);

class EachPlugin : public ::testing::TestWithParam<std::string> {};

}  // namespace plumb::test

#define PLUMB_FOR_EACH_PLUGIN(Suite)                                                         \
    INSTANTIATE_TEST_SUITE_P(All, Suite, ::testing::ValuesIn(::plumb::test::plugin_names()), \
                             [](const auto& param_info) { return param_info.param; })
