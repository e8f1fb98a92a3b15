// SPDX-License-Identifier: MIT
/// Impacts: a ball that bounces on the ground, and a row of balls that hit each other.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plumb::study {
namespace {

constexpr double kRadius = 0.1;  // of all balls [m]

/// A ball dropped from h₀ comes back to e²ᵏ h₀: it is at the top of its k-th flight at
/// √(2h₀/g) (1 + 2 (e + … + eᵏ⁻¹) + eᵏ).
struct Drop {
    double height, restitution = 0.8;  ///< of the ball's lowest point [m]

    double apex(int flight) const { return height * std::pow(restitution, 2 * flight); }
    double rise_time(int flight) const { return std::sqrt(2 * apex(flight) / kGravity); }
    double apex_time(int flight) const {
        double time = 0;
        for (int k = 1; k <= flight; ++k) time += rise_time(k - 1) + rise_time(k);
        return time;
    }
    /// Height at a time [m].
    double at(double time) const {
        int flight = 0;
        while (apex_time(flight) + rise_time(flight) < time) ++flight;
        const double t = time - apex_time(flight);
        return apex(flight) - 0.5 * kGravity * t * t;
    }
};

/// Balls side by side, for the error of one hangs on where in a substep it meets the ground.
constexpr int kDrops = 16;
Drop drop_of(int ball) { return {1 + std::sqrt(2) * ball / kDrops}; }
double height_of(const World& w, int ball) { return w.bodies.position[1 + ball].y() - kRadius; }

/// Follows the flights of one ball. The top of a flight is that of the parabola through its slowest
/// moment.
class Flights {
public:
    void look(double height, double velocity) {
        if (velocity > 0 && !rises_) flights_.emplace_back();
        rises_ = velocity > 0;
        const double speed = size_of(velocity);
        if (speed < flights_.back().speed)
            flights_.back() = {speed, height + 0.5 * speed * speed / kGravity};
    }
    /// Of a flight from 0, that of the drop, on; 0 where it has not begun [m].
    double top(int flight) const {
        return flight < static_cast<int>(flights_.size()) ? flights_[flight].top : 0;
    }

private:
    struct Flight {
        double speed = std::numeric_limits<double>::infinity();  ///< least [m/s]
        double top = 0;                                          ///< [m]
    };
    std::vector<Flight> flights_ = std::vector<Flight>(1);
    bool rises_ = false;
};

/// Root of the mean square over all balls and all flights that should have had their top by now.
class ApexJudge : public Judge {
public:
    void look(const World& w) override {
        time_ = w.time;
        for (int i = 0; i < kDrops; ++i)
            flights_[i].look(height_of(w, i), w.bodies.velocity[1 + i].y());
    }
    double error() const override {
        double sum = 0, count = 0;
        for (int i = 0; i < kDrops; ++i)
            for (int k = 1; drop_of(i).apex_time(k) < time_; ++k, ++count) {
                const double off = flights_[i].top(k) / drop_of(i).apex(k) - 1;
                sum += off * off;
            }
        return count > 0 ? size_of(std::sqrt(sum / count)) : 0;
    }

private:
    std::array<Flights, kDrops> flights_;
    double time_ = 0;
};

double height_error(const World& w) {
    double worst = 0;
    for (int i = 0; i < kDrops; ++i)
        worst = std::max(worst, size_of(height_of(w, i) - drop_of(i).at(w.time)));
    return worst;
}

/// Equal balls on a line that lose nothing exchange their velocities. Less the lengths of the balls
/// before it, the place of each is that of the pulse which is at its turn, and pulses go straight
/// on.
struct Row {
    static constexpr int kCount = 5, kRunners = 2;
    double speed = 1, gap = 0.0213, run_up = 0.1971;  ///< [m/s], [m]

    double start(int ball) const {
        return ball * (2 * kRadius + gap) - (ball < kRunners ? run_up : 0);
    }
    double speed_at_start(int ball) const { return ball < kRunners ? speed : 0; }

    std::array<double, kCount> positions(double time) const {
        std::array<double, kCount> x{};
        for (int i = 0; i < kCount; ++i)
            x[i] = start(i) + speed_at_start(i) * time - 2 * kRadius * i;
        std::sort(x.begin(), x.end());
        for (int i = 0; i < kCount; ++i) x[i] += 2 * kRadius * i;
        return x;
    }
    double speed_at_end(int ball) const { return speed_at_start(kCount - 1 - ball); }
};

double position_error(const Row& row, const World& w) {
    const auto exact = row.positions(w.time);
    double worst = 0;
    for (int i = 0; i < Row::kCount; ++i)
        worst = std::max(worst, size_of(w.bodies.position[i].x() - exact[i]));
    return worst;
}

double speed_error(const Row& row, const World& w) {
    double worst = 0;
    for (int i = 0; i < Row::kCount; ++i) {
        const Vector3d exact(row.speed_at_end(i), 0, 0);
        worst = std::max(worst, size_of((w.bodies.velocity[i] - exact).norm() / row.speed));
    }
    return worst;
}

}  // namespace

Subject bouncing() {
    Subject s = begin_subject("bouncing", "Balls of restitution 0.8 bounce on level ground",
                              "the k-th bounce comes to e²ᵏ h₀", 2);
    add_ground(s.scene);
    for (int i = 0; i < kDrops; ++i) {
        const Drop drop = drop_of(i);
        s.scene.materials[0].restitution = drop.restitution;
        add_body(s.scene, sphere(kRadius), {4 * kRadius * i, kRadius + drop.height, 0});
    }
    s.metrics = {largest("position", "m", "largest error of a position", height_error),
                 {"height", "", "error of the heights to which they come, in the root mean square",
                  [] { return std::make_unique<ApexJudge>(); }}};
    s.tolerance = 0.012;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

Subject cradle() {
    Subject s =
        begin_subject("cradle", "Two balls run into three at rest, gaps of 2 cm between all",
                      "two go on, with all of the speed", 1);
    const Row row;
    s.scene.settings.gravity.setZero();
    s.scene.materials[0].restitution = 1;
    s.scene.materials[0].friction = 0;
    for (int i = 0; i < Row::kCount; ++i)
        add_body(s.scene, sphere(kRadius), {row.start(i), 0, 0}).velocity.x() =
            row.speed_at_start(i);
    s.metrics = {largest("position", "m", "largest error of a position",
                         [row](const World& w) { return position_error(row, w); }),
                 last("speed", "", "largest error of a speed in the end, of that of the first",
                      [row](const World& w) { return speed_error(row, w); })};
    s.tolerance = 2.5e-3;
    return s;
}

}  // namespace plumb::study
