// SPDX-License-Identifier: MIT
#include "harness.h"

#include <dlfcn.h>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <sstream>
#include <tuple>

namespace plumb::test {
namespace {

std::string plugin_folder() {
    const char* path = std::getenv("PLUMB_PLUGIN_PATH");
    return path && *path ? path : PLUMB_TEST_PLUGIN_DIR;
}

const PluginTable* load(const std::string& name) {
    const std::string file = plugin_folder() + "/plumb_collider_" + name + ".so";
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        std::cerr << "cannot load " << file << ": " << dlerror() << '\n';
        std::abort();
    }
    const auto entry = reinterpret_cast<PluginEntry>(dlsym(library, kPluginSymbol));
    if (!entry) {
        std::cerr << file << " has no " << kPluginSymbol << '\n';
        std::abort();
    }
    return entry();
}

struct Memory {
    std::vector<Vec3> vertices, normals;
    std::vector<std::uint32_t> faces;
    std::vector<ShapePart> parts;
};

/// Memory behind shapes, never moved.
Memory& new_memory() {
    static std::deque<Memory> all;
    return all.emplace_back();
}

Shape with_faces(ShapeKind kind, Memory& m, std::uint32_t face_count, int stride_of_mesh) {
    for (std::size_t i = 0; i < m.faces.size();) {
        const std::uint32_t corners = stride_of_mesh ? 3 : m.faces[i++];
        const V a = v(m.vertices[m.faces[i]]), b = v(m.vertices[m.faces[i + 1]]),
                c = v(m.vertices[m.faces[i + 2]]);
        m.normals.push_back(vec((b - a).cross(c - a).normalized()));
        i += corners;
    }
    Shape s{};
    s.kind = kind;
    s.vertices = m.vertices.data();
    s.vertex_count = static_cast<std::uint32_t>(m.vertices.size());
    s.faces = m.faces.data();
    s.face_count = face_count;
    s.face_normals = m.normals.data();
    return s;
}

struct Collected {
    std::vector<Contact>* contacts;
    std::vector<std::vector<Contact>> blocks;
};

Contact* grow(void* ctx, std::uint32_t count) {
    return static_cast<Collected*>(ctx)->blocks.emplace_back(count).data();
}

}  // namespace

Pose pose(const Place& place) {
    return {vec(place.x), {place.q.x(), place.q.y(), place.q.z(), place.q.w()}};
}

const PluginTable& plugin(const std::string& name) {
    static std::map<std::string, const PluginTable*> loaded;
    const PluginTable*& table = loaded[name];
    if (!table) table = load(name);
    return *table;
}

std::vector<std::string> plugin_names() {
    std::vector<std::string> names;
    std::istringstream list(PLUMB_TEST_PLUGINS);
    for (std::string name; std::getline(list, name, ',');) names.push_back(name);
    return names;
}

std::uint32_t ability(const std::string& name, ShapeKind a, ShapeKind b) {
    return plugin(name).pairs[static_cast<std::uint32_t>(a)][static_cast<std::uint32_t>(b)];
}

Shape plane() {
    Shape s{};
    s.kind = ShapeKind::plane;
    return s;
}
Shape sphere(double radius) {
    Shape s{};
    s.kind = ShapeKind::sphere;
    s.radius = radius;
    return s;
}
Shape box(double hx, double hy, double hz) {
    Shape s{};
    s.kind = ShapeKind::box;
    s.half_extents = {hx, hy, hz};
    return s;
}
static Shape round(ShapeKind kind, double radius, double half_height) {
    Shape s{};
    s.kind = kind;
    s.radius = radius;
    s.half_height = half_height;
    return s;
}
Shape capsule(double radius, double half_height) {
    return round(ShapeKind::capsule, radius, half_height);
}
Shape cylinder(double radius, double half_height) {
    return round(ShapeKind::cylinder, radius, half_height);
}
Shape cone(double radius, double half_height) {
    return round(ShapeKind::cone, radius, half_height);
}

Shape box_hull(double hx, double hy, double hz) {
    Memory& m = new_memory();
    for (int i = 0; i < 8; ++i)
        m.vertices.push_back({i & 1 ? hx : -hx, i & 2 ? hy : -hy, i & 4 ? hz : -hz});
    m.faces = {4, 0, 2, 3, 1, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4,
               4, 2, 6, 7, 3, 4, 0, 4, 6, 2, 4, 1, 3, 7, 5};
    return with_faces(ShapeKind::hull, m, 6, 0);
}

Shape octahedron(double r) {
    Memory& m = new_memory();
    m.vertices = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
    m.faces = {3, 0, 2, 4, 3, 2, 1, 4, 3, 1, 3, 4, 3, 3, 0, 4,
               3, 2, 0, 5, 3, 1, 2, 5, 3, 3, 1, 5, 3, 0, 3, 5};
    return with_faces(ShapeKind::hull, m, 8, 0);
}

Shape grid_mesh(double half, int cells) {
    Memory& m = new_memory();
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j)
            m.vertices.push_back({-half + 2 * half * i / cells, 0, -half + 2 * half * j / cells});
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const auto a = static_cast<std::uint32_t>(i * (cells + 1) + j), b = a + 1;
            const auto c = a + static_cast<std::uint32_t>(cells) + 1, d = c + 1;
            for (auto k : {a, b, d, a, d, c}) m.faces.push_back(k);
        }
    return with_faces(ShapeKind::mesh, m, static_cast<std::uint32_t>(2 * cells * cells), 3);
}

Shape torus_mesh(double major, double minor, int around, int across) {
    Memory& m = new_memory();
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double s = 2 * M_PI * i / around, t = 2 * M_PI * j / across,
                         r = major + minor * std::cos(t);
            m.vertices.push_back({r * std::cos(s), minor * std::sin(t), -r * std::sin(s)});
        }
    const auto id = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % around) * across + j % across);
    };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j)
            for (auto k : {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j), id(i + 1, j + 1),
                           id(i, j + 1)})
                m.faces.push_back(k);
    return with_faces(ShapeKind::mesh, m, static_cast<std::uint32_t>(2 * around * across), 3);
}

Shape compound(const std::vector<std::pair<Shape, Place>>& parts) {
    Memory& m = new_memory();
    for (const auto& [shape, place] : parts) m.parts.push_back({shape, pose(place)});
    Shape s{};
    s.kind = ShapeKind::compound;
    s.parts = m.parts.data();
    s.part_count = static_cast<std::uint32_t>(m.parts.size());
    return s;
}

World::World(const std::string& name) : table_(plugin(name)) {
    const CreateRequest request{1, 0, nullptr};
    const char* message = nullptr;
    collider_ = table_.create(&request, &message);
    if (!collider_) std::abort();
}
World::~World() { table_.destroy(collider_); }

Status World::add(std::uint32_t id, const Shape& shape, const Place& place, Mobility mobility,
                  std::uint32_t group, std::uint32_t mask, const Place& local) {
    move(id, place);
    return collider_->add(id, {shape, pose(local), mobility, group, mask, 0});
}

void World::move(std::uint32_t id, const Place& place) { move_raw(id, pose(place)); }

void World::move_raw(std::uint32_t id, const Pose& raw) {
    if (poses_.size() <= id) poses_.resize(id + 1, pose({}));
    poses_[id] = raw;
}

const std::vector<Contact>& World::detect(double margin, std::uint32_t flags) {
    Collected collected{&contacts_, {}};
    const ContactSink sink{&collected, grow};
    const DetectRequest request{poses_.data(), sweeps.empty() ? nullptr : sweeps.data(),
                                static_cast<std::uint32_t>(poses_.size()), flags, margin};
    status_ = collider_->detect(request, &sink, 1);
    contacts_.clear();
    for (const auto& block : collected.blocks)
        contacts_.insert(contacts_.end(), block.begin(), block.end());
    return contacts_;
}

const Contact& deepest(const std::vector<Contact>& contacts) {
    const Contact* best = &contacts.at(0);
    for (const Contact& c : contacts)
        if (c.gap < best->gap) best = &c;
    return *best;
}

double spanned_area(const std::vector<Contact>& contacts) {
    if (contacts.size() < 3) return 0;
    // Hull of the points in the plane across the normal, by walking round it.
    const V n = v(contacts[0].normal), u = n.unitOrthogonal(), w = n.cross(u);
    std::vector<Eigen::Vector2d> p;
    for (const Contact& c : contacts) p.push_back({v(c.point_a).dot(u), v(c.point_a).dot(w)});
    std::sort(p.begin(), p.end(),
              [](auto& a, auto& b) { return std::tie(a.x(), a.y()) < std::tie(b.x(), b.y()); });
    std::vector<Eigen::Vector2d> hull;
    const auto turn = [](auto& o, auto& a, auto& b) {
        return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
    };
    for (int round_trip = 0; round_trip < 2; ++round_trip) {
        const std::size_t base = hull.size();
        for (const auto& q : p) {
            while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), q) <= 0)
                hull.pop_back();
            hull.push_back(q);
        }
        hull.pop_back();
        std::reverse(p.begin(), p.end());
    }
    double twice = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const auto &a = hull[i], &b = hull[(i + 1) % hull.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * std::abs(twice);
}

void expect_sound(const std::vector<Contact>& contacts, double margin) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& c = contacts[i];
        EXPECT_LT(c.a, c.b);
        EXPECT_NEAR(v(c.normal).norm(), 1, 1e-9);
        EXPECT_LE(c.gap, margin + 1e-12);
        EXPECT_NEAR(c.gap, v(c.normal).dot(v(c.point_a) - v(c.point_b)) - c.radius_a - c.radius_b,
                    1e-9);
        EXPECT_NE(c.feature, 0u);
        EXPECT_NE(c.flags, 0u);
        if (i == 0) continue;
        const Contact& p = contacts[i - 1];
        EXPECT_TRUE(std::tie(p.a, p.b, p.feature) < std::tie(c.a, c.b, c.feature))
            << "unsorted, or a feature twice";
    }
}

}  // namespace plumb::test
