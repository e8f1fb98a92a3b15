// SPDX-License-Identifier: MIT
/// Judges for what can be told from one moment of a world.
#pragma once

#include "study/subject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

}  // namespace plumb::study
