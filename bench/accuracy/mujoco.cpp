// SPDX-License-Identifier: MIT
/// MuJoCo 2.2 by semi-implicit Euler ("mujoco") and by Runge and Kutta ("mujoco RK4"), both with
/// elliptic cones, and the latter with pyramids, too, by which bodies slide more exactly.
///
/// Newton's solver. Constraints have the greatest impedance and the shortest time constant, two
/// steps; that of contacts is longer where steps are short, for else what slides hops off. Where
/// bodies bounce, contacts are springs and dampers whose restitution is that of the material.
/// Joints make trees in generalized coordinates; what closes a loop is a constraint.
#include "accuracy/mjcf.h"
#include "accuracy/peer.h"

#include <mujoco/mujoco.h>

#include <cstring>

namespace plumb::bench {
namespace {

using ModelPointer = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using DataPointer = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

mjModel* load(const std::string& text) {
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char error[1000] = "";
    mjModel* model = mj_loadXML("scene.xml", files.get(), error, sizeof error);
    mj_deleteVFS(files.get());
    if (!model) throw EngineFailure{};
    return model;
}

class MujocoPeer : public Peer {
public:
    MujocoPeer(const Scene& scene, const World& world, const Fineness& f,
               const MujocoMethod& method)
        : model_(load(mjcf(scene, world, f.dt, method)), mj_deleteModel),
          data_(mj_makeData(model_.get()), mj_deleteData) {
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            ids_.push_back(mj_name2id(model_.get(), mjOBJ_BODY, body_name(i).c_str()));
            if (ids_[i] >= 0) set_going(world.bodies, i);
        }
    }

    void step() override { mj_step(model_.get(), data_.get()); }

    void read(World& world) override {
        for (const int sign : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
            if (data_->warning[sign].number > 0) throw EngineFailure{};  // it has begun anew
        mj_kinematics(model_.get(), data_.get());
        mj_comPos(model_.get(), data_.get());
        mj_comVel(model_.get(), data_.get());
        for (std::size_t i = 0; i < ids_.size(); ++i) {
            if (ids_[i] < 0) continue;
            const mjtNum* x = data_->xpos + 3 * ids_[i];
            const mjtNum* q = data_->xquat + 4 * ids_[i];
            mjtNum v[6];
            mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, ids_[i], v, 0);
            world.bodies.position[i] = {x[0], x[1], x[2]};
            world.bodies.orientation[i] = Quaterniond(q[0], q[1], q[2], q[3]);
            world.bodies.angular_velocity[i] = {v[0], v[1], v[2]};
            world.bodies.velocity[i] = {v[3], v[4], v[5]};
        }
    }

private:
    /// Velocities of a body that hangs from the world, and the constant force and torque.
    void set_going(const Bodies& b, std::size_t i) {
        for (int k = 0; k < 3; ++k) {
            data_->xfrc_applied[6 * ids_[i] + k] = b.force[i][k];
            data_->xfrc_applied[6 * ids_[i] + 3 + k] = b.torque[i][k];
        }
        const int joint = model_->body_jntadr[ids_[i]], type = model_->jnt_type[joint];
        mjtNum* rate = data_->qvel + model_->jnt_dofadr[joint];
        const Vector3d spin = b.orientation[i].conjugate() * b.angular_velocity[i];
        if (type == mjJNT_FREE)
            for (int k = 0; k < 3; ++k) *rate++ = b.velocity[i][k];
        if (type == mjJNT_FREE || type == mjJNT_BALL)
            for (int k = 0; k < 3; ++k) *rate++ = spin[k];
    }

    ModelPointer model_;
    DataPointer data_;
    std::vector<int> ids_;  ///< [body]; −1: fixed
};

std::string unable(const Scene& scene) {
    if (!joints_are(scene, {JointKind::ball, JointKind::hinge, JointKind::distance}))
        return "only ball, hinge and distance joints are passed on";
    if (const std::string reason = other_shapes(scene, {ShapeKind::sphere, ShapeKind::cylinder});
        !reason.empty())
        return reason;
    try {
        const ModelPointer model(
            load(mjcf(scene, build_world(scene), scene.settings.dt, {"Euler", "elliptic"})),
            mj_deleteModel);
    } catch (const EngineFailure&) {
        return "its reader takes no tree as deep as that";
    }
    return "";
}

/// Of friction cones nothing is seen where nothing touches.
std::string unable_by_pyramids(const Scene& scene) {
    if (!collides(scene) || scene.bodies.size() < 2) return "nothing touches";
    return unable(scene);
}

Engine engine(const char* name, const MujocoMethod& method, std::string (*reason)(const Scene&)) {
    return {name, 0, reason,
            [method](const Scene& scene, const World& world, const Fineness& fineness) {
                return std::make_unique<MujocoPeer>(scene, world, fineness, method);
            }};
}

}  // namespace

std::vector<Engine> engines() {
    mju_user_error = [](const char*) { throw EngineFailure{}; };
    mju_user_warning = [](const char*) {};
    return {engine("mujoco", {"Euler", "elliptic"}, unable),
            engine("mujoco RK4", {"RK4", "elliptic"}, unable),
            engine("mujoco RK4 pyramids", {"RK4", "pyramidal"}, unable_by_pyramids)};
}

}  // namespace plumb::bench
