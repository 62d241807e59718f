// SPDX-License-Identifier: GPL-3.0-or-later
// Where the cloth of a kept piece comes from: the map from the wanted panel back to the original one, isometric but for
// the stretch the alteration leaves. Used by sew_altered only.   Lengths in metres.
#pragma once

#include <memory>

#include "engine/alter/altered_regions.h"
#include "engine/alter/sewn_pattern.h"

namespace toile {

struct PieceCloth {
  PieceMap map;
  std::vector<int> border;  // vertex of the map per border of the part, where that begins
  double strain = 0.0, turned_over = 0.0;
  std::string problem;  // why there is no such cloth, or empty
};

// Cloth of a panel's parts.
//   only insertions: as the inserting pass laid it     only removals: as the removing pass did
//   both: neither pass alone is isometric; the cloth is relaxed from the first one with its borders sliding where the
//   pass that made them has them
class ClothSource {
 public:
  ClothSource(const Sheet& inserting, const Sheet& removing, const PanelAlteration& alteration);
  ~ClothSource();
  PieceCloth of(const AlteredParts& parts, std::size_t part);

 private:
  class SheetMap;
  const SheetMap& inserted();
  const SheetMap& removed();
  void relax_both(const AlteredPart& part, PieceCloth& cloth);
  static void attach_borders(const AlteredPart& part, const PieceCloth& cloth, const SheetMap& inserted,
                             const SheetMap& removed, Sheet& sheet);

  const Sheet &inserting_, &removing_;
  bool inserts_, removes_;
  std::unique_ptr<SheetMap> inserted_,
      removed_;  // from the wanted panel to the original one, made when they are needed
};

// Of cloth that stays as it lies in the wanted panel.
PieceCloth identical_cloth(const AlteredParts& parts, std::size_t part, double edge_length);

}  // namespace toile
