// SPDX-License-Identifier: MIT
#include "effects/plan.h"

#include "effects/filter_reachability.h"
#include "scene/error.h"
#include "scene/nearest.h"
#include "schedule/joint_trees.h"
#include "world/round_shapes.h"
#include "world/sleep.h"

#include <algorithm>

namespace plumb {
namespace {

/// Whether the world wants an effect, and the reason in words either way.
struct Wish {
    bool wanted;
    std::string why;
};

/// What effects count of the bodies, once for all of them.
struct BodyCensus {
    explicit BodyCensus(const World& w) : collidable(collidable_bodies(w)) {
        const Bodies& b = w.bodies;
        for (std::uint32_t i = 0; i < b.size(); ++i) {
            const bool moves = is_movable(b.motion[i]);
            movable += moves, shaped += b.geometry[i] != kNoIndex;
            uneven += !b.isotropic[i], with_rim += has_rim(w, i);
            standing += !moves && b.bounding_radius[i] > 0;
        }
    }

    std::size_t movable = 0, shaped = 0, collidable;
    std::size_t uneven = 0;  ///< of unequal moments of inertia
    std::size_t with_rim = 0;
    std::size_t standing = 0;  ///< with a shape, fixed or kinematic
};

template <class Test>
std::size_t count_surface_pairs(const World& w, Test test) {
    return static_cast<std::size_t>(
        std::count_if(w.surface_pairs.begin(), w.surface_pairs.end(), test));
}
Wish counted(std::size_t n, const std::string& some, const std::string& none) {
    return n > 0 ? Wish{true, std::to_string(n) + " " + some} : Wish{false, none};
}

Wish contacts(const World& w, const BodyCensus& c) {
    if (c.movable + w.particles.size() == 0) return {false, "nothing moves by itself"};
    if (w.particles.size() > 0 && c.shaped > 0)
        return {true, std::to_string(c.shaped) + " bodies have shapes that particles may meet"};
    return counted(c.collidable, "bodies have shapes that may meet others",
                   "no two bodies have shapes that may meet");
}
Wish contact_reuse(const World& w, const BodyCensus& c) {
    if (!contacts(w, c).wanted) return {false, "there are no contacts"};
    if (!(w.settings.reuse_distance > 0)) return {false, "reuse_distance is 0"};
    if (w.settings.contacts == ContactOrigin::raw)
        return {false, "raw contacts may tell of overlaps alone, so each step asks anew"};
    return {true, "contacts of pairs that hardly moved are kept (reuse_distance > 0)"};
}
Wish friction(const World& w, const BodyCensus& c) {
    const std::size_t n =
        count_surface_pairs(w, [](const SurfacePair& s) { return s.friction > 0; });
    return counted(contacts(w, c).wanted ? n : 0, "pairs of materials have friction (μ > 0)",
                   "no pair of materials that can touch has friction");
}
Wish turning_friction(const World& w, const BodyCensus& c) {
    const std::size_t n = count_surface_pairs(
        w, [](const SurfacePair& s) { return s.rolling_friction > 0 || s.spinning_friction > 0; });
    return counted(contacts(w, c).wanted ? n : 0, "pairs of materials resist rolling or spinning",
                   "no pair of materials resists rolling or spinning");
}
Wish restitution(const World& w, const BodyCensus& c) {
    const std::size_t n =
        count_surface_pairs(w, [](const SurfacePair& s) { return s.restitution > 0; });
    return counted(contacts(w, c).wanted ? n : 0, "pairs of materials bounce (e > 0)",
                   "no pair of materials bounces");
}
Wish impacts(const World& w, const BodyCensus& c) {
    if (!contacts(w, c).wanted) return {false, "there are no contacts"};
    if (!w.settings.shared_push)
        return {false,
                "collisions and contacts are solved together, as in the paper (shared_push)"};
    return {true, "collisions are solved before forces, so that no contact remembers them"};
}
Wish sticking_anchors(const World& w, const BodyCensus& c) {
    if (!friction(w, c).wanted) return {false, "there is no friction"};
    if (!(w.settings.anchor_stiffness > 0)) return {false, "anchor_stiffness is 0"};
    return {true, "friction that sticks remembers where (anchor_stiffness > 0)"};
}
bool may_touch(const World& w, const BodyCensus& c) {
    return contacts(w, c).wanted &&
           std::count(w.settings.forbid.begin(), w.settings.forbid.end(), "contacts") == 0;
}
Wish rims(const World& w, const BodyCensus& c) {
    if (!may_touch(w, c)) return {false, "there are no contacts"};
    return counted(c.with_rim, "bodies have flat round ends, on whose rims they roll",
                   "no body has a flat round end");
}
Wish still_ground(const World& w, const BodyCensus& c) {
    if (!may_touch(w, c)) return {false, "there are no contacts"};
    if (!w.settings.shared_push)
        return {false, "what stands still may give energy, as in the paper (shared_push)"};
    return counted(
        c.standing,
        "bodies that are fixed, or kinematic and at rest, give no energy to what touches them",
        "nothing with a shape is fixed or kinematic");
}
Wish exact_islands(const World& w, const BodyCensus& c) {
    const bool is_tied = w.joints.size() > 1 || !w.joints.couplings.empty() ||
                         std::any_of(w.links.begin(), w.links.end(),
                                     [](const Link& link) { return link.is_between_bodies(); });
    if (!contacts(w, c).wanted && !is_tied)
        return {false, "there are no contacts, couplings or links between bodies"};
    const std::uint32_t most = w.settings.exact_islands;
    if (most < 2) return {false, "exact_islands is below 2"};
    if (!w.settings.shared_push)
        return {false, "the passes' pushes are apart, as in the paper (shared_push)"};
    if (std::count(w.settings.require.begin(), w.settings.require.end(), "shock_propagation") > 0)
        return {false, "shock propagation carries all that touches"};
    const char* beyond =
        w.settings.accuracy > 0 ? "; more, where they rest and miss \"accuracy\"" : "";
    return {true, "up to " + std::to_string(most) +
                      " bodies that touch, are linked or coupled are solved as one system, with "
                      "their joints (exact_islands)" +
                      beyond};
}
Wish gyroscopic(const World&, const BodyCensus& c) {
    return counted(c.uneven, "dynamic bodies have unequal moments of inertia",
                   "all moments of inertia are equal");
}
Wish joints(const World& w, const BodyCensus&) {
    return counted(w.joints.size(), "joints", "no joints");
}
Wish joint_trees(const World& w, const BodyCensus&) {
    if (w.joints.size() == 0) return {false, "no joints"};
    if (w.settings.joints == JointMethod::iterate) return {false, "joints are iterated"};
    const JointForest forest = find_forest(w, true);
    const std::size_t iterated = w.joints.size() - forest.edges - forest.loops;
    const std::string left_out =
        "bodies that hang together are iterated where more than one joint in ten closes a loop, "
        "there is more than one coupling to five joints, or they are a ragdoll without motors";
    return counted(
        forest.edges,
        "joints form trees, " + std::to_string(forest.loops) + " close loops" +
            (iterated > 0 ? ", " + std::to_string(iterated) + " are iterated: " + left_out : ""),
        w.settings.joints == JointMethod::auto_ ? left_out : "no joint takes away a row");
}
Wish divided_trees(const World& w, const BodyCensus& c) {
    const Wish trees = joint_trees(w, c);
    if (!trees.wanted) return {false, "no joints are solved as trees"};
    if (w.settings.tree_parts < 2) return {false, "tree_parts is below 2"};
    return {true, "trees that touch nothing and turn far divide their substeps (tree_parts)"};
}
Wish deformables(const World& w, const BodyCensus&) {
    return counted(w.particles.size(), "particles", "no deformables");
}
Wish exact_deformables(const World& w, const BodyCensus&) {
    const std::size_t n = w.particles.size();
    if (n == 0) return {false, "no deformables"};
    if (w.settings.exact_deformables == 0) return {false, "exact_deformables is 0"};
    if (!w.settings.shared_push)
        return {false, "the passes' pushes are apart, as in the paper (shared_push)"};
    const std::string most = std::to_string(w.settings.exact_deformables);
    if (n > w.settings.exact_deformables)
        return {false, std::to_string(n) + " particles are more than " + most +
                           " (exact_deformables), so that all are iterated"};
    return {true, std::to_string(n) + " particles, at most " + most +
                      ", are solved as one system (exact_deformables)"};
}
Wish air_drag(const World& w, const BodyCensus&) {
    if (!w.settings.wind) return {false, "there is no wind"};
    if (!(w.settings.air_density > 0)) return {false, "the air weighs nothing"};
    const auto feels =
        std::count_if(w.deformables.begin(), w.deformables.end(), [](const Deformable& d) {
            return !d.spec.triangles.empty() && d.spec.drag + d.spec.skin_drag > 0;
        });
    return counted(static_cast<std::size_t>(feels), "surfaces feel the air",
                   "nothing that deforms has a surface that feels the air");
}
Wish tearing(const World& w, const BodyCensus&) {
    const auto able = std::count_if(w.deformables.begin(), w.deformables.end(),
                                    [](const Deformable& d) { return d.can_tear(); });
    return counted(static_cast<std::size_t>(able), "deformables tear (tearing_strain)",
                   "nothing tears");
}
Wish links(const World& w, const BodyCensus&) {
    return counted(w.links.size(), "links and attachments", "no links or attachments");
}
Wish particle_contacts(const World& w, const BodyCensus& c) {
    if (w.particles.size() == 0) return {false, "no deformables"};
    if (!may_touch(w, c)) return {false, "there are no contacts"};
    return counted(c.shaped, "bodies have shapes that particles may meet",
                   "no body has a shape that particles may meet");
}
Wish surface_contacts(const World& w, const BodyCensus&) {
    if (std::count(w.settings.forbid.begin(), w.settings.forbid.end(), "contacts") > 0)
        return {false, "contacts are forbidden"};
    const auto surfaces =
        std::count_if(w.deformables.begin(), w.deformables.end(),
                      [](const Deformable& d) { return !d.spec.triangles.empty(); });
    return counted(static_cast<std::size_t>(surfaces),
                   "surfaces that particles and corners of bodies may meet",
                   "nothing that deforms has a surface");
}
Wish kinematics(const World& w, const BodyCensus&) {
    return counted(static_cast<std::size_t>(w.kinematic_count),
                   "bodies are moved by a script or a given velocity", "no kinematic bodies");
}
Wish sleeping(const World& w, const BodyCensus& c) {
    if (!(w.settings.sleep_speed > 0)) return {false, "sleep_speed is 0"};
    if (c.movable == 0) return {false, "no body moves by itself"};
    return {true, "what rests sleeps until it is disturbed (sleep_speed > 0)"};
}
Wish shock_propagation(const World&, const BodyCensus&) {
    return {false, "breaks the balance of momentum, so it runs only when required"};
}

struct Registered {
    std::string_view name;
    Wish (*wish)(const World&, const BodyCensus&);
};

/// In the order of `Effect`. A new effect is a line here, a name there and its stage in contacts/
/// or step/.
constexpr std::array<Registered, kEffectCount> kEffects{{
    {"contacts", contacts},
    {"contact_reuse", contact_reuse},
    {"friction", friction},
    {"turning_friction", turning_friction},
    {"restitution", restitution},
    {"impacts", impacts},
    {"sticking_anchors", sticking_anchors},
    {"rims", rims},
    {"still_ground", still_ground},
    {"gyroscopic", gyroscopic},
    {"exact_islands", exact_islands},
    {"joints", joints},
    {"joint_trees", joint_trees},
    {"divided_trees", divided_trees},
    {"deformables", deformables},
    {"exact_deformables", exact_deformables},
    {"air_drag", air_drag},
    {"tearing", tearing},
    {"links", links},
    {"particle_contacts", particle_contacts},
    {"surface_contacts", surface_contacts},
    {"kinematics", kinematics},
    {"sleeping", sleeping},
    {"shock_propagation", shock_propagation},
}};

/// The effect that `names[i]`, a list under `key` in the settings, names. Throws SceneError.
std::size_t effect_named(const std::vector<std::string>& names, std::size_t i, const char* key) {
    std::vector<std::string> known;
    for (std::size_t k = 0; k < kEffectCount; ++k) {
        if (kEffects[k].name == names[i]) return k;
        known.emplace_back(kEffects[k].name);
    }
    throw SceneError("", std::string("/settings/") + key + '/' + std::to_string(i),
                     "there is no effect \"" + names[i] + '"' + advice(names[i], known));
}

}  // namespace

Plan make_plan(const World& world) {
    const BodyCensus census(world);
    Plan plan;
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        const Wish wish = kEffects[i].wish(world, census);
        plan.decisions[i] = {kEffects[i].name, wish.wanted, wish.why};
    }
    const Settings& settings = world.settings;
    for (std::size_t i = 0; i < settings.require.size(); ++i) {
        Decision& d = plan.decisions[effect_named(settings.require, i, "require")];
        if (!d.runs) d.why = "required, although: " + d.why;
        d.runs = true;
    }
    for (std::size_t i = 0; i < settings.forbid.size(); ++i) {
        Decision& d = plan.decisions[effect_named(settings.forbid, i, "forbid")];
        const std::string name = '"' + settings.forbid[i] + '"';
        if (std::count(settings.require.begin(), settings.require.end(), settings.forbid[i]) > 0)
            plan.warnings.push_back(name + " is both required and forbidden: it does not run");
        else if (d.runs)
            plan.warnings.push_back(name + " is forbidden, but the scene calls for it: " + d.why);
        d.why = "forbidden" + (d.runs ? ", although: " + d.why : std::string());
        d.runs = false;
    }
    const auto drop = [&](Effect effect, const Wish& wish) {
        Decision& d = plan.decisions[static_cast<std::size_t>(effect)];
        if (!d.runs || wish.wanted) return;
        std::string said(1, '"');
        said.append(d.name).append("\" is required, but cannot run: ").append(wish.why);
        plan.warnings.push_back(said);
        d.why = wish.why, d.runs = false;
    };
    drop(Effect::exact_islands, exact_islands(world, census));
    drop(Effect::divided_trees, plan.runs(Effect::joints) && plan.runs(Effect::joint_trees)
                                    ? divided_trees(world, census)
                                    : Wish{false, "no joints are solved as trees"});
    drop(Effect::exact_deformables, plan.runs(Effect::deformables)
                                        ? exact_deformables(world, census)
                                        : Wish{false, "deformables do not run"});
    drop(Effect::air_drag, air_drag(world, census));
    drop(Effect::particle_contacts, plan.runs(Effect::contacts)
                                        ? particle_contacts(world, census)
                                        : Wish{false, "contacts do not run"});
    return plan;
}

}  // namespace plumb
