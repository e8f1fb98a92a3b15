// SPDX-License-Identifier: MIT
#include "app/comparison_json.h"

#include "measure/measure.h"
#include "study/comparison_rows.h"
#include "world/contacts.h"

namespace plumb::app {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }
Json to_json(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json step_or_null(std::uint64_t step) { return step > 0 ? Json(step) : Json(); }

Json answer_figures(const study::AnswerFigures& f, std::uint64_t poses) {
    double sum = 0;
    for (const double ms : f.milliseconds) sum += ms;
    const double count = static_cast<double>(std::max<std::uint64_t>(1, poses));
    Json j{{"ms",
            {{"median", percentile(f.milliseconds, 0.5)},
             {"mean", sum / count},
             {"p99", percentile(f.milliseconds, 0.99)}}},
           {"contacts_a_pose", static_cast<double>(f.contacts) / count},
           {"from_backend", f.sum.from_backend},
           {"from_clip", f.sum.from_clip},
           {"from_fallback", f.sum.from_fallback},
           {"shared_normals", f.sum.shared_normals},
           {"own_normal_share", f.contacts > 0 ? 1 - static_cast<double>(f.sum.shared_normals) /
                                                         static_cast<double>(f.contacts)
                                               : 1.0},
           {"rejected", f.rejected},
           {"failures", f.failures}};
    if (f.failures > 0) j["first_failure"] = f.first_failure;
    return j;
}

Json totals_json(const ComparisonTotals& t, const ComparisonKind& kind, bool meshes) {
    Json j{{"agrees", t.agrees()},       {"compared", t.compared()},        {"both", t.agreed},
           {"only_first", t.only_first}, {"only_second", t.only_second},    {"grazing", t.grazing},
           {"apart", t.apart},           {"ambiguous_normals", t.ambiguous}};
    j["rows"] = Json::array();
    for (const study::AspectRow& row : study::rows_of(t, kind, meshes)) {
        Json r{{"key", row.key},           {"label", row.label},   {"tolerance", row.tolerance},
               {"compared", row.compared}, {"within", row.within}, {"verdict", row.verdict}};
        if (row.wanted >= 0) r["wanted"] = row.wanted;
        if (!row.unit.empty() && row.compared > 0)
            r["errors"] = {
                {"median", row.median}, {"p99", row.p99}, {"worst", row.worst}, {"unit", row.unit}};
        j["rows"].push_back(std::move(r));
    }
    return j;
}

Json sets_json(const ContactComparison& c, const ComparisonKind& kind) {
    return {{"convex", totals_json(c.convex(), kind, false)},
            {"meshes", totals_json(c.meshes(), kind, true)}};
}

Json contacts_json(const std::vector<Contact>& contacts) {
    Json list = Json::array();
    for (const Contact& c : contacts)
        list.push_back({{"point", to_json(common_point(c))},
                        {"normal", to_json(c.normal)},
                        {"gap", c.gap},
                        {"flags", c.flags},
                        {"part_a", c.part_a},
                        {"part_b", c.part_b}});
    return list;
}

/// Where the body's shape is: what a drawing needs. A body's own pose is that of its mass.
Json body_json(const Scene& scene, const Bodies& bodies, std::uint32_t i, const Pose& pose) {
    const Quaterniond rotation = to_eigen(pose.rotation);
    const Placement& local = bodies.geometry_in_body[i];
    const Quaterniond q = rotation * local.rotation;
    return {{"index", i},
            {"name", study::body_name(scene, i)},
            {"shape", study::shape_text(scene, i)},
            {"geometry", scene.bodies[i].geometry},
            {"position", to_json(Vector3d(to_eigen(pose.position) + rotation * local.position))},
            {"rotation", {q.x(), q.y(), q.z(), q.w()}}};
}

Json finding_json(const Scene& scene, const Bodies& bodies, const study::ComparisonResult& r,
                  const study::Finding& f) {
    const Disagreement& d = f.disagreement;
    return {{"colliders", {r.colliders[f.first].info.name, r.colliders[f.second].info.name}},
            {"set", f.raw ? "raw" : "clipped"},
            {"judged", f.judged},
            {"aspect", study::name_of(d.aspect)},
            {"error", d.error},
            {"tolerance", d.tolerance},
            {"words", study::difference_text(f)},
            {"step", d.step},
            {"time", d.time},
            {"bodies",
             {body_json(scene, bodies, d.a, d.pose_a), body_json(scene, bodies, d.b, d.pose_b)}},
            {"answers",
             {{{"words", study::answer_text(d.first)}, {"contacts", contacts_json(d.first)}},
              {{"words", study::answer_text(d.second)}, {"contacts", contacts_json(d.second)}}}}};
}

}  // namespace

Json comparison_json(const Scene& scene, const Bodies& bodies, const study::ComparisonResult& r) {
    Json j{{"scene", scene.name},
           {"description", scene.description},
           {"agrees", r.agrees()},
           {"raw_judged", r.raw_judged},
           {"interrupted", r.was_interrupted},
           {"diverged_after_step", step_or_null(r.diverged_after)},
           {"driver", r.colliders[r.driver].info.name},
           {"poses", r.poses},
           {"steps", r.steps},
           {"simulated_time", r.time},
           {"dt", scene.settings.dt},
           {"margin", scene.settings.margin}};
    j["colliders"] = Json::array();
    for (const study::ColliderFigures& c : r.colliders)
        j["colliders"].push_back({{"name", c.info.name},
                                  {"version", c.info.version},
                                  {"precision", c.info.precision},
                                  {"own_process", c.own_process},
                                  {"clipped", answer_figures(c.clipped, r.poses)},
                                  {"raw", answer_figures(c.raw, r.poses)}});
    j["pairs"] = Json::array();
    for (const study::PairFigures& pair : r.pairs) {
        const SourceInfo &first = r.colliders[pair.first].info,
                         &second = r.colliders[pair.second].info;
        const bool single = first.precision == "single" || second.precision == "single";
        j["pairs"].push_back({{"first", first.name},
                              {"second", second.name},
                              {"agrees", r.agrees(pair)},
                              {"clipped", sets_json(pair.clipped, {single, false})},
                              {"raw", sets_json(pair.raw, {single, true})}});
    }
    j["disagreements"] = Json::array();
    for (const study::Finding& f : study::findings_of(r))
        j["disagreements"].push_back(finding_json(scene, bodies, r, f));
    return j;
}

Json free_runs_json(const study::ComparisonResult& r, const study::FreeRuns& runs) {
    Json j{{"times", runs.times}, {"colliders", Json::array()}, {"pairs", Json::array()}};
    for (std::size_t i = 0; i < r.colliders.size(); ++i)
        j["colliders"].push_back({{"name", r.colliders[i].info.name},
                                  {"height", runs.height[i]},
                                  {"energy", runs.energy[i]},
                                  {"diverged_after_step", step_or_null(runs.diverged_after[i])}});
    for (const study::Drift& d : runs.drifts)
        j["pairs"].push_back({{"first", r.colliders[d.first].info.name},
                              {"second", r.colliders[d.second].info.name},
                              {"mean", d.mean},
                              {"largest", d.largest}});
    return j;
}

}  // namespace plumb::app
