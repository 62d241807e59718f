// SPDX-License-Identifier: GPL-3.0-or-later
// From a garment and two bodies to an altered pattern: the order of the stages, and nothing else.
//
// Every stage's result is archived under a key made of its version, inputs and options; with a cache a stage that has
// run before is read back, so that a job resumes after any stage and a batch drapes its reference once.
// Source: [Eggler2024, Alg. 1].
#pragma once

#include "engine/alter_in_loop.h"
#include "engine/bodies/register_bodies.h"
#include "engine/core/options.h"
#include "engine/derive_in_loop.h"
#include "engine/pipeline_inputs.h"
#include "engine/stage_runner.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/compare_fits.h"
#include "engine/stages/drape.h"
#include "engine/stages/transport_garment.h"

namespace toile {

// A garment on a body: what `toile drape` answers.
struct DrapedGarment {
  Pattern pattern;
  PatternMesh mesh;
  Body body;
  DrapeResult drape;
  FittingMap fit;
};

// The ideal pattern, and what led to it.
struct DerivedGarment {
  DrapedGarment reference;
  Body target_body;
  RegisterBodiesResult registration;
  TransportGarmentResult transported;
  std::optional<DrapeResult> before;  // the garment as it is, on the target body, when an output needs it
  FittingMap fit_before;              // of `before`
  DerivedPattern derived;             // the ideal pattern and its drape on the target body
};

struct AlterResult : DerivedGarment {
  AlterPatternResult altered;             // how the original cloth becomes the ideal pattern
  PlacedPlans place;                      // how the altered garment lay, tried on, plan by plan
  std::optional<DrapedAlteration> after;  // the altered garment on the target body, when an output needs it
};

// How many stages a runner of each goes through, for its share of the progress.
inline constexpr int kDrapeStages = 4, kDeriveStages = 9, kAlterStages = 11;

// Whether an output that is asked for shows the altered garment on the target body, or tells of the garment as it is.
bool wants_after(const AlterOptions& options);
bool wants_before(const AlterOptions& options);

// All throw what their stages throw.
Keyed<DrapedGarment> drape_garment(const GarmentInput& garment, const BodyInput& body, const AlterOptions& options,
                                   StageRunner& runner);
Keyed<DerivedGarment> derive_garment(const GarmentInput& garment, const BodyInput& reference_body,
                                     const BodyInput& target_body, const AlterOptions& options, StageRunner& runner);
AlterResult alter_garment(const GarmentInput& garment, const BodyInput& reference_body, const BodyInput& target_body,
                          const AlterOptions& options, StageRunner& runner);

}  // namespace toile
