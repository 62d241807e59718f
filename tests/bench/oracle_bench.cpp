// SPDX-License-Identifier: GPL-3.0-or-later
// oracle [GARMENT...] [--triangles N] [--frictionless] [--residual R] [--stop-settled R] [--finer]: the default drape
// against Newton's, which goes on from the default's end with its contacts and friction anchors (without friction: from
// the same start) to a residual six orders below. Distances of nodes, heights of waist and hem, the hem's girth and the
// fitting map, beside CPU time.
// --finer: against the same cloth on triangles cut into four. Friction lets cloth rest in many ways, and a finer drape
// from flat ends in another one of them; so this one goes on from the default's end too, with its friction (anchors,
// loads per area) and its waist's height carried over and held, until its residual is below R (0.3 if not told). What
// is left is the error of the mesh. Stretch is compared with the mean of the four, as the
// fitting map has it and as each triangle's own.
#include <cmath>
#include <cstdio>

#include "engine/core/error.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/carry_drape.h"
#include "tests/bench/bench.h"
#include "tests/bench/fine_reference.h"
#include "tests/bench/split_mesh.h"
#include "tests/bench/words.h"
#include "tests/support/dressed.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

struct OracleRequest {
  std::vector<std::string> garments;
  int triangles = 10000;
  std::optional<double> residual, stop_settled;
  bool frictionless = false, finer = false;
};

OracleRequest oracle_request(Words words) {
  OracleRequest request;
  request.triangles = words.integer("--triangles").value_or(request.triangles);
  request.residual = words.number("--residual");
  request.stop_settled = words.number("--stop-settled");
  request.frictionless = words.flag("--frictionless");
  request.finer = words.flag("--finer");
  request.garments = words.rest();
  if (request.garments.empty())
    request.garments = {"dress_sleeveless", "tshirt_fitted", "leggings_tight", "skirt_pencil", "pants_straight"};
  return request;
}

void run_finer(const OracleRequest& request, const std::string& name, Table& table) {
  test::Dressing d = test::dress(name, request.triangles);
  if (request.stop_settled) d.options.stop_settled = *request.stop_settled;
  HeldDrape end;
  const double start = cpu_seconds();
  const DrapeResult usual = drape_to_hold(d.pattern, d.mesh, d.body, d.options, end, nullptr);
  const double usual_took = cpu_seconds() - start;
  const PatternMesh split = split_mesh(d.mesh);
  const DrapeEnd carried = carry_drape(d.pattern, d.mesh, {usual.drape, end}, split);
  d.options.stop_residual = request.residual.value_or(0.3);
  d.options.stop_settled = 0;
  d.options.iterations = 10000;
  const DrapeResult fine = drape_held(d.pattern, split, d.body, carried.drape, carried.held, d.options, nullptr);
  const AnswerError error =
      compare({split, fine.drape, fine.drape, split.rest}, {d.mesh, usual.drape, usual.drape, d.mesh.rest});
  table.add({name, std::to_string(d.mesh.triangle_count()), std::to_string(split.triangle_count()),
             fixed(usual_took, 2), fixed(cpu_seconds() - start - usual_took, 2), fixed(usual.quality.residual, 3),
             fixed(fine.quality.residual, 3), std::to_string(usual.diagnostics.iterations),
             std::to_string(fine.diagnostics.iterations), fixed(100 * error.stretch, 3),
             fixed(100 * error.triangle_stretch, 3), fixed(1e3 * error.position, 2), fixed(1e3 * error.hem, 2)});
}

void run_one(const OracleRequest& request, const std::string& name, Table& table) {
  test::Dressing d = test::dress(name, request.triangles);
  if (request.frictionless) d.options.friction = 0;
  if (request.stop_settled) d.options.stop_settled = *request.stop_settled;
  const double start = cpu_seconds();
  const DrapeResult usual = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
  const double usual_took = cpu_seconds() - start;
  d.options.solver = SolverKind::Newton;
  d.options.newton_residual = request.residual.value_or(1e-3);
  const DrapeResult exact = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
  const double exact_took = cpu_seconds() - start - usual_took;
  const Points3 off = usual.drape.nodes - exact.drape.nodes;
  const FittingMap a = build_fitting_map(d.mesh, usual.drape), b = build_fitting_map(d.mesh, exact.drape);
  const double squares =
      ((a.stretch_weft - b.stretch_weft).array().square() + (a.stretch_warp - b.stretch_warp).array().square())
          .matrix()
          .dot(a.rest_area) /
      (2 * a.rest_area.sum());
  table.add({name, std::to_string(d.mesh.triangle_count()), fixed(usual_took, 2), fixed(exact_took, 2),
             fixed(usual.quality.residual, 3), fixed(1e6 * exact.quality.residual, 2) + "e-6",
             std::to_string(usual.diagnostics.iterations),
             std::to_string(exact.diagnostics.iterations - usual.diagnostics.iterations),
             fixed(1e3 * std::sqrt(off.rowwise().squaredNorm().mean()), 2),
             fixed(1e3 * std::sqrt(off.rowwise().squaredNorm().maxCoeff()), 1),
             fixed(1e3 * std::abs(usual.drape.nodes.col(1).minCoeff() - exact.drape.nodes.col(1).minCoeff()), 2),
             fixed(1e3 * std::abs(test::waist_height(d.pattern, d.mesh, usual.drape) -
                                  test::waist_height(d.pattern, d.mesh, exact.drape)),
                   2),
             fixed(1e3 * (hem_girth(d.pattern, d.mesh, usual.drape) - hem_girth(d.pattern, d.mesh, exact.drape)), 1),
             fixed(100 * std::sqrt(squares), 3), fixed(usual.diagnostics.energy - exact.diagnostics.energy, 6)});
}

}  // namespace

int bench_oracle(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "toile-bench oracle needs ../shared/data\n");
    return 2;
  }
  const OracleRequest request = oracle_request(Words(arguments.words));
  if (request.finer) {
    Table finer({"garment", "triangles", "finer", "default CPU s", "finer CPU s", "default residual", "finer residual",
                 "default it", "finer it", "stretch rms %", "triangles' %", "position mm", "hem mm"});
    for (const std::string& name : request.garments) run_finer(request, name, finer);
    finer.print(arguments.csv);
    return 0;
  }
  Table table({"garment", "triangles", "default CPU s", "Newton CPU s", "default residual", "Newton residual",
               "default it", "Newton it", "rms mm", "most mm", "hem mm", "waist mm", "hem girth mm", "stretch rms %",
               "energy J above"});
  for (const std::string& name : request.garments) run_one(request, name, table);
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
