// SPDX-License-Identifier: GPL-3.0-or-later
// Garments of ../shared/data altered for other bodies, as the alteration's benchmark tells of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/pipeline.h"
#include "engine/render/image.h"

namespace toile::bench {

struct AlterPair {
  std::string garment, body;  // names in ../shared/data, the body the one it is altered for
};

// The pairs of the derivation's acceptance: eight garments, five bodies.
std::vector<AlterPair> acceptance_pairs();

// What one alteration leaves and costs. Stretch errors and strains are dimensionless.
struct AlterOutcome {
  std::size_t operations = 0, tears = 0, flags = 0;
  double strain_before = 0.0, strain_after = 0.0;  // worst panel's p95 of both passes
  int most_cuts = 0;                               // into one side of a panel
  double narrowest = 0.0;                          // m, of what is let in and needs cloth; 0 if nothing is
  double balance = 0.0;                            // of areas, relative
  double plies = 0.0;                              // m, the most that both sides of a seam differ from what is eased
  double seconds = 0.0;                            // of CPU, one plan alone
  double all_seconds = 0.0;                        // of CPU, all plans with their drapes
  std::size_t plans = 0;                           // tried
};
AlterOutcome outcome_of(const AlterPatternResult& result);

// How the altered garment fits the target body, draped with its insertions sewn in.
struct AlterFit {
  std::string problem;                                                    // why it could not be draped, or empty
  double stretch_before = 0.0, stretch_ideal = 0.0, stretch_after = 0.0;  // rms error
  // m, rms from where the reference's drape is carried to on the target body: of the target pattern on the mesh it was
  // derived on, in the mean on three others as fine, of the altered garment
  double position_ideal = 0.0, position_anew = 0.0, position_after = 0.0;
};
AlterFit fit_of(const DerivedGarment& derived, const AlterPatternResult& result, const AlterOptions& options);

// As a job alters it.
AlterInLoopResult alter_derived(const DerivedGarment& derived, const AlterOptions& job);
// What its altered garment is held against, draped from `start`.
AlterationScene scene_of(const DerivedGarment& derived, const Drape& start);

// Every panel as it is cut (left) and as it will be (right). The title goes on: ": 3 operations, 1 flags".
Image picture_of(const std::string& title, const AlterPatternResult& result, int width);

// Pictures in rows of `columns`, on white.
Image tile(const std::vector<Image>& pictures, int columns);

}  // namespace toile::bench
