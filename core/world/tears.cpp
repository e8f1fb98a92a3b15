// SPDX-License-Identifier: MIT
#include "world/tears.h"

#include "geometry/outer_faces.h"
#include "scene/elements_left.h"

namespace plumb {
void leave_out_torn(Deformable& d) {
    const DeformableSpec& whole = d.whole;
    d.spec.kind = whole.kind;
    switch (whole.kind) {
        case DeformableKind::rope:
            d.spec.segments = elements_left(whole.segments, d.torn);
            break;
        case DeformableKind::balloon:
            if (!d.torn.empty()) d.spec.kind = DeformableKind::cloth;
            [[fallthrough]];
        case DeformableKind::cloth:
            d.spec.triangles = elements_left(whole.triangles, d.torn);
            break;
        case DeformableKind::solid:
            d.spec.tetrahedra = elements_left(whole.tetrahedra, d.torn);
            d.spec.triangles = d.torn.empty() ? whole.triangles : outer_faces(d.spec.tetrahedra);
            break;
    }
}

}  // namespace plumb
