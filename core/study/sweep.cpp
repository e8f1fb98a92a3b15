// SPDX-License-Identifier: MIT
#include "study/sweep.h"

#include "scene/error.h"
#include "study/journal.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <stdexcept>

namespace plumb::study {
namespace {

using Clock = std::chrono::steady_clock;

/// Share of the budget after which no point is begun that was never run: the rest is for times.
constexpr double kFirstRuns = 0.7;

class Sweep {
public:
    Sweep(StudyTable& table, const std::vector<Subject>& subjects, const ColliderLibrary& colliders,
          const SweepOptions& options)
        : table_(table), colliders_(colliders), options_(options) {
        for (const Subject& s : subjects) subjects_[s.name] = &s;
        for (std::size_t i = options.shard - 1; i < table.rows.size(); i += options.of)
            mine_.push_back(i);
        work_.resize(table.rows.size());
        for (const std::size_t i : mine_) work_[i] = work(table.rows[i].point);
        std::stable_sort(mine_.begin(), mine_.end(),
                         [&](std::size_t i, std::size_t j) { return work_[i] < work_[j]; });
    }

    bool run() {
        for (const std::size_t i : mine_) {
            if (is_known(table_.rows[i])) continue;
            if (!fits(i, kFirstRuns)) {
                table_.rows[i].note = "the budget was spent";
                continue;
            }
            take(i, true);
            if (was_interrupted_) return false;
        }
        for (std::uint32_t repeat = 2; repeat <= options_.repeats; ++repeat)
            for (const std::size_t i : mine_) {
                const Row& row = table_.rows[i];
                if (row.status != Status::done || row.costs.size() >= repeat || !fits(i, 1))
                    continue;
                take(i, false);
                if (was_interrupted_) return false;
            }
        return true;
    }

private:
    static bool is_known(const Row& row) {
        return row.status != Status::not_run && (row.status != Status::done || !row.costs.empty());
    }

    double work(const Point& p) const {
        try {
            return work_of(*subjects_.at(p.subject), settings_at(*subjects_.at(p.subject), p));
        } catch (const SceneError&) {
            return 0;  // refused as soon as it is run
        }
    }

    double spent() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

    /// Whether a run is likely to end before this share of the budget is spent: it takes as long
    /// as it took before, or by its work as long as others of its subject.
    bool fits(std::size_t i, double share) const {
        const auto rate = rates_.find(table_.rows[i].point.subject);
        const double expected = rate == rates_.end() ? 0 : rate->second * work_[i];
        return spent() + expected < share * options_.budget;
    }

    void take(std::size_t i, bool judged) {
        Row& row = table_.rows[i];
        if (options_.progress) options_.progress({done_, mine_.size() * options_.repeats, &row});
        ++done_;
        const double before = spent();
        const Stop stop = [this] {
            was_interrupted_ = options_.interrupted && options_.interrupted();
            return was_interrupted_ || spent() > options_.budget;
        };
        const Outcome outcome =
            run_point(*subjects_.at(row.point.subject), row.point, colliders_, judged, stop);
        if (outcome.status == Status::done) {
            double& rate = rates_[row.point.subject];
            rate = std::max(0.5 * rate, (spent() - before) / std::max(1.0, work_[i]));
        }
        if (outcome.status == Status::not_run && !judged) return;
        enter(row, judged, outcome);
        if (options_.ran && outcome.status != Status::not_run) options_.ran(i, judged, outcome);
    }

    StudyTable& table_;
    const ColliderLibrary& colliders_;
    const SweepOptions& options_;
    std::map<std::string, const Subject*> subjects_;
    std::vector<std::size_t> mine_;        ///< rows of this shard, by work
    std::vector<double> work_;             ///< [row]
    std::map<std::string, double> rates_;  ///< [subject], of time over work [s]
    std::size_t done_ = 0;
    bool was_interrupted_ = false;
    Clock::time_point start_ = Clock::now();
};

}  // namespace

StudyTable plan_sweep(const std::vector<Subject>& subjects, const SweepChoice& choice,
                      const ColliderLibrary& colliders) {
    StudyTable table;
    table.machine = this_machine();
    for (const Subject& s : subjects) {
        if (table.find(s.name))
            throw std::invalid_argument("two subjects are called \"" + s.name + "\"");
        table.subjects.push_back(summary_of(s));
        for (Point& p : points_of(s, choice, colliders)) {
            Row row;
            row.point = std::move(p);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

bool sweep(StudyTable& table, const std::vector<Subject>& subjects,
           const ColliderLibrary& colliders, const SweepOptions& options) {
    return Sweep(table, subjects, colliders, options).run();
}

}  // namespace plumb::study
