// SPDX-License-Identifier: MIT
#include "study/sweep_plan.h"

#include "effects/plan.h"
#include "host/conflicts.h"
#include "reader/reader.h"
#include "world/world.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace plumb::study {
namespace {

/// Steps that are not divided, up to four times as long as the subject's.
constexpr const char* kOneSubstep = "one substep";

constexpr std::array kSubsteps{1, 2, 4, 8, 16, 32, 64, 128, 256, 400};
constexpr std::array kIterations{1, 2, 5, 10, 20, 50, 100, 200, 400};
constexpr std::array kSteps{4.0,     2.0,      1.0,      1.0 / 2, 1.0 / 4,
                            1.0 / 8, 1.0 / 16, 1.0 / 32, 1.0 / 64};  ///< times the subject's dt

constexpr std::array kAccuracies{1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001, 0.0001};

/// Settings that make a curve, and what must run for it to say anything.
struct Variant {
    const char* name;
    const char* setting;              ///< key=value; "" for none
    std::optional<Effect> called_by;  ///< left out where this does not run
    bool by_iterations = false;       ///< and not by substeps alone
};

/// Each departure from the paper switched off by itself, and the choices that a user has beside.
constexpr std::array kVariants{
    Variant{"without warm start", "warm_start=false", Effect::contacts},
    Variant{"without alternating sweeps", "alternate_sweeps=false", Effect::contacts},
    Variant{"without shared push", "shared_push=false", Effect::contacts},
    Variant{"without shared cone", "shared_cone=false", Effect::friction},
    Variant{"without anchors", "anchor_stiffness=0", Effect::sticking_anchors},
    Variant{"without reuse of contacts", "reuse_distance=0", Effect::contact_reuse},
    Variant{kIteratedCurve.data(), "exact_islands=0", Effect::exact_islands, true},
    Variant{"patch by patch", "multilevel=true", Effect::deformables},
    Variant{"deformables as one system", "exact_deformables=100000", Effect::deformables},
    Variant{"explicit gyroscopic term", "gyroscopic=explicit", Effect::gyroscopic},
    Variant{"implicit gyroscopic term", "gyroscopic=implicit", Effect::gyroscopic},
    Variant{kLeapfrogCurve.data(), "leapfrog_start=true", {}},
    Variant{"undivided trees", "tree_parts=1", Effect::divided_trees},
    Variant{"joints by iterations", "joints=iterate", Effect::joint_trees},
};

/// The one of those named that must not share a process with a collider, or null.
const std::string* conflict_of(const ColliderLibrary& library,
                               const std::vector<std::string>& names,
                               const ColliderInfo& collider) {
    for (const std::string& name : names)
        if (conflicting(*library.find(name).table, *collider.table)) return &name;
    return nullptr;
}

bool can_do(const ColliderLibrary& library, const ColliderInfo& collider, const Scene& scene) {
    try {
        library.check_abilities(collider, scene);
        return true;
    } catch (const ColliderError&) {
        return false;
    }
}

/// Writes the points of a subject, curve by curve.
class Planner {
public:
    Planner(const Subject& subject, const SweepChoice& choice, const ColliderLibrary& colliders)
        : subject_(subject), choice_(choice), plan_(make_plan(build_world(subject.scene))) {
        choose_colliders(colliders);
    }

    std::vector<Point> all() {
        for (const char* precision : {"single", "double"})
            for (const Ladder ladder : {Ladder::substeps, Ladder::iterations, Ladder::step})
                climb("pbd", precision, ladder, colliders_.front(), "");
        for (const Ladder ladder : {Ladder::substeps, Ladder::iterations})
            climb("paper", "single", ladder, colliders_.front(), "preset=paper");
        const std::string& collider = colliders_.front();
        for (const Variant& v : kVariants) {
            if (v.called_by && !plan_.runs(*v.called_by)) continue;
            climb(v.name, "single", Ladder::substeps, collider, v.setting);
            if (v.by_iterations) climb(v.name, "single", Ladder::iterations, collider, v.setting);
        }
        if (plan_.runs(Effect::exact_islands) && has_large_islands())
            climb("pbd", "single", Ladder::accuracy, collider, "");
        for (const char* precision : {"single", "double"})
            climb(kOneSubstep, precision, Ladder::step, collider, "substeps=1");
        climb(std::string(kLeapfrogCurve), "single", Ladder::step, collider, "leapfrog_start=true",
              {"substeps=1"});
        if (plan_.runs(Effect::joints) && !plan_.runs(Effect::joint_trees)) {
            climb("joints as trees", "single", Ladder::substeps, collider, "joints=tree");
            climb("joints as trees", "single", Ladder::step, collider, "joints=tree",
                  {"substeps=1"});
        }
        climb_on_each_collider();
        return std::move(points_);
    }

private:
    /// Whether so many bodies move that islands may be too large to be solved exactly as they are.
    bool has_large_islands() const {
        const auto& bodies = subject_.scene.bodies;
        const auto moving = std::count_if(bodies.begin(), bodies.end(), [](const BodySpec& b) {
            return b.motion == Motion::dynamic;
        });
        return moving > static_cast<std::ptrdiff_t>(subject_.scene.settings.exact_islands);
    }

    void climb_on_each_collider() {
        for (const std::string& collider : colliders_) {
            if (collider != colliders_.front())
                climb("pbd", "single", Ladder::substeps, collider, "");
            if (plan_.runs(Effect::contacts))
                climb("raw contacts", "single", Ladder::substeps, collider, "contacts=raw");
        }
    }

    /// The one that most curves run on, then those that can do the scene, too; where nothing
    /// touches, one is as good as any.
    void choose_colliders(const ColliderLibrary& library) {
        if (choice_.colliders.empty()) colliders_ = able_colliders(subject_.scene, library);
        for (const std::string& name : choice_.colliders) {
            const ColliderInfo& collider = library.find(name);
            library.check_abilities(collider, subject_.scene);
            if (const std::string* other = conflict_of(library, colliders_, collider))
                throw ColliderError("collider \"" + name + "\" must not share a process with \"" +
                                    *other + "\": sweep them one by one");
            colliders_.push_back(name);
        }
        if (!plan_.runs(Effect::contacts)) colliders_.resize(1);
    }

    /// A point for each rung of a ladder; `more`: settings beside the one that makes the curve.
    void climb(const std::string& curve, const std::string& precision, Ladder ladder,
               const std::string& collider, const std::string& setting,
               const std::vector<std::string>& more = {}) {
        const auto& wanted = choice_.curves;
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), curve) == wanted.end())
            return;
        Point p{.subject = subject_.name,
                .curve = curve,
                .precision = precision,
                .ladder = ladder,
                .value = 0,
                .collider = collider,
                .contacts = setting == "contacts=raw" ? "raw" : "shared",
                .settings = {}};
        if (!setting.empty()) p.settings.push_back(setting);
        p.settings.push_back("precision=" + precision);
        p.settings.insert(p.settings.end(), more.begin(), more.end());
        const auto add = [&](double value, std::vector<std::string> rung) {
            Point& made = points_.emplace_back(p);
            made.value = value;
            made.settings.insert(made.settings.end(), rung.begin(), rung.end());
        };
        if (ladder == Ladder::substeps)
            for (const int n : kSubsteps)
                add(n, {"substeps=" + std::to_string(n), "velocity_iterations=1",
                        "position_iterations=1"});
        if (ladder == Ladder::iterations)
            for (const int n : kIterations)
                add(n, {"substeps=1", "velocity_iterations=" + std::to_string(n),
                        "position_iterations=" + std::to_string(n)});
        if (ladder == Ladder::accuracy)
            for (const double accuracy : kAccuracies)
                add(accuracy, {"accuracy=" + number_text(accuracy)});
        if (ladder == Ladder::step)
            for (const double share : kSteps) {
                const double dt = share * subject_.scene.settings.dt;
                add(dt, {"dt=" + number_text(dt)});
            }
    }

    const Subject& subject_;
    const SweepChoice& choice_;
    Plan plan_;
    std::vector<std::string> colliders_;
    std::vector<Point> points_;
};

}  // namespace

std::vector<std::string> curve_names() {
    std::vector<std::string> names{"pbd", "paper", kOneSubstep, "joints as trees", "raw contacts"};
    for (const Variant& v : kVariants) names.emplace_back(v.name);
    return names;
}

std::vector<std::string> able_colliders(const Scene& scene, const ColliderLibrary& library) {
    std::vector<std::string> names{library.choose(scene).collider->name};
    for (const ColliderInfo& c : library.all())
        if (c.table && c.name != names.front() && !conflict_of(library, names, c) &&
            can_do(library, c, scene))
            names.push_back(c.name);
    return names;
}

std::vector<Point> points_of(const Subject& subject, const SweepChoice& choice,
                             const ColliderLibrary& colliders) {
    return Planner(subject, choice, colliders).all();
}

Settings settings_at(const Subject& subject, const Point& point) {
    Settings settings = subject.scene.settings;
    for (const std::string& setting : point.settings) apply_setting(settings, setting);
    return settings;
}

std::string number_text(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general).ptr;
    return {text, end};
}

double work_of(const Subject& subject, const Settings& s) {
    const double substeps = s.duration / s.dt * s.substeps;
    double moving = static_cast<double>(subject.scene.bodies.size());
    for (const DeformableSpec& d : subject.scene.deformables)
        moving += static_cast<double>(d.points.size());
    return substeps * moving * (2.0 + s.velocity_iterations + s.position_iterations);
}

}  // namespace plumb::study
