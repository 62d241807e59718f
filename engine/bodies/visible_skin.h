// SPDX-License-Identifier: GPL-3.0-or-later
// Which of a body's vertices can be seen from outside.
#pragma once

#include "engine/core/body.h"

namespace toile {

// 1 for vertices seen from at least a twentieth of 48 directions all round, 0 for hidden ones: the inside of a mouth,
// deep folds. A scanner never sees those, so nothing may be matched to them. Depth pictures at 4 mm; vertices within 8
// mm behind what is seen count as seen.
Eigen::VectorXd visible_skin(const TriangleMesh& body);

}  // namespace toile
