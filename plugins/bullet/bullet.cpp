// SPDX-License-Identifier: MIT
/// The collider on Bullet 3.24, in the precision that it is compiled for: tree of volumes, closest
/// points, shared support-face clipping.
#include "bullet/backend.h"
#include "bullet/broad.h"
#include "bullet/narrow.h"
#include "bullet/supported.h"

namespace plumb::bullet {
namespace {

class Bullet final : public Collider {
public:
    explicit Bullet(std::uint32_t threads) : Collider(kSupported, threads) {
        for (std::uint32_t i = 0; i < this->threads(); ++i)
            narrow_.push_back(std::make_unique<Narrow>());
    }

private:
    void prepare(Part& part) override { part.backend = make_shapes(part); }

    void find_pairs(std::vector<PartPair>& pairs) override { tree_.find_pairs(pairs, table_); }

    void place_parts(const PartPair* pairs, std::size_t count) override {
        each_part(pairs, count, [](const Part& part) { place_shapes(part); });
    }

    void collide_block(const NarrowOutput& out, const PartPair* pairs, std::size_t count, bool raw,
                       std::uint32_t worker) override {
        Narrow& narrow = *narrow_[worker];
        for (std::size_t i = 0; i < count; ++i) {
            const Part &a = table_.parts()[pairs[i].first], &b = table_.parts()[pairs[i].second];
            const bool mesh = has_surface(a.shape.kind) || has_surface(b.shape.kind);
            if (!built_ability(a.shape.kind, b.shape.kind)) continue;
            if (raw)
                narrow.collide_raw(out.contacts, out.stats, a, b);
            else if (mesh)
                narrow.collide_mesh(out.contacts, out.stats, a, b);
            else
                narrow.collide_convex(out.contacts, out.stats, a, b);
        }
    }

    Tree tree_;
    std::vector<std::unique_ptr<Narrow>> narrow_;  ///< [worker]
};

}  // namespace
}  // namespace plumb::bullet

plumb::Proximity* plumb_bullet_create(const plumb::CreateRequest* request, const char** message) {
    return plumb::create_collider<plumb::bullet::Bullet>(request, message);
}

void plumb_bullet_destroy(plumb::Proximity* proximity) {
    plumb::destroy_collider<plumb::bullet::Bullet>(proximity);
}
