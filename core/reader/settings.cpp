// SPDX-License-Identifier: MIT
/// The keys of "settings", and single settings from a command line.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "reader/drafts.h"
#include "reader/json/parse.h"

namespace plumb::reader {

namespace {

using S = Settings;
constexpr Range kIterations{0, 100000};
constexpr Range kSpeeds{-1e4, 1e4};  // of the air [m/s]

/// Names of ready-made settings.
enum class Preset { paper };

Field<S> preset_field() {
    const Choice<Preset> preset{{{"paper", Preset::paper}}};
    return special<S>(
        "preset", preset.schema(),
        [preset](S& settings, const Node& node) {
            if (preset.read(node) == Preset::paper) apply_paper_preset(settings);
        },
        "settings to begin from, which the other keys then change; paper: the paper's step to the "
        "letter");
}

/// Widths that the solver is built for; 0 lets it choose.
Field<S> lanes_field() {
    return special<S>(
        "lanes", {{"enum", {0, 1, 4, 8, 16}}},
        [](S& settings, const Node& node) {
            const Json allowed = {0, 1, 4, 8, 16};
            if (std::find(allowed.begin(), allowed.end(), node.json()) == allowed.end()) {
                node.fail_wanting("one of 0, 1, 4, 8, 16");
            }
            settings.lanes = Whole<std::uint32_t>{{0, 16}}.read(node);
        },
        "constraints solved side by side; 0: as many as the processor runs and the scene fills");
}

}  // namespace

const Table<Settings>& settings_table() {
    using W = Whole<std::uint32_t>;
    static const Table<S> table = {
        preset_field(),
        field<S>("gravity", Vector3{{-1e6, 1e6}}, &S::gravity, "acceleration of gravity [m/s²]"),
        field<S>("wind", Vector3{kSpeeds}, &S::wind,
                 "velocity of the air, which drags at the surfaces of what deforms; left out: "
                 "there is no air [m/s]"),
        field<S>("gusts", Vector3{kSpeeds}, &S::gusts,
                 "by how much the wind swings along each axis; nothing is the default [m/s]"),
        field<S>(
            "gust_period", Number{{1e-3, 1e9}}, &S::gust_period,
            "of the swing along x; along y it is faster by √2, along z by √3; 3 is the default "
            "[s]"),
        field<S>("air_density", Number{{0, 1e6}}, &S::air_density, "1.2 is the default [kg/m³]"),
        field<S>("dt", Number{{1e-9, 10}}, &S::dt, "step [s]"),
        field<S>("duration", Number{{0, 1e9}}, &S::duration, "simulated time [s]"),
        field<S>("substeps", W{{1, 100000}}, &S::substeps,
                 "small steps to one detection of contacts"),
        field<S>("velocity_iterations", W{kIterations}, &S::velocity_iterations,
                 "iterations over the velocity constraints a substep"),
        field<S>("position_iterations", W{kIterations}, &S::position_iterations,
                 "iterations over the position constraints a substep"),
        field<S>("method", Choice<std::string>{{{"pbd", "pbd"}}}, &S::method, "how a step is made"),
        field<S>("precision",
                 Choice<Precision>{{{"single", Precision::single}, {"double", Precision::double_}}},
                 &S::precision, "numbers of the solver's iterations; poses are always double"),
        field<S>("threads", W{{1, 1024}}, &S::threads, "worker threads"),
        lanes_field(),
        field<S>(
            "contacts",
            Choice<ContactOrigin>{{{"shared", ContactOrigin::shared}, {"raw", ContactOrigin::raw}}},
            &S::contacts,
            "shared: contacts clipped from the true shapes, alike on every collider; raw: what "
            "the collider's back-end itself reports"),
        field<S>("margin", Number{{0, 1e3}}, &S::margin,
                 "distance at which contacts are found [m]"),
        field<S>("reuse_distance", Number{{0, 1e3}}, &S::reuse_distance,
                 "contacts of a pair are kept while its points move by less [m]; 0: always detect"),
        field<S>("stiffness", Number{{0, 1}}, &S::stiffness,
                 "share of an old overlap removed a substep (where solved exactly, one of 10 ms or "
                 "longer, and less in shorter ones); an iteration, of five, without shared_push"),
        field<S>(
            "recovery_speed", Number{kNotNegative}, &S::recovery_speed,
            "greatest speed at which old overlap is pushed out, small bodies more slowly, and at "
            "which joints come back that are beyond a limit or far from a coupling's offset "
            "[m/s], [rad/s]"),
        field<S>("collision_depth", Number{{0, 1e3}}, &S::collision_depth,
                 "depth ε: a pair collides when it approaches faster than √(2 g ε) [m]"),
        field<S>("anchor_stiffness", Number{{0, 1}}, &S::anchor_stiffness,
                 "share of a sticking contact's anchor slip undone a substep; 0: no anchors"),
        field<S>("gyroscopic",
                 Choice<Gyroscopic>{{{"conserving", Gyroscopic::conserving},
                                     {"implicit", Gyroscopic::implicit},
                                     {"explicit", Gyroscopic::explicit_}}},
                 &S::gyroscopic, "how the gyroscopic term is integrated"),
        field<S>("joints",
                 Choice<JointMethod>{{{"auto", JointMethod::auto_},
                                      {"tree", JointMethod::tree},
                                      {"iterate", JointMethod::iterate}}},
                 &S::joints,
                 "joints that form trees are solved exactly, or all by iterations; auto: those of "
                 "bodies that hang together exactly, unless more than one in ten closes a loop, a "
                 "coupling ties two of them, or they are a ragdoll: at most 32 bodies that nothing "
                 "holds and no motor drives, but limits, springs or friction"),
        field<S>("exact_islands", W{{0, 100000}}, &S::exact_islands,
                 "islands of at most so many bodies that touch are solved exactly, whatever the "
                 "iterations; 0: all are iterated"),
        field<S>(
            "accuracy", Number{{0, 1}}, &S::accuracy,
            "what the contacts of a larger island that rests may miss after the iterations, "
            "as a share of the mean weight of its bodies, in the root of the mean square; one "
            "that misses more, and that nothing holds or drives, is solved exactly, too; 0: it "
            "is iterated all the same"),
        field<S>(
            "exact_deformables", W{{0, 10000000}}, &S::exact_deformables,
            "a scene of at most so many particles solves what holds them together as one system, "
            "as stiff as their materials whatever the iterations, for ten to a hundred times "
            "the time; where there are more, or 0: all are iterated"),
        field<S>("multilevel", Flag{}, &S::multilevel,
                 "sheets, balloons and ropes are also solved patch by patch, from the whole down "
                 "to a few elements, so that large stiff ones do not give way at few iterations; "
                 "an iteration takes two to eight times as long"),
        field<S>(
            "tree_parts", W{{1, 4096}}, &S::tree_parts,
            "into how many parts a tree of joints that touches nothing may divide a substep in "
            "which it turns far, and up to eight times as many while it snaps; 1: none"),
        field<S>("joint_tolerance", Number{{1e-12, 1}}, &S::joint_tolerance,
                 "up to which trees of joints are closed [m], [rad]"),
        field<S>("sleep_speed", Number{{0, 1e3}}, &S::sleep_speed,
                 "bodies that touch one another fall asleep once no point of them has been faster "
                 "for sleep_time: they stay where they are and cost next to nothing until "
                 "something disturbs them [m/s]; 0: never"),
        field<S>("sleep_time", Number{{0, 1e9}}, &S::sleep_time, "see sleep_speed [s]"),
        field<S>("warm_start", Flag{}, &S::warm_start,
                 "begin from the impulses of the step before"),
        field<S>("alternate_sweeps", Flag{}, &S::alternate_sweeps,
                 "iterate forwards and backwards in turn"),
        field<S>("shared_push", Flag{}, &S::shared_push,
                 "The push of both passes together stays repulsive, not that of each pass alone."),
        field<S>("leapfrog_start", Flag{}, &S::leapfrog_start,
                 "Forces act for half of the first substep: places are then of second order in its "
                 "length, and velocities those in the middle of substeps."),
        field<S>("shared_cone", Flag{}, &S::shared_cone,
                 "one bound of friction for the velocity and the position pass"),
        field<S>("require", TextList{}, &S::require,
                 "effects that run although nothing seems to call for them"),
        field<S>("forbid", TextList{}, &S::forbid, "effects that never run"),
    };
    return table;
}

namespace {

/// One value of a command line: JSON if it is JSON, a number where a shell's user writes it
/// shorter (".1"), else a text.
Json loose_value(std::string_view text) {
    const Json value = Json::parse(text.begin(), text.end(), nullptr, false);
    if (!value.is_discarded() && !value.is_object()) return value;
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && stop == end && std::isfinite(number)) return number;
    return std::string(text);
}

/// "0,-9.81,0" → [0, -9.81, 0].
Json loose_list(std::string_view text) {
    Json list = Json::array();
    for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        list.push_back(loose_value(text.substr(begin, end - begin)));
        begin = end + 1;
    }
    return list;
}

bool takes_list(const std::string& key) {
    for (const auto& entry : settings_table()) {
        if (entry.key == key) return entry.schema.value("type", "") == "array";
    }
    return false;
}

}  // namespace

}  // namespace plumb::reader

namespace plumb {

void apply_setting(Settings& settings, std::string_view key_equals_value) {
    using namespace reader;
    const Source source{"--set " + std::string(key_equals_value), {}};
    const std::size_t equals = key_equals_value.find('=');
    if (equals == std::string_view::npos || equals == 0) {
        throw SceneError(source.name, "", "must be key=value, such as dt=0.005");
    }

    const std::string key(key_equals_value.substr(0, equals));
    const std::string_view text = key_equals_value.substr(equals + 1);
    Json value = loose_value(text);
    if (takes_list(key) && !value.is_array()) value = loose_list(text);

    // A copy, so that a bad value leaves the settings as they were.
    Settings changed = settings;
    const Json object = {{key, value}};
    read_object(changed, Node(object, source), settings_table());
    settings = changed;
}

}  // namespace plumb
