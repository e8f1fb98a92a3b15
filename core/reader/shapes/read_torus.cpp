// SPDX-License-Identifier: MIT
#include "reader/shapes/read_torus.h"

#include "geometry/torus.h"

namespace plumb::reader {

namespace {

const Table<Torus>& torus_table() {
    using T = Torus;
    static const Table<T> table = {
        field<T>("ring_radius", Number{kLength}, &T::ring_radius,
                 "of the circle that the tube's centre runs along, about y [m]",
                 Presence::required),
        field<T>("tube_radius", Number{kLength}, &T::tube_radius, "[m], below ring_radius",
                 Presence::required),
        field<T>("segments", Whole<std::uint32_t>{{6, 256}}, &T::segments,
                 "convex wedges along the ring"),
        field<T>("sides", Whole<std::uint32_t>{{4, 256}}, &T::sides, "of a wedge's outline"),
    };
    return table;
}

}  // namespace

void read_torus(ShapeDraft& draft, const Node& node) {
    Torus torus;
    read_object(torus, node, torus_table());
    for (const Eigen::Vector2d& corner : outline_of(torus)) {
        if (corner.x() > 1e-3 * torus.ring_radius) continue;
        node.fail(
            "the torus has no hole: \"tube_radius\", with the corners of its outline, must "
            "stay below \"ring_radius\"");
    }
    draft.geometry.kind = ShapeKind::compound;
    draft.geometry.parts = wedges_of(torus);
}

SchemaJson torus_schema() { return object_schema(torus_table()); }

}  // namespace plumb::reader
