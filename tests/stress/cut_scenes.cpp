// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/alter/alter_pattern.h"
#include "engine/archive_stages.h"
#include "engine/core/text.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/derive_pattern.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/mesh_panels.h"
#include "tests/stress/independent.h"
#include "tests/stress/part_scenes.h"
#include "tests/stress/patchwork.h"
#include "tests/support/tubes.h"

namespace toile::stress {
namespace {

struct Flat {
  Pattern pattern;
  PatternMesh mesh;
};

Flat random_flat(test::Dice& dice, bool wild) {
  Patchwork p;
  p.columns = dice.whole(2, wild ? 5 : 3);
  p.rows = dice.whole(1, 2);
  p.girth = dice.between(0.5, 1.2), p.height = dice.between(0.3, 0.9);
  if (wild && dice.chance(0.3)) p.sliver = dice.by_decades(0.003, 0.03);
  if (wild && dice.chance(0.3)) p.godet = dice.by_decades(0.005, 0.2);
  if (wild && dice.chance(0.3)) p.shear = dice.between(-0.5, 0.5);
  if (wild && dice.chance(0.2)) p.short_seam = 0.001;
  Flat flat;
  flat.pattern = make_pattern(p);
  validate_pattern(flat.pattern);
  flat.mesh = mesh_panels(flat.pattern, {.triangles = dice.whole(500, 700)});
  return flat;
}

// Smooth change of a panel's plane, the same for all panels so that seams keep fitting: scaling, shear, waves.
Points2 random_target(test::Dice& dice, const PatternMesh& mesh, bool wild, Outcome& outcome) {
  const double most = wild ? 0.5 : 0.12;
  const double sx = 1 + dice.between(-most, most), sy = 1 + dice.between(-most, most);
  const double shear = dice.between(-0.3, 0.3) * most, wave = dice.between(0, 0.12) * most;
  const double noise = wild && dice.chance(0.2) ? dice.by_decades(1e-5, 5e-3) : 0.0;
  outcome.what += print_text(" scaled %.3f x %.3f, shear %.3f, wave %.4f m, noise %.2g m", sx, sy, shear, wave, noise);
  Points2 target = mesh.rest;
  for (Eigen::Index i = 0; i < target.rows(); ++i) {
    const double x = mesh.rest(i, 0), y = mesh.rest(i, 1);
    target(i, 0) = sx * x + shear * y + wave * std::sin(9 * y) + dice.between(-noise, noise);
    target(i, 1) = sy * y + wave * std::sin(7 * x) + dice.between(-noise, noise);
  }
  return target;
}

}  // namespace

void run_cut_scene(test::Dice& dice, Outcome& outcome) {
  const bool wild = !dice.chance(0.4);
  outcome.human_range = !wild;
  const Flat flat = random_flat(dice, wild);
  outcome.what = print_text("%zu panels", flat.pattern.panels.size());
  const Points2 target = random_target(dice, flat.mesh, wild, outcome);
  const AlterPatternResult result = alter_pattern(flat.pattern, flat.mesh, target);
  check_balance(result, AlterPatternOptions().stretch_limit, outcome);
  if (!result.sewn.pieces.empty()) {
    try {
      validate_pattern(result.sewn.pattern);
    } catch (const Error& error) {
      outcome.fail(std::string("the sewn pattern cannot be cut: ") + error.what());
    }
  }
  if (dice.chance(0.3) && to_bytes(alter_pattern(flat.pattern, flat.mesh, target)) != to_bytes(result))
    outcome.fail("alteration differs when made again");
}

void run_derive_scene(test::Dice& dice, Outcome& outcome) {
  const Flat flat = random_flat(dice, true);
  const Points3 placed = test::placed_nodes(flat.pattern, flat.mesh);
  Points3 reference = placed, target = placed;
  const double crumple = dice.by_decades(1e-6, 0.05);
  const int kind = dice.whole(0, 4);
  for (Eigen::Index i = 0; i < target.size(); ++i) {
    reference.data()[i] *= 1.02;
    target.data()[i] += dice.between(-crumple, crumple);
  }
  if (kind == 1) target.col(1).setZero();                                // pressed flat on the floor
  if (kind == 2) target *= dice.by_decades(1e-9, 1e3);                   // tiny or huge
  if (kind == 3) target.rowwise() += Eigen::RowVector3d(1e6, 1e6, 1e6);  // far from the origin
  if (kind == 4)
    for (int i = 0; i < 20; ++i) target.row(dice.whole(0, static_cast<int>(target.rows()) - 1)) = target.row(0);
  outcome.what =
      print_text("drape of kind %d crumpled by %.2g m, %zu panels", kind, crumple, flat.pattern.panels.size());
  const FittingMap fit = build_fitting_map(flat.mesh, Drape{reference});
  const auto derive = [&] { return derive_pattern(flat.pattern, flat.mesh, fit, Drape{target}); };
  const DerivePatternResult result = derive();
  if (!result.rest.allFinite()) return outcome.fail("derived pattern is not finite");
  if (result.flipped_triangles != flipped_triangles(flat.mesh.triangles, result.rest))
    outcome.fail(print_text("told %d flipped triangles, found %d", result.flipped_triangles,
                            flipped_triangles(flat.mesh.triangles, result.rest)));
  for (std::size_t i = 1; i < result.sweeps.size(); ++i)
    if (result.sweeps[i].edge_weight == result.sweeps[i - 1].edge_weight &&
        result.sweeps[i].energy > result.sweeps[i - 1].energy * (1 + 1e-9) + 1e-15)
      outcome.fail(print_text("energy grows in sweep %zu from %.12g to %.12g", i, result.sweeps[i - 1].energy,
                              result.sweeps[i].energy));
  if (dice.chance(0.3) && derive().rest != result.rest) outcome.fail("derivation differs when made again");
}

}  // namespace toile::stress
