// SPDX-License-Identifier: MIT
#include "costs/near_pairs.h"

#include "costs/unit_shapes.h"

#include <chrono>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

namespace plumb::bench {
namespace {

constexpr int kSide = 6;              ///< pairs along an edge of the lattice that they stand in
constexpr double kApart = 5;          ///< of two pairs [m]
constexpr double kMargin = 0.005;     ///< [m]
constexpr double kDeepest = 0.002;    ///< [m]
constexpr double kTremble = 0.00003;  ///< how far a body moves between two detections [m]

/// Room for contacts that is used again by each detection.
struct Sink {
    std::vector<Contact>& contacts;
    std::size_t used = 0;

    static Contact* grow(void* ctx, std::uint32_t count) {
        Sink& sink = *static_cast<Sink*>(ctx);
        const std::size_t begin = sink.used;
        sink.used += count;
        if (sink.contacts.size() < sink.used) sink.contacts.resize(2 * sink.used);
        return sink.contacts.data() + begin;
    }
};

/// About the vertical only, or about any axis.
Quat random_turn(std::mt19937& random, bool upright) {
    std::normal_distribution<double> n;
    const double x = upright ? 0 : n(random), y = n(random), z = upright ? 0 : n(random),
                 w = n(random), length = std::sqrt(x * x + y * y + z * z + w * w);
    return {x / length, y / length, z / length, w / length};
}

Vec3 along(const Vec3& from, const Vec3& direction, double way) {
    return {from.x + way * direction.x, from.y + way * direction.y, from.z + way * direction.z};
}

bool is_surface(ShapeKind kind) {
    return kind == ShapeKind::plane || kind == ShapeKind::mesh || kind == ShapeKind::height_field;
}

}  // namespace

NearPairs::NearPairs(const ColliderLibrary& library, const ColliderInfo& plugin, ShapeKind a,
                     ShapeKind b)
    : proximity_(library.create(plugin, 1)) {
    add_pairs(a, b);
    ask();  // closest points are asked at the poses of a detection
    bring_near();
    for (int i = 0; i < 3; ++i) detect();
}

void NearPairs::add(std::uint32_t body, ShapeKind kind, bool upper, const Pose& pose) {
    const bool ground = !upper && is_surface(kind);
    const Mobility mobility = ground ? Mobility::fixed : Mobility::dynamic;
    const Shape shape = ground ? unit_ground(kind) : unit_shape(kind);
    if (poses_.size() <= body) poses_.resize(body + 1);
    poses_[body] = pose;
    const Pose home{{0, 0, 0}, {0, 0, 0, 1}};
    // Bodies of one side never meet each other.
    const std::uint32_t own = upper ? 1 : 2, other = upper ? 2 : 1;
    const Status status = proximity_->add(body, {shape, home, mobility, own, other, 0});
    if (status.code != Status::ok)
        throw std::runtime_error(status.message ? status.message : "a shape was refused");
}

void NearPairs::add_pairs(ShapeKind a, ShapeKind b) {
    const bool swap = is_surface(a) && (!is_surface(b) || a == ShapeKind::plane);
    const ShapeKind lower = swap ? a : b, above = swap ? b : a;
    const bool ground = is_surface(lower);
    plane_ = lower == ShapeKind::plane;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.3, 0.3);
    if (plane_) add(0, lower, false, {{0, 0, 0}, {0, 0, 0, 1}});
    const std::uint32_t count = kSide * kSide * kSide;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool upright = i % 2 == 0;
        const Vec3 place = ground ? Vec3{kApart * (i % 16), 0, kApart * (i / 16)}
                                  : Vec3{kApart * (i % kSide), kApart * (i / kSide % kSide),
                                         kApart * (i / kSide / kSide)};
        if (!plane_) add(2 * i, lower, false, {place, random_turn(random, upright || ground)});
        const Vec3 over{place.x + shift(random), place.y + (ground ? 1.2 : 1.8),
                        place.z + shift(random)};
        add(2 * i + 1, above, true, {over, random_turn(random, upright)});
        pairs_.push_back({2 * i + 1, over, {0, 1, 0}});
    }
}

void NearPairs::bring_near() {
    for (int round = 0; round < 3; ++round) {
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            Pair& pair = pairs_[i];
            const std::uint32_t lower = plane_ ? 0 : pair.upper - 1;
            Contact c{};
            // Between overlapping meshes there may be none: then it stays where it is.
            if (proximity_->closest(lower, pair.upper, &c).code != Status::ok) {
                if (round > 0) continue;
                throw std::runtime_error("the plugin names no closest points");
            }
            const double wanted =
                kDeepest * (2.0 * static_cast<double>(i) / static_cast<double>(pairs_.size()) - 1);
            // The lower body is a, and the normal points out of the upper one towards it.
            pair.normal = {-c.normal.x, -c.normal.y, -c.normal.z};
            pair.place = along(pair.place, pair.normal, wanted - c.gap);
            poses_[pair.upper].position = pair.place;
        }
        ask();
    }
}

void NearPairs::ask() {
    Sink sink{contacts_};
    const ContactSink out{&sink, Sink::grow};
    const DetectRequest request{poses_.data(), nullptr, static_cast<std::uint32_t>(poses_.size()),
                                0, kMargin};
    const Status status = proximity_->detect(request, &out, 1);
    if (status.code != Status::ok)
        throw std::runtime_error(status.message ? status.message : "a detection failed");
    found_ = sink.used;
}

std::size_t NearPairs::touching() const {
    std::set<std::uint32_t> upper;
    for (std::size_t i = 0; i < found_; ++i) upper.insert(contacts_[i].b);
    return upper.size();
}

double NearPairs::detect() {
    ++calls_;
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        poses_[pairs_[i].upper].position =
            along(pairs_[i].place, pairs_[i].normal, (calls_ + i) % 2 ? kTremble : -kTremble);
    const auto start = std::chrono::steady_clock::now();
    ask();
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    return took.count() / static_cast<double>(pairs_.size());
}

}  // namespace plumb::bench
