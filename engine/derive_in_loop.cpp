// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/derive_in_loop.h"

#include "engine/stages/build_fitting_map.h"

namespace toile {
namespace {

struct Scene {
  const Pattern& pattern;
  const PatternMesh& reference_mesh;
  const FittingMap& reference_fit;
  DrapeSeries& on_target;
  const GarmentMirrors& mirrors;
};

// One pass: the pattern that would make `shape` fit as on the reference body, and how it really drapes. `near`: what
// the pass before it derived.
DerivedPattern derive_and_drape(const Scene& scene, const Drape& shape, const Points2* near,
                                const DerivePatternOptions& derive_options, const DrapeOptions& drape_options,
                                Progress* progress) {
  DerivedPattern pass;
  pass.derivation = derive_pattern(scene.pattern, scene.reference_mesh, scene.reference_fit, shape, scene.mirrors,
                                   derive_options, progress, near);
  DrawnTarget target = draw_target(scene.pattern, scene.reference_mesh, scene.reference_fit, shape,
                                   pass.derivation.rest, scene.mirrors, derive_options, progress);
  pass.drawn = std::move(target.drawn);
  pass.kept_change = target.kept_change;
  pass.held_back = std::move(target.held_back);
  pass.derivation.flipped_triangles = target.inside.flipped_triangles;
  pass.mesh = scene.reference_mesh;
  pass.mesh.rest = std::move(target.inside.rest);
  pass.drape = scene.on_target.drape_from(scene.pattern, pass.mesh, shape, drape_options, progress);
  pass.fit = build_fitting_map(pass.mesh, pass.drape.drape);
  pass.rms_stretch_error = compare_fits(scene.reference_mesh, scene.reference_fit, pass.fit).whole.rms_stretch;
  return pass;
}

bool at_rest(const DerivedPattern& pass) {
  return pass.drape.quality.rest != Rest::NotAtRest;
}

}  // namespace

DerivedPattern derive_in_loop(const Pattern& pattern, const PatternMesh& reference_mesh,
                              const FittingMap& reference_fit, DrapeSeries& on_target, const Drape& transported,
                              const GarmentMirrors& mirrors, const DerivePatternOptions& derive_options,
                              const DrapeOptions& drape_options, const DeriveInLoopOptions& options,
                              Progress* progress) {
  const Scene scene{pattern, reference_mesh, reference_fit, on_target, mirrors};
  DerivedPattern best = derive_and_drape(scene, transported, nullptr, derive_options, drape_options, progress);
  std::vector<double> errors = {best.rms_stretch_error};
  while (static_cast<int>(errors.size()) < options.max_passes && !best.drape.diagnostics.tangled &&
         (!at_rest(best) || best.rms_stretch_error > options.good_enough)) {
    DerivedPattern next =
        derive_and_drape(scene, best.drape.drape, &best.derivation.rest, derive_options, drape_options, progress);
    errors.push_back(next.rms_stretch_error);
    const bool gained = next.rms_stretch_error < best.rms_stretch_error - options.least_gain;
    const double bar = (1.0 - options.least_nearer) * best.rms_stretch_error;
    // Rest is worth as much error as a further pass.
    const double worth = options.least_gain * (static_cast<int>(at_rest(next)) - static_cast<int>(at_rest(best)));
    if (!(next.rms_stretch_error < bar + worth)) break;  // a further pass would be the same again
    best = std::move(next);
    if (!gained && at_rest(best)) break;
  }
  best.pass_errors = std::move(errors);
  return best;
}

}  // namespace toile
