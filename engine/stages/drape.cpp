// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/drape.h"

#include <memory>

#include "engine/stages/drape_series.h"
#include "engine/stages/draper.h"
#include "engine/stages/mesh_panels.h"

namespace toile {

namespace {

// A fine drape goes through meshes each so many times finer than the one before (1.6 and 2 move folds of fitted
// garments at 10,000 or 20,000 triangles farther from those at 40,000) ...
constexpr double kFiner = 2.5;
// ... and from none that it has not this many times the triangles of.
constexpr double kMuchFiner = 1.5;

void check_options(const DrapeOptions& o) {
  const auto check = [](bool good, const char* name, const char* range) {
    if (!good)
      throw Error(ErrorCode::OptionInvalid, std::string("options/drape/") + name,
                  std::string(name) + " must be " + range);
  };
  check(o.friction >= 0 && o.friction <= 2, "friction", "0 to 2");
  check(o.gravity >= 0 && o.gravity <= 100, "gravity", "0 to 100 m/s^2");
  check(o.thickness >= 0 && o.thickness <= 0.05, "thickness", "0 to 0.05 m");
  check(o.sag_radius > 0, "sag_radius", "positive");
  check(o.contact_stiffness > 0, "contact_stiffness", "positive");
  check(o.iterations >= 0 && o.iterations <= 100000, "iterations", "0 to 100000");
  check(o.stop_residual > 0, "stop_residual", "positive");
  check(o.stop_settled >= 0, "stop_settled", "0 or positive");
  check(o.fibre_slack >= 0 && o.fibre_slack <= 0.2, "fibre_slack", "0 to 0.2");
  check(o.shear_limit_deg >= 0 && o.shear_limit_deg <= 45, "shear_limit_deg", "0 to 45");
  check(o.lift >= 0 && o.lift <= 0.1, "lift", "0 to 0.1 m");
  check(o.first_rung >= 0 && o.first_rung <= Draper::kLastRung, "first_rung", "0 or 1");
  check(o.coarse_triangles == 0 || (o.coarse_triangles >= 500 && o.coarse_triangles <= 200000), "coarse_triangles",
        "0, or 500 to 200000");
}

void check_start(const PatternMesh& mesh, const Drape& start) {
  if (start.nodes.rows() != mesh.node_count || !start.nodes.allFinite())
    throw Error(ErrorCode::GarmentInvalid, "garment",
                "the given drape does not have one finite position for every node of the sewn garment");
}

// Whether a coarse drape first makes a difference: without friction there is one way to rest only.
bool begins_coarse(const PatternMesh& mesh, const DrapeOptions& options) {
  return options.coarse_triangles > 0 && mesh.triangle_count() > kMuchFiner * options.coarse_triangles &&
         options.friction > 0 && options.solver != SolverKind::Pbd;
}

// Of the mesh that a drape on so many triangles goes on from.
int triangles_before(int triangles, const DrapeOptions& options) {
  double before = options.coarse_triangles;
  while (kMuchFiner * kFiner * before < triangles) before *= kFiner;
  return static_cast<int>(before);
}

// The same coarse drapes for every fine mesh, whatever is asked of that.
DrapeOptions coarse_options(const DrapeOptions& options) {
  DrapeOptions coarse = options;
  coarse.solver = SolverKind::Default;
  coarse.stop_residual = DrapeOptions().stop_residual;
  coarse.stop_settled = DrapeOptions().stop_settled;
  return coarse;
}

std::unique_ptr<Draper> drape_from_flat(const Pattern& pattern, const PatternMesh& mesh, PreparedBody& body,
                                        const DrapeOptions& options, Progress* progress) {
  if (begins_coarse(mesh, options)) {
    report(progress, "sew", 0);
    Progress quiet;
    if (progress) quiet.cancelled = progress->cancelled;
    const DrapeOptions coarse = coarse_options(options);
    const PatternMesh before =
        mesh_panels(pattern, {.triangles = triangles_before(mesh.triangle_count(), options)}, &quiet);
    auto draper = std::make_unique<Draper>(pattern, mesh, body, options, progress);
    if (draper->from_coarser(*drape_from_flat(pattern, before, body, coarse, &quiet))) return draper;
  }
  auto draper = std::make_unique<Draper>(pattern, mesh, body, options, progress);
  draper->from_flat();
  return draper;
}

DrapeResult drape_whole(const Pattern& pattern, const PatternMesh& mesh, const Body& given, const DrapeOptions& options,
                        HeldDrape* end, Progress* progress) {
  check_options(options);
  PreparedBody body(given);
  const auto draper = drape_from_flat(pattern, mesh, body, options, progress);
  if (end) *end = draper->end();
  return draper->result();
}

}  // namespace

DrapeResult drape(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const DrapeOptions& options,
                  Progress* progress) {
  return drape_whole(pattern, mesh, body, options, nullptr, progress);
}

DrapeResult drape_to_hold(const Pattern& pattern, const PatternMesh& mesh, const Body& body,
                          const DrapeOptions& options, HeldDrape& end, Progress* progress) {
  return drape_whole(pattern, mesh, body, options, &end, progress);
}

DrapeResult drape_held(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const Drape& start,
                       const HeldDrape& held, const DrapeOptions& options, Progress* progress) {
  check_options(options);
  check_start(mesh, start);
  const FrictionState& friction = held.friction;
  for (const Eigen::Index rows : {friction.load.size(), friction.anchor.rows(), friction.normal.rows()})
    if (rows != mesh.node_count)
      throw Error(ErrorCode::GarmentInvalid, "garment", "the given friction does not have a row for every node");
  PreparedBody prepared(body);
  Draper draper(pattern, mesh, prepared, options, progress);
  draper.hold(held);
  return draper.from_start(start.nodes);
}

DrapeResult drape_from(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const Drape& start,
                       const DrapeOptions& options, Progress* progress) {
  return DrapeSeries(body).drape_from(pattern, mesh, start, options, progress);
}

DrapeSeries::DrapeSeries(const Body& body) : body_(std::make_unique<PreparedBody>(body)) {}
DrapeSeries::~DrapeSeries() = default;

DrapeResult DrapeSeries::drape_from(const Pattern& pattern, const PatternMesh& mesh, const Drape& start,
                                    const DrapeOptions& options, Progress* progress) {
  check_options(options);
  check_start(mesh, start);
  return Draper(pattern, mesh, *body_, options, progress).from_start(start.nodes);
}

}  // namespace toile
