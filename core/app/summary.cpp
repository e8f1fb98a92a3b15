// SPDX-License-Identifier: MIT
#include "app/summary.h"

#include "kernels/contact_kernels.h"
#include "measure/measure.h"
#include "step/row_solver.h"
#include "world/sleep.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>

namespace plumb::app {
namespace {

using Json = nlohmann::ordered_json;

double mean(const std::vector<double>& v) {
    return v.empty() ? 0 : std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

Json times(const std::vector<double>& v) {
    return {{"median", percentile(v, 0.5)}, {"mean", mean(v)}, {"p99", percentile(v, 0.99)}};
}

Json mean_and_max(const std::vector<double>& v) {
    return {{"mean", mean(v)}, {"max", percentile(v, 1)}};
}

Json vector_json(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json speeds_json(const std::vector<double>& values) {
    const Speeds s = speeds_of(values);
    return {{"median", s.median}, {"p90", s.p90}, {"rms", s.rms}, {"max", s.max}};
}

std::string hex(std::uint64_t value) {
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

/// Heights over the origin of the dynamic bodies at the end [m].
struct Heights {
    double all = 0, near = 0, lowest = 0;
    std::size_t count = 0, near_count = 0;
};
Heights heights_of(const World& world) {
    Heights h;
    const Vector3d g = world.settings.gravity;
    const Vector3d up = g.norm() > 0 ? Vector3d(-g.normalized()) : Vector3d(Vector3d::UnitY());
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
        if (!is_movable(world.bodies.motion[i])) continue;
        const double y = up.dot(world.bodies.position[i]);
        h.lowest = h.count == 0 ? y : std::min(h.lowest, y);
        h.all += y;
        ++h.count;
        if ((world.bodies.position[i] - y * up).norm() > Statistics::kNearRadius) continue;
        h.near += y;
        ++h.near_count;
    }
    if (h.count) h.all /= static_cast<double>(h.count);
    if (h.near_count) h.near /= static_cast<double>(h.near_count);
    return h;
}

/// Whether the filters let two bodies meet.
bool may_meet(const BodySpec& a, const BodySpec& b) {
    return (a.group & b.mask) != 0 && (b.group & a.mask) != 0;
}

/// Whether the whole of a body is behind the surface of a plane that should hold it.
bool is_behind(const World& world, std::size_t body, std::size_t plane) {
    const Placement surface = geometry_placement(world.bodies, plane);
    const Vector3d normal = surface.rotation * Vector3d::UnitY();
    return normal.dot(world.bodies.position[body] - surface.position) <
           -world.bodies.bounding_radius[body];
}

/// How many dynamic bodies went through a fixed plane; null where there is none.
Json fallen_through(const Scene& scene, const World& world) {
    std::vector<std::size_t> planes;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const BodySpec& b = scene.bodies[i];
        if (b.motion == Motion::fixed && b.geometry != kNoIndex &&
            scene.geometries[b.geometry].kind == ShapeKind::plane)
            planes.push_back(i);
    }
    if (planes.empty()) return nullptr;
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        count +=
            scene.bodies[i].motion == Motion::dynamic && scene.bodies[i].geometry != kNoIndex &&
            std::any_of(planes.begin(), planes.end(), [&](std::size_t plane) {
                return may_meet(scene.bodies[i], scene.bodies[plane]) && is_behind(world, i, plane);
            });
    return count;
}

/// Most memory that the program has held [bytes].
std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

Json build_json() {
#ifdef NDEBUG
    constexpr const char* assertions = "off";
#else
    constexpr const char* assertions = "on";
#endif
    return {{"plumb", PLUMB_VERSION},
            {"compiler", __VERSION__},
            {"assertions", assertions},
            {"widest_lanes", widest_lanes()}};
}

Json stages_json(const Statistics& s) {
    Json stages = Json::object();
    for (std::size_t i = 0; i < kStageCount; ++i)
        if (s.stage_calls[i] > 0)
            stages[std::string(kStageNames[i])] = percentile(s.stage_ms[i], 0.5);
    return stages;
}

/// Stages that belong to one effect alone.
const std::map<Effect, std::vector<Stage>>& stages_of_effects() {
    static const std::map<Effect, std::vector<Stage>> stages{
        {Effect::contacts,
         {Stage::detect, Stage::match, Stage::schedule, Stage::begin, Stage::velocities,
          Stage::positions, Stage::remember}},
        {Effect::contact_reuse, {Stage::reuse}},
        {Effect::restitution, {Stage::restitution}},
        {Effect::impacts, {Stage::impacts}},
        {Effect::still_ground, {Stage::still_ground}},
        {Effect::exact_islands, {Stage::islands}},
        {Effect::joints, {Stage::joints}},
        {Effect::joint_trees, {Stage::trees}},
        {Effect::divided_trees, {Stage::divided_trees}},
        {Effect::deformables, {Stage::particles}},
        {Effect::exact_deformables, {Stage::particles}},
        {Effect::air_drag, {Stage::air_drag}},
        {Effect::tearing, {Stage::tearing}},
        {Effect::links, {Stage::links}},
        {Effect::particle_contacts, {Stage::particle_contacts}},
        {Effect::surface_contacts, {Stage::surface_contacts}},
        {Effect::kinematics, {Stage::kinematics}},
        {Effect::shock_propagation, {Stage::shock}}};
    return stages;
}

}  // namespace

Json effects_summary(const Simulation& simulation, const Statistics& statistics) {
    Json effects = Json::array();
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        const Decision& d = simulation.plan().decisions[i];
        Json entry{{"name", std::string(d.name)}, {"ran", d.runs}, {"why", d.why}, {"ms", nullptr}};
        const auto stages = stages_of_effects().find(static_cast<Effect>(i));
        double ms = 0;
        if (stages != stages_of_effects().end())
            for (Stage s : stages->second)
                ms += percentile(statistics.stage_ms[static_cast<std::size_t>(s)], 0.5);
        // what runs inside of another effect's kernels has no time of its own
        if (!d.runs)
            entry["ms"] = 0;
        else if (stages != stages_of_effects().end())
            entry["ms"] = ms;
        effects.push_back(entry);
    }
    return effects;
}

Json summary(const std::string& scene_file, const Scene& scene, const Simulation& simulation,
             const Statistics& s) {
    const World& world = simulation.world();
    const Settings& settings = world.settings;
    const Heights heights = heights_of(world);
    const DetectStats detect = simulation.detect_stats();
    const double steps = static_cast<double>(std::max<std::uint64_t>(1, simulation.steps()));
    const std::vector<double> penetration = s.over_last_fifth(&Sample::penetration);
    Json j;
    j["scene"] = scene.name;
    j["file"] = scene_file;
    j["collider"] = {{"name", simulation.collider_name()},
                     {"version", simulation.collider_version()},
                     {"why", simulation.collider_reason().empty() ? "asked for by name"
                                                                  : simulation.collider_reason()}};
    j["method"] = settings.method;
    j["precision"] = settings.precision == Precision::single ? "single" : "double";
    j["threads"] = settings.threads;
    j["lanes"] = lanes_of(world);
    j["dt"] = settings.dt;
    j["substeps"] = settings.substeps;
    j["velocity_iterations"] = settings.velocity_iterations;
    j["position_iterations"] = settings.position_iterations;
    j["steps"] = simulation.steps();
    j["simulated_time"] = simulation.time();
    j["bodies"] = world.bodies.size();
    const std::vector<Motion>& motion = world.bodies.motion;
    j["dynamic_bodies"] = std::count_if(motion.begin(), motion.end(), is_movable);
    j["deformables"] = world.deformables.size();
    j["particles"] = world.particles.size();
    j["joints"] = world.joints.size();
    j["links"] = world.links.size();
    j["contacts"] = {{"mean", s.contact_sum / steps},
                     {"max", s.contact_max},
                     {"end", world.contacts.found.size() + world.asleep.found.size()}};
    j["asleep"] = {{"max", s.asleep_max}, {"end", s.asleep_end}};
    j["pairs"] = {{"candidates", detect.broad_pairs}, {"touching", detect.narrow_pairs}};
    j["contacts"]["kept"] = world.contacts.kept.reused;
    j["contact_sources"] = {{"asked", settings.contacts == ContactOrigin::raw ? "raw" : "shared"},
                            {"backend", detect.from_backend},
                            {"clip", detect.from_clip},
                            {"fallback", detect.from_fallback}};
    j["time_ms"] = {{"detect", times(s.detect_ms)},
                    {"solve", times(s.solve_ms)},
                    {"step", times(s.step_ms)},
                    {"stages", stages_json(s)}};
    j["energy"] = {{"start", s.energy().start()},
                   {"end", kinetic_energy(world) + potential_energy(world)}};
    j["momentum"] = {{"linear", vector_json(linear_momentum(world))},
                     {"angular", vector_json(angular_momentum(world))}};
    j["penetration"] = {{"mean", mean(penetration)},
                        {"p99", percentile(penetration, 0.99)},
                        {"max", percentile(penetration, 1)}};
    j["joint_error"] = mean_and_max(s.over_last_fifth(&Sample::joint_error));
    j["joint_error"]["of_run"] = s.worst_joint();
    j["joint_turn_error"] = mean_and_max(s.over_last_fifth(&Sample::joint_turn_error));
    j["open_joints"] = s.joints().json(scene, world);
    j["link_error"] = mean_and_max(s.over_last_fifth(&Sample::link_error));
    j["speed"] = speeds_json(s.over_last_fifth(&Sample::speed));
    j["speed_near"] = speeds_json(s.over_last_fifth(&Sample::near_speed));
    j["speed_near"]["radius"] = Statistics::kNearRadius;
    j["speed_near"]["left_out"] = heights.count - heights.near_count;
    j["particle_speed"] = speeds_json(s.over_last_fifth(&Sample::particle_speed));
    j["strain"] = mean_and_max(s.over_last_fifth(&Sample::strain));
    j["volume_error"] = mean_and_max(s.over_last_fifth(&Sample::volume_error));
    j["final_height"] = {
        {"mean", heights.all}, {"mean_near", heights.near}, {"lowest", heights.lowest}};
    j["fallen_through"] = fallen_through(scene, world);
    j["torn"] = s.torn;
    j["broken"] = s.broken;
    j["clamps"] = {
        {"recovery", s.clamped_recoveries},         {"unsolved_islands", s.unsolved_islands},
        {"costly_islands", s.costly_islands},       {"unsolved_trees", s.unsolved_trees},
        {"coarse_trees", s.coarse_trees},           {"tree_error_m", s.tree_error},
        {"stretched_links", s.stretched_links},     {"link_error_m", s.link_error},
        {"rejected_contacts", s.rejected_contacts}, {"collider_failures", s.collider_failures}};
    j["residual"] = s.residual().json();
    j["state_hash"] = hex(state_hash(world));
    j["effects"] = effects_summary(simulation, s);
    j["build"] = build_json();
    j["peak_memory"] = peak_memory();
    j["warnings"] = simulation.plan().warnings;
    return j;
}

}  // namespace plumb::app
