// SPDX-License-Identifier: MIT
#include "harness.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <tuple>

namespace plumb::test {
namespace {

Contact* grow(void* blocks, std::uint32_t count) {
    auto& all = *static_cast<std::vector<std::vector<Contact>>*>(blocks);
    return all.emplace_back(count).data();
}

}  // namespace

World::World(const std::string& name, std::uint32_t threads) : table_(plugin(name)) {
    const CreateRequest request{threads, 0, nullptr};
    const char* message = nullptr;
    collider_ = table_.create(&request, &message);
    if (collider_) return;
    std::fprintf(stderr, "%s makes no collider: %s\n", name.c_str(),
                 message ? message : "no reason given");
    std::_Exit(1);
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
    std::vector<std::vector<std::vector<Contact>>> collected(sinks);
    std::vector<ContactSink> all;
    for (auto& blocks : collected) all.push_back({&blocks, grow});
    const DetectRequest request{poses_.data(),
                                sweeps.empty() ? nullptr : sweeps.data(),
                                static_cast<std::uint32_t>(poses_.size()),
                                flags,
                                margin,
                                filter,
                                runner};
    status_ = collider_->detect(request, all.data(), sinks);
    contacts_.clear();
    for (const auto& blocks : collected)
        for (const auto& block : blocks)
            contacts_.insert(contacts_.end(), block.begin(), block.end());
    return contacts_;
}

const Contact& deepest(const std::vector<Contact>& contacts) {
    const Contact* best = &contacts.at(0);
    for (const Contact& c : contacts)
        if (c.gap < best->gap) best = &c;
    return *best;
}

Gaps deepest_of_pairs(const std::vector<Contact>& contacts) {
    Gaps gaps;
    for (const Contact& c : contacts) {
        auto [it, fresh] = gaps.try_emplace({c.a, c.b}, c.gap);
        it->second = std::min(it->second, c.gap);
    }
    return gaps;
}

void EachPlugin::SetUp() {
    const std::string other = note_use(GetParam());
    if (!other.empty())
        GTEST_SKIP() << "it must not share a process with " << other << ", which was tested before";
}

bool same(const std::vector<Contact>& p, const std::vector<Contact>& q) {
    return p.size() == q.size() &&
           (p.empty() || std::memcmp(p.data(), q.data(), p.size() * sizeof(Contact)) == 0);
}

std::string printable(const std::string& name_or_file) {
    std::string name = name_or_file.substr(name_or_file.rfind('/') + 1);
    const std::string prefix = "plumb_collider_";
    if (name.rfind(prefix, 0) == 0) name = name.substr(prefix.size());
    name = name.substr(0, name.find(".so"));
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
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

void expect_sound(const std::vector<Contact>& contacts, double margin, Features features) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& c = contacts[i];
        EXPECT_LT(c.a, c.b);
        EXPECT_NEAR(v(c.normal).norm(), 1, 1e-9);
        EXPECT_LE(c.gap, margin + 1e-12);
        EXPECT_NEAR(c.gap, v(c.normal).dot(v(c.point_a) - v(c.point_b)) - c.radius_a - c.radius_b,
                    1e-9);
        if (features == Features::known) {
            EXPECT_NE(c.feature, 0u);
        }
        EXPECT_NE(c.flags, 0u);
        if (i == 0) continue;
        const Contact& p = contacts[i - 1];
        const auto before = std::tie(p.a, p.b, p.feature), now = std::tie(c.a, c.b, c.feature);
        EXPECT_TRUE(before < now || (c.feature == 0 && before == now))
            << "unsorted, or a feature twice";
    }
}

}  // namespace plumb::test
