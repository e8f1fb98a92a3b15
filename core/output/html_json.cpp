// SPDX-License-Identifier: MIT
#include "output/html_json.h"

#include "math/bytes.h"
#include "output/html_deformables.h"
#include "output/html_page.h"
#include "output/palette.h"
#include "output/triangles.h"
#include "output/vector_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

using nlohmann::json;

/// Width by height of the window that a fitted view is made for; the player fits again on demand.
constexpr double kAspect = 16.0 / 9.0;

/// Adds a mesh to the bytes; says where it begins and how large it is.
json put_mesh(std::string& meshes, const Geometry& geometry) {
    const TriangleMesh mesh = triangles_of(geometry);
    json j{{"offset", meshes.size()},
           {"vertices", mesh.vertices.size()},
           {"triangles", mesh.triangles.size()}};
    for (const Eigen::Vector3f& v : mesh.vertices) {
        for (int i = 0; i < 3; ++i) put(meshes, v[i]);
    }
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) put(meshes, corner);
    }
    return j;
}

json shape_to_json(std::string& meshes, const Geometry& g) {
    json j{{"kind", name_of(g.kind)}};
    switch (g.kind) {
        case ShapeKind::plane:
            break;
        case ShapeKind::sphere:
            j["radius"] = g.radius;
            break;
        case ShapeKind::box:
            j["half_extents"] = to_json(g.half_extents);
            break;
        case ShapeKind::capsule:
        case ShapeKind::cylinder:
        case ShapeKind::cone:
            j["radius"] = g.radius;
            j["half_height"] = g.half_height;
            break;
        case ShapeKind::hull:
        case ShapeKind::mesh:
        case ShapeKind::height_field:
            j["mesh"] = put_mesh(meshes, g);
            break;
        case ShapeKind::compound:
            j["parts"] = json::array();
            for (const GeometryPart& part : g.parts) {
                j["parts"].push_back({{"shape", shape_to_json(meshes, part.geometry)},
                                      {"position", to_json(part.local.position)},
                                      {"rotation", to_json(part.local.rotation)}});
            }
            break;
    }
    return j;
}

bool same(const PoseSample& a, const PoseSample& b) {
    return a.position == b.position && a.small == b.small && a.largest == b.largest;
}

bool moves(const std::vector<PoseSample>& motion) {
    return std::any_of(motion.begin(), motion.end(),
                       [&motion](const PoseSample& s) { return !same(s, motion.front()); });
}

/// Pose of a body that never moves: position, then rotation.
json resting_pose(const PoseSample& sample) {
    RotationCode code{{sample.small[0], sample.small[1], sample.small[2]}, sample.largest};
    const Eigen::Quaterniond q = decode_rotation(code, kReplayRotationBits);
    return {sample.position[0], sample.position[1], sample.position[2], q.x(), q.y(), q.z(), q.w()};
}

json bodies_to_json(const RecordingHeader& header) {
    json list = json::array();
    for (std::size_t i = 0; i < header.bodies.size(); ++i) {
        const RecordedBody& body = header.bodies[i];
        list.push_back({{"name", body.name},
                        {"shape", body.geometry < header.geometries.size()
                                      ? static_cast<std::int64_t>(body.geometry)
                                      : -1},
                        {"fixed", body.motion == Motion::fixed},
                        {"color", body_color(body, i)}});
    }
    return list;
}

/// Finest step of place that is worth storing for a body [m].
double finest_step(const RecordingHeader& header, std::size_t body) {
    const std::uint32_t geometry = header.bodies[body].geometry;
    return geometry < header.geometries.size() ? bounding_radius(header.geometries[geometry]) / 2000
                                               : 0;
}

/// Puts the bodies that move into the stream and the others into the JSON.
void put_motion(json& scene, std::string& stream, const RecordingHeader& header,
                const std::vector<std::vector<PoseSample>>& motions) {
    std::vector<std::vector<PoseSample>> moving;
    std::vector<PositionGrid> grids;
    json list = json::array();
    for (std::size_t i = 0; i < motions.size(); ++i) {
        if (header.bodies[i].geometry >= header.geometries.size() || motions[i].empty()) continue;
        if (!moves(motions[i])) {
            scene["bodies"][i]["pose"] = resting_pose(motions[i].front());
            continue;
        }
        grids.push_back(position_grid(motions[i], finest_step(header, i)));
        list.push_back(
            {{"body", i}, {"low", to_json(grids.back().low)}, {"quantum", grids.back().quantum}});
        moving.push_back(motions[i]);
    }
    scene["moving"] = std::move(list);
    scene["rotation_bits"] = kReplayRotationBits;
    stream = encode_motion(moving, grids);
}

/// The same for deformables, and the links.
void put_deformables(json& scene, ReplayParts& parts, const RecordingHeader& header,
                     const std::vector<Frame>& notes, const std::vector<ParticleMotion>& motions) {
    std::vector<ParticleGrid> grids;
    for (std::size_t i = 0; i < motions.size(); ++i)
        grids.push_back(particle_grid(header.deformables[i], motions[i]));
    scene["deformables"] = deformables_json(header, notes, grids, parts.meshes);
    scene["links"] = links_json(header);
    parts.particles = encode_particles(motions, grids);
}

json frames_to_json(const std::vector<Frame>& notes) {
    json j{{"step", json::array()},      {"time", json::array()},
           {"contacts", json::array()},  {"kinetic", json::array()},
           {"potential", json::array()}, {"penetration", json::array()}};
    for (const Frame& frame : notes) {
        j["step"].push_back(frame.step);
        j["time"].push_back(frame.time);
        j["contacts"].push_back(frame.contacts);
        j["kinetic"].push_back(frame.kinetic_energy);
        j["potential"].push_back(frame.potential_energy);
        j["penetration"].push_back(frame.deepest_penetration);
    }
    return j;
}

/// NaN becomes null.
json residuals_to_json(const std::vector<Frame>& notes) {
    json j{{"force_of_weight", json::array()}, {"force", json::array()}, {"error", json::array()}};
    for (const Frame& frame : notes) {
        j["force_of_weight"].push_back(frame.residual.force_of_weight);
        j["force"].push_back(frame.residual.force);
        j["error"].push_back(frame.residual.error);
    }
    return j;
}

json view_to_json(const View& view, const Eigen::Vector3d& origin) {
    return {{"eye", to_json(view.eye - origin)},
            {"target", to_json(view.target - origin)},
            {"field_of_view", view.field_of_view}};
}

/// The text of a JSON value as it may stand in a page.
std::string safe_text(const json& j) {
    return without_tags(j.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

ReplayParts replay_parts(const RecordingHeader& header, const std::vector<Frame>& notes,
                         const ReplayMotions& motions, const std::vector<Ball>& balls) {
    ReplayParts parts;
    json scene{{"name", header.name},
               {"description", header.description},
               {"method", header.method},
               {"collider", header.metadata.collider},
               {"dt", header.dt},
               {"up", to_json(up_direction(header))},
               {"metadata", header.metadata.values}};
    scene["view"] = view_to_json(chosen_view(header, balls, kAspect), header.origin);
    scene["shapes"] = json::array();
    for (const Geometry& g : header.geometries) {
        scene["shapes"].push_back(shape_to_json(parts.meshes, g));
    }
    scene["bodies"] = bodies_to_json(header);
    scene["frames"] = frames_to_json(notes);
    if (header.residuals) scene["frames"]["residual"] = residuals_to_json(notes);
    put_motion(scene, parts.motion, header, motions.bodies);
    put_deformables(scene, parts, header, notes, motions.deformables);
    parts.scene = safe_text(scene);
    return parts;
}

ShapeTexts shape_texts(const std::vector<const Geometry*>& geometries) {
    ShapeTexts texts;
    json shapes = json::array();
    for (const Geometry* g : geometries)
        shapes.push_back(g ? shape_to_json(texts.meshes, *g) : json());
    texts.shapes = safe_text(shapes);
    return texts;
}

}  // namespace plumb
