// SPDX-License-Identifier: MIT
/// How a scene is to be simulated. Every member has a key of the same name in a scene's "settings".
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

enum class Precision : std::uint32_t { single, double_ };
/// How joints are solved: those that form trees exactly, or all by iterations; auto: exactly unless
/// more than one in ten closes a loop, or some are driven or limited.
enum class JointMethod : std::uint32_t { auto_, tree, iterate };
/// Which contacts the solver runs on: those that plugins clip from the true shapes with a
/// back-end's normal, or what the back-end itself reports (kDetectRaw).
enum class ContactOrigin : std::uint32_t { shared, raw };
enum class Gyroscopic : std::uint32_t { conserving, implicit, explicit_ };

struct Settings {
    Eigen::Vector3d gravity{0, -9.81, 0};  ///< [m/s²]
    std::optional<Eigen::Vector3d> wind;   ///< velocity of the air; none: there is no air [m/s]
    Eigen::Vector3d gusts{0, 0, 0};        ///< by how much the wind swings about that [m/s]
    double gust_period = 3;                ///< of the swing along x, see scene/wind.h [s]
    double air_density = 1.2;              ///< [kg/m³]
    double dt = 0.01;                      ///< step [s]
    double duration = 10;                  ///< [s]
    std::uint32_t substeps = 1;            ///< small steps to one detection
    std::uint32_t velocity_iterations = 5;
    std::uint32_t position_iterations = 5;

    std::string method = "pbd";
    Precision precision =
        Precision::single;  ///< of the solver's iterations; states and poses are always double
    std::uint32_t threads = 1;
    std::uint32_t lanes =
        0;  ///< constraints solved side by side: 1, 4, 8, 16; 0 = as the scene calls for

    ContactOrigin contacts = ContactOrigin::shared;
    double margin = 0.005;         ///< distance of detection [m]
    double reuse_distance = 1e-4;  ///< d: while the points of a pair move by less, its contacts are
                                   ///< kept and not detected again [m]; 0 = always detect
    double stiffness = 0.2;  ///< s of §6: share of an old overlap removed a substep (where solved
                             ///< exactly, one of 10 ms or longer, and less in shorter ones); an
                             ///< iteration, of five, where shared_push is off
    double recovery_speed = 1.0;  ///< greatest speed at which old overlap is pushed out (that of
                                  ///< small bodies more slowly: no higher than gravity takes back
                                  ///< within a share of their size), and at
                                  ///< which what joints are beyond a limit or off a coupling goes
                                  ///< [m/s], [rad/s]
    double collision_depth =
        1e-4;  ///< ε: a pair collides when it approaches faster than √(2 g ε) [m]
    double anchor_stiffness =
        0.02;  ///< β: share of a sticking contact's anchor slip undone a substep; 0 = no anchors
    Gyroscopic gyroscopic = Gyroscopic::conserving;
    bool leapfrog_start = false;  ///< half a push in the first substep: places are then of second
                                  ///< order in its length, velocities those of substeps' middles

    JointMethod joints = JointMethod::auto_;
    std::uint32_t exact_islands = 400;  ///< islands of at most so many bodies that touch are solved
                                        ///< exactly, whatever the iterations; 0 = all are iterated
    double accuracy = 0.03;  ///< what contacts of a larger island that rests may miss, as
                             ///< a share of the mean weight of its bodies (root mean
                             ///< square); one that misses more is solved exactly; 0 = it
                             ///< is iterated all the same
    std::uint32_t exact_deformables = 0;  ///< deformables of at most so many particles together are
                                          ///< solved as one system; 0 = all are iterated
    bool multilevel = false;              ///< sheets and ropes are also solved patch by patch, from
                                          ///< the whole down to a few elements
    std::uint32_t tree_parts = 64;        ///< into how many parts a tree of joints that touches
                                          ///< nothing may divide a substep (eight times as many
                                          ///< while it snaps); 1 = none
    double joint_tolerance = 5e-7;        ///< up to which trees of joints are closed [m], [rad]

    double sleep_speed = 0;   ///< bodies that touch one another fall asleep once no point of them
                              ///< has been faster for sleep_time, and cost next to nothing until
                              ///< they are disturbed [m/s]; 0 = never
    double sleep_time = 0.5;  ///< [s]

    bool warm_start = true;        ///< begin from the impulses of the step before
    bool alternate_sweeps = true;  ///< forwards and backwards in turn
    bool shared_push =
        true;  ///< the push λ_velocity + λ_position stays repulsive as a whole, not each part
    bool shared_cone = true;  ///< one friction bound μ(λ_velocity + λ_position) for both passes

    std::vector<std::string> require;  ///< effects that run although nothing seems to call for them
    std::vector<std::string> forbid;   ///< effects that never run
};

/// Steps that come nearest to the duration.
inline std::uint64_t step_count(const Settings& s) {
    return static_cast<std::uint64_t>(std::llround(s.duration / s.dt));
}

/// The paper's step to the letter: no warm start, no alternating iterations, friction bounds of
/// each pass apart, no anchors, sums of each pass apart, explicit gyroscopic term, contacts
/// detected anew in every step, joints by iterations.
inline void apply_paper_preset(Settings& s) {
    s.warm_start = s.alternate_sweeps = s.shared_cone = s.shared_push = false;
    s.anchor_stiffness = s.reuse_distance = 0;
    s.gyroscopic = Gyroscopic::explicit_;
    s.joints = JointMethod::iterate;
    s.exact_islands = s.exact_deformables = 0;
    s.multilevel = false;
    s.accuracy = s.sleep_speed = 0;
}

}  // namespace plumb
