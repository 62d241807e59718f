// SPDX-License-Identifier: GPL-3.0-or-later
// Tells cloth that swings along a soft valley from cloth at rest: both have next to no residual. Watched round after
// round.
#pragma once

#include "engine/core/types.h"

namespace toile {

class Swing {
 public:
  explicit Swing(const Points3& start) : last_(start) {}

  // `nodes` (#N x 3) at the end of a round. How far they will still move, root mean square, m: the moves of the last
  // two rounds continued as a geometric series; infinite while moves grow.
  double after_round(const Points3& nodes);

 private:
  Points3 last_;
  double move_ = 0.0;  // of the last round, root mean square, m
};

}  // namespace toile
