// SPDX-License-Identifier: GPL-3.0-or-later
// Transport: carry a draped garment along a body map, from the reference body to the target body.
//
// Every garment node keeps its offset from the closest point of the body: c = closest point of v on the reference,
//   v' = M(c) + R (v - c),   R the smallest rotation from the normal at c to the normal at M(c).
// Far from the body (between the legs of a skirt, under wide arms) neighbours have closest points on different limbs;
// there, and where closest points jump near by (under a bust), the displacement is bridged by a thin plate on the
// garment, which keeps near nodes as they are. Nodes that end
// inside the target body are pushed out along the way to its surface.
// Source: [Eggler2024, Sec. 4.1]. Lengths in metres.
#pragma once

#include "engine/core/archive_values.h"
#include "engine/core/pattern_mesh.h"
#include "engine/core/progress.h"
#include "engine/core/record.h"

namespace toile {

struct TransportGarmentOptions {
  double clearance = 0.001;  // m, least distance to the target body afterwards, >= 0
  double near = 0.02;        // m, nodes up to here from the body are carried by it alone, > 0
  double far = 0.08;         // m, nodes from here on hardly feel it: the plate bridges them, > near
};

struct TransportGarmentResult {
  Drape drape;         // on the target body
  Record diagnostics;  // nodes pushed out, deepest before and after
};

template <class A>
void archive(A& a, TransportGarmentResult& v) {
  a(v.drape, v.diagnostics);
}

// Requires: map.mapped has one row per reference vertex. Ensures: as many nodes, all finite.
TransportGarmentResult transport_garment(const PatternMesh& mesh, const Drape& reference_drape,
                                         const Body& reference_body, const Body& target_body, const BodyMap& map,
                                         const TransportGarmentOptions& options = {},
                                         const Progress* progress = nullptr);

}  // namespace toile
