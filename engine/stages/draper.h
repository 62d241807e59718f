// SPDX-License-Identifier: GPL-3.0-or-later
// One garment on one body: arranged, sewn and brought to rest from flat, or from a given start. Used by drape only; see
// drape.h.
#pragma once

#include "engine/sim/half_cloth.h"
#include "engine/sim/sewing.h"
#include "engine/stages/drape_held.h"
#include "engine/stages/prepared_body.h"

namespace toile {

class Draper {
 public:
  // The retry ladder: 0 as designed; 1 lifted more and pushed out harder at first. Growing the body from inside the
  // garment dresses none that these two do not (all garments on all bodies of ../shared/data).
  static constexpr int kLastRung = 1;

  // All but the progress must outlive this.
  Draper(const Pattern& pattern, const PatternMesh& mesh, PreparedBody& body, const DrapeOptions& options,
         Progress* progress);

  void from_flat();
  // From the end of the same garment from flat on a coarser mesh. False: a guard refuses the result.
  bool from_coarser(const Draper& coarse);
  DrapeResult from_start(Points3 start);  // #N x 3

  void hold(const HeldDrape& held) { start_ = &held, hold_friction_ = true; }  // must outlive this
  const HeldDrape& end() const { return end_; }
  const DrapeResult& result() const { return result_; }

 private:
  // Which panel dresses what, told by `vertices` (#V x 3), and the field that suits.
  void prepare(const Points3& vertices);
  const DrapeFinding* refusal() const;
  void attempt_from_flat(int rung);
  // Where all is the same on both sides, the drape is sought among symmetric ones.
  void find_mirror(const Points3& start);
  void make_symmetric(Points3& start);
  bool pinned_alike(const NodeMirror& mirror) const;
  // Without gravity, friction and contact between layers.
  Points3 smoothed(Points3 start, const SewingOptions& options);
  // Crossing itself all over: contact between layers would hold such knots instead of undoing them.
  bool tangled(const Points3& start) const;
  Points3 arranged(double lift);
  // The waist line may not sink below the mean height it has at the start.
  void hold_waist(const Points3& start);
  void pin(const std::vector<int>& nodes, const Points3& start);
  // Of the pattern's own pins.
  std::vector<int> pinned_nodes() const;
  void finish(const Points3& start);
  void measure();
  // Half a garment may catch in folds or on toes alike on both sides, where the whole frees itself.
  bool rests_well() const;
  void rest_from(const Points3& start);

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  PreparedBody& prepared_;
  const Body& body_;
  const DrapeOptions& options_;
  Progress* progress_;
  Cloth cloth_;
  BodyGuides guides_;
  BodyLevels levels_;
  GarmentClass garment_;
  SurfaceField* field_ = nullptr;
  double thickness_ = 0;
  std::vector<int> waist_;
  std::vector<Hold> holds_;
  std::vector<Pin> pins_;
  std::optional<NodeMirror> mirror_;  // where body and garment are the same on both sides
  std::optional<HalfCloth> half_;     // which then moves alone
  const HeldDrape* start_ = nullptr;  // of the start; null: from flat, or none is known
  bool hold_friction_ = false;        // that of the start for good, instead of frozen anew in rounds
  HeldDrape end_;
  bool worn_ = false;    // the garment is judged where it hangs on this body, not where it was placed
  bool rested_ = false;  // it starts from a rest
  DrapeResult result_;
};

}  // namespace toile
