// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_memory.h"

#include <algorithm>

namespace toile {

bool lie_alike(const Sheet& a, const Sheet& b) {
  const auto same = [](const SheetVertex& v, const SheetVertex& w) {
    return v.flat == w.flat && v.now == w.now && v.anchors == w.anchors;
  };
  return a.panel == b.panel && a.faces == b.faces &&
         std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), same) &&
         std::equal(a.cuts.begin(), a.cuts.end(), b.cuts.begin(), b.cuts.end(),
                    [](const Cut& cut, const Cut& other) { return cut.lips == other.lips; });
}

SheetEquations& equations_of(std::shared_ptr<SheetEquations>& known, const Sheet& sheet, double hold) {
  if (!known) known = std::make_shared<SheetEquations>(sheet, hold);
  return *known;
}

}  // namespace toile
