// SPDX-License-Identifier: GPL-3.0-or-later
// Which border chains of the pieces are sewn to each other: parts of the original seams, lips of cuts that are sewn up,
// and borders between pieces of one panel. Used by sew_altered only.   Lengths in metres.
#pragma once

#include <string>

#include "engine/alter/sewn_borders.h"

namespace toile {

struct ChainSeam {
  int a = -1, b = -1;  // chains
  bool right_wrong = false;
  bool added = false;  // made by the alteration; else a part of an original seam
  double eased = 0.0;  // m, by which the wanted pattern has a longer than b there; 0 for seams that are added
};

class ChainSeams {
 public:
  ChainSeams(const std::vector<PieceBorder>& pieces, const std::vector<BorderChain>& chains, const LineCorners& corners)
      : pieces_(pieces), chains_(chains), corners_(corners) {}

  // `target_rest`: the wanted pattern's flat positions of the mesh's vertices. Says in `open` what does not meet.
  std::vector<ChainSeam> find(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                              std::vector<std::string>& open) const;
  // One chain per stretch between a line's corners; -1 where there is none.
  std::vector<int> along(const SeamLine& line) const;

 private:
  const std::vector<PieceBorder>& pieces_;
  const std::vector<BorderChain>& chains_;
  const LineCorners& corners_;
};

}  // namespace toile
