// SPDX-License-Identifier: MIT
#include "accuracy/tree.h"

#include <utility>

namespace plumb::bench {

Trees trees(const Scene& scene, const World& world) {
    Trees found;
    std::vector<bool> hangs(scene.bodies.size());
    std::vector<const JointSpec*> unused;
    for (const JointSpec& joint : scene.joints)
        if (!(joint.compliance > 0)) unused.push_back(&joint);
    std::vector<std::uint32_t> level{kNoIndex};
    const auto grow = [&] {
        while (!level.empty()) {
            std::vector<std::uint32_t> next;
            for (const std::uint32_t from : level)
                std::erase_if(unused, [&](const JointSpec* joint) {
                    if (joint->body_a != from && joint->body_b != from) return false;
                    const std::uint32_t body =
                        joint->body_b == from ? joint->body_a : joint->body_b;
                    if (body == kNoIndex || hangs[body]) return false;
                    hangs[body] = true;
                    found.bodies.push_back({body, joint, from});
                    next.push_back(body);
                    return true;
                });
            level = std::move(next);
        }
    };
    grow();
    for (std::uint32_t i = 0; i < hangs.size(); ++i) {
        if (hangs[i] || !is_dynamic(world, i)) continue;
        hangs[i] = true;
        found.bodies.push_back({i, nullptr, kNoIndex});
        level = {i};
        grow();
    }
    found.loops = std::move(unused);
    return found;
}

}  // namespace plumb::bench
