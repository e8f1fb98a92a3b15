// SPDX-License-Identifier: MIT
#include "app/joint_watch.h"

#include "schedule/contact_islands.h"
#include "solve/island_residuals.h"
#include "world/build_links.h"

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <array>

namespace plumb::app {
namespace {

using Json = nlohmann::ordered_json;
using Seen = ErrorWatch::Seen;

/// How many bodies joints and links tie to two of them, these included.
std::uint32_t bodies_tied(const World& world, std::uint32_t body_a, std::uint32_t body_b) {
    std::vector<BodyPair> ties;
    add_tied_rows(world, ties);
    ContactIslands tied;
    tied.find(ties, {}, 0, world.dynamic_count);
    for (const std::uint32_t body : {body_a, body_b}) {
        const std::int32_t row = world.row_of(body);
        if (row >= world.dynamic_count || tied.island_of()[row] == ~0u) continue;
        const ContactIsland& island = tied.islands()[tied.island_of()[row]];
        return island.last_body - island.first_body;
    }
    return 1;
}

/// The joint, link or coupling that an error is of.
struct Subject {
    const char* kind;
    std::uint32_t index;  ///< in the scene
    std::string name;
    const char* unit;
    std::uint32_t body_a, body_b;  ///< of a coupling those of its second joint
};

/// Joints of rods have the identifiers after those of the scene's joints.
Subject joint_of(const Scene& scene, std::uint32_t id, const char* unit) {
    const std::size_t joints = scene.joints.size();
    if (id < joints) {
        const JointSpec& joint = scene.joints[id];
        return {"joint", id, joint.name, unit, joint.body_a, joint.body_b};
    }
    std::size_t rods = 0;
    for (std::uint32_t i = 0; i < scene.links.size(); ++i) {
        const LinkSpec& link = scene.links[i];
        if (is_rod(scene, link) && rods++ == id - joints)
            return {"link", i, "", unit, link.a.body, link.b.body};
    }
    return {"joint", id, "", unit, kNoIndex, kNoIndex};
}

Subject coupling_of(const Scene& scene, std::uint32_t id, const char*) {
    const CouplingSpec& c = scene.couplings[id];
    const JointSpec& second = scene.joints[c.joint_b];
    const bool along = c.axis_b <= kAlongZ || second.kind == JointKind::distance;
    return {"coupling", id, c.name, along ? "m" : "rad", second.body_a, second.body_b};
}

/// What is watched, and how it is told of.
struct Kind {
    const char* key;
    const ErrorWatch& watch;
    const char *words, *advice;
    Subject (*subject)(const Scene&, std::uint32_t id, const char* unit);
    const char* unit;
};

/// Joints of what lies on a sheet are solved with it, where sheets are not iterated.
constexpr const char* kSolveSheets = " or \"exact_deformables\" where bodies lie on sheets,";

std::array<Kind, 4> kinds_of(const JointWatch& watch) {
    constexpr const char* kSolveBetter = "more iterations or substeps, or \"joints\": \"tree\",";
    return {{{"apart", watch.apart(), "joints were open, or past a limit,", kSolveBetter, joint_of,
              "m"},
             {"turned", watch.turned(), "joints had turned where they should not, or past a limit,",
              kSolveBetter, joint_of, "rad"},
             {"couplings", watch.slipped(), "couplings had slipped", kSolveBetter, coupling_of, ""},
             {"trees", watch.trees(), "trees of joints were left open", "more substeps", joint_of,
              "m or rad"}}};
}

}  // namespace

void ErrorWatch::add(const Seen& seen) {
    last_ = seen;
    if (seen.id == kNoIndex) return;
    if (steps_++ == 0) first_ = seen;
    if (seen.error > worst_.error) worst_ = seen;
}

void JointWatch::add(const World& world, const StepReport& report) {
    const auto seen = [&](const auto& table, std::uint32_t index, double error) {
        return index < table.size() ? Seen{table[index].id, error, world.time} : Seen();
    };
    const JointTable& table = world.joints;
    const GapingJoints& gaping = report.gaping;
    apart_.add(seen(table.joints, gaping.widest, gaping.along));
    turned_.add(seen(table.joints, gaping.most_turned, gaping.about));
    slipped_.add(seen(table.couplings, gaping.worst_coupling, gaping.coupled));
    trees_.add(seen(table.joints, report.open_joint, report.tree_error));
}

Json JointWatch::json(const Scene& scene, const World& world) const {
    Json json;
    for (const Kind& kind : kinds_of(*this)) {
        const auto of_one = [&](const Seen& seen) -> Json {
            if (seen.id == kNoIndex) return nullptr;
            const Subject subject = kind.subject(scene, seen.id, kind.unit);
            return {{subject.kind, subject.index},
                    {"name", subject.name},
                    {"error", seen.error},
                    {"unit", subject.unit},
                    {"time", seen.time},
                    {"bodies", bodies_tied(world, subject.body_a, subject.body_b)}};
        };
        const ErrorWatch& watch = kind.watch;
        if (watch.steps() > 0)
            json[kind.key] = {{"steps", watch.steps()},
                              {"first", of_one(watch.first())},
                              {"worst", of_one(watch.worst())},
                              {"at_end", of_one(watch.last())}};
        else
            json[kind.key] = nullptr;
    }
    return json;
}

std::vector<std::string> JointWatch::warnings(const Scene& scene, const World& world) const {
    std::vector<std::string> warnings;
    for (const Kind& kind : kinds_of(*this)) {
        if (kind.watch.steps() == 0) continue;
        const auto name = [&](const Seen& seen) {
            const Subject subject = kind.subject(scene, seen.id, kind.unit);
            return fmt::format(
                "{} {}", subject.kind,
                subject.name.empty() ? std::to_string(subject.index) : '"' + subject.name + '"');
        };
        const auto how_far = [&](const Seen& seen) {
            return fmt::format("{:.3g} {}", seen.error,
                               kind.subject(scene, seen.id, kind.unit).unit);
        };
        const ErrorWatch& watch = kind.watch;
        const Seen &first = watch.first(), &worst = watch.worst(), &last = watch.last();
        warnings.push_back(fmt::format(
            "{} in {} of {} steps: {} first, at {:.4g} s, {} the most, by {} at {:.4g} s, and at "
            "the end {}; {} may help",
            kind.words, watch.steps(), world.steps, name(first), first.time, name(worst),
            how_far(worst), worst.time,
            last.id == kNoIndex ? "none" : name(last) + ", by " + how_far(last),
            sweeps_deformables(world) ? std::string(kind.advice) + kSolveSheets : kind.advice));
    }
    return warnings;
}

}  // namespace plumb::app
