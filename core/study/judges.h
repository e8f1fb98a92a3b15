// SPDX-License-Identifier: MIT
/// Judges for what can be told from one moment of a world.
#pragma once

#include "study/subject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace plumb::study {

/// Size of a deviation; infinite where it is not a number.
inline double size_of(double deviation) {
    return std::isnan(deviation) ? std::numeric_limits<double>::infinity() : std::abs(deviation);
}

/// The largest deviation at any moment. `deviation`: of a world at World::time, from its answer; it
/// must not keep anything between calls.
class LargestDeviation : public Judge {
public:
    using Deviation = std::function<double(const World&)>;
    explicit LargestDeviation(Deviation deviation) : deviation_(std::move(deviation)) {}

    void look(const World& world) override {
        error_ = std::max(error_, size_of(deviation_(world)));
    }
    double error() const override { return error_; }

private:
    Deviation deviation_;
    double error_ = 0;
};

/// The deviation at the last moment.
class LastDeviation : public Judge {
public:
    using Deviation = LargestDeviation::Deviation;
    explicit LastDeviation(Deviation deviation) : deviation_(std::move(deviation)) {}

    void look(const World& world) override { error_ = size_of(deviation_(world)); }
    double error() const override { return error_; }

private:
    Deviation deviation_;
    double error_ = 0;
};

/// The mean over all moments but the first.
class MeanDeviation : public Judge {
public:
    using Deviation = LargestDeviation::Deviation;
    explicit MeanDeviation(Deviation deviation) : deviation_(std::move(deviation)) {}

    void look(const World& world) override {
        if (world.steps == 0) return;
        sum_ += std::abs(deviation_(world));
        ++count_;
    }
    double error() const override { return count_ > 0 ? sum_ / count_ : 0; }

private:
    Deviation deviation_;
    double sum_ = 0;
    double count_ = 0;
};

/// A value that swings through 0: how often, and its mean over whole swings.
class Swings {
public:
    void add(double time, double value) {
        sum_ += 0.5 * (value + before_) * (time - time_);
        if (before_ < 0 && value >= 0) {
            last_ = time_ + (time - time_) * before_ / (before_ - value);
            sum_to_last_ = sum_ - 0.5 * value * (time - last_);
            if (passes_++ == 0) first_ = last_, sum_to_first_ = sum_to_last_;
        }
        before_ = value, time_ = time;
    }
    /// [Hz]; 0 where it does not swing.
    double frequency() const { return passes_ > 1 ? (passes_ - 1) / (last_ - first_) : 0; }
    /// Over all the time where it does not swing.
    double mean() const {
        if (passes_ > 1) return (sum_to_last_ - sum_to_first_) / (last_ - first_);
        return time_ > 0 ? sum_ / time_ : 0;
    }

private:
    double before_ = 0, time_ = 0, sum_ = 0, first_ = 0, last_ = 0, sum_to_first_ = 0,
           sum_to_last_ = 0;
    int passes_ = 0;  ///< upwards
};

/// The mean of a deviation that swings.
class DeviationOfMean : public Judge {
public:
    using Deviation = LargestDeviation::Deviation;
    explicit DeviationOfMean(Deviation deviation) : deviation_(std::move(deviation)) {}

    void look(const World& world) override { swings_.add(world.time, deviation_(world)); }
    double error() const override { return size_of(swings_.mean()); }

private:
    Deviation deviation_;
    Swings swings_;
};

/// How far off the frequency of a value is, of what it should be; 1 where it does not swing.
class DeviationOfFrequency : public Judge {
public:
    using Deviation = LargestDeviation::Deviation;
    /// `frequency`: what it should be [Hz].
    DeviationOfFrequency(Deviation value, double frequency)
        : value_(std::move(value)), frequency_(frequency) {}

    void look(const World& world) override { swings_.add(world.time, value_(world)); }
    double error() const override { return size_of(swings_.frequency() / frequency_ - 1); }

private:
    Deviation value_;
    double frequency_;
    Swings swings_;
};

/// How far the body that may move and came the farthest has come from where it was at the start.
class LargestWay : public Judge {
public:
    /// `size`: what the way is told as a share of [m].
    explicit LargestWay(double size) : size_(size) {}

    void look(const World& world) override {
        const Bodies& b = world.bodies;
        if (start_.empty()) start_ = b.position;
        for (std::size_t i = 0; i < b.size(); ++i)
            if (b.motion[i] != Motion::fixed)
                error_ = std::max(error_, size_of((b.position[i] - start_[i]).norm() / size_));
    }
    double error() const override { return error_; }

private:
    double size_, error_ = 0;
    std::vector<Vector3d> start_;
};

/// A metric whose judges are made of a deviation alone.
template <class J>
Metric metric_by(std::string name, std::string unit, std::string what,
                 typename J::Deviation deviation) {
    return {std::move(name), std::move(unit), std::move(what),
            [deviation = std::move(deviation)] { return std::make_unique<J>(deviation); }, 0};
}
inline constexpr auto largest = metric_by<LargestDeviation>;
inline constexpr auto last = metric_by<LastDeviation>;
inline constexpr auto mean_over_time = metric_by<MeanDeviation>;
inline constexpr auto of_mean = metric_by<DeviationOfMean>;

/// What is to stand still. `size` [m], which `what` names.
inline Metric shift_metric(std::string what, double size) {
    return {"shift", "", std::move(what), [size] { return std::make_unique<LargestWay>(size); }, 0};
}

/// `value` swings through 0, `frequency` times a second.
inline Metric frequency_metric(std::string what, LargestDeviation::Deviation value,
                               double frequency) {
    return {"frequency", "", std::move(what),
            [value = std::move(value), frequency] {
                return std::make_unique<DeviationOfFrequency>(value, frequency);
            },
            0};
}

}  // namespace plumb::study
