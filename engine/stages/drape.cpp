// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/drape.h"

#include <cmath>
#include <memory>

#include "engine/sim/relax.h"
#include "engine/sim/sewing.h"
#include "engine/stages/arrange_panels.h"
#include "engine/stages/find_skeleton.h"

namespace toile {
namespace {

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
}

class Draper {
 public:
  Draper(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const DrapeOptions& options,
         Progress* progress)
      : pattern_(pattern),
        mesh_(mesh),
        body_(body),
        options_(options),
        progress_(progress),
        cloth_(make_cloth(pattern, mesh)) {
    thickness_ = options.thickness + cloth_.mean_edge * cloth_.mean_edge / (8 * options.sag_radius);
    if (body_.kind == BodyKind::Human && !body_.skeleton) body_.skeleton = find_skeleton(body_.surface).skeleton;
    if (body_.skeleton) classify();
    const bool armless = body_.skeleton && !result_.diagnostics.bodice;
    const TriangleMesh surface = armless ? body_without_arms(body_) : body_.surface;
    field_ = std::make_unique<SurfaceField>(surface.vertices, surface.triangles);
  }

  DrapeResult from_flat() {
    report(progress_, "sew", 0);
    const Points3 start = body_.skeleton ? arranged() : welded(mesh_, placed_vertices(pattern_, mesh_));
    if (!result_.diagnostics.bodice) hold_waist(start);
    DrapeEnergy energy(cloth_, nullptr, 0.0);
    energy.holds = holds_;
    const SewingResult sewn = sew(energy, *field_, thickness_, start, {}, progress_);
    result_.diagnostics.sewing_iterations = sewn.iterations;
    return from(sewn.nodes);
  }

  DrapeResult from_start(const Points3& start) {
    if (!result_.diagnostics.bodice) hold_waist(start);
    return from(start);
  }

 private:
  void classify() {
    const SurfaceTree tree(body_.surface.vertices, body_.surface.triangles);
    guides_ = find_body_guides(body_, tree);
    levels_ = options_.drafted_for.value_or(guides_.levels);
    garment_ = classify_panels(pattern_, mesh_, placed_vertices(pattern_, mesh_), guides_, levels_);
    result_.diagnostics.bodice = garment_.bodice;
  }

  Points3 arranged() {
    ArrangeOptions options;
    options.lift = options_.lift;
    options.thickness = thickness_;
    const ArrangeResult arrangement = arrange_panels(pattern_, mesh_, garment_, guides_, levels_, *field_, options);
    result_.diagnostics.upper_shift = arrangement.upper_shift;
    return arrangement.nodes;
  }

  // The waist line may not sink below the mean height it has at the start.
  void hold_waist(const Points3& start) {
    const std::vector<int> nodes = waist_nodes(pattern_, mesh_, placed_vertices(pattern_, mesh_));
    double height = 0;
    for (int n : nodes) height += start(n, 1) / static_cast<double>(nodes.size());
    for (int n : nodes) holds_.push_back({n, height, options_.contact_stiffness * cloth_.node_area[n]});
    result_.diagnostics.hold_height = height;
  }

  DrapeResult from(const Points3& start) {
    if (options_.keep_drape)
      result_.drape.nodes = start;
    else
      relax_from(start);
    const DrapeQuality solved = result_.quality;
    result_.quality = measure_drape(mesh_, field_->tree(), result_.drape);
    result_.quality.rest = solved.rest;
    result_.quality.residual = solved.residual;
    result_.quality.settling_move = solved.settling_move;
    report(progress_, "drape", 1);
    return result_;
  }

  void relax_from(const Points3& start) {
    report(progress_, "drape", 0);
    ContactOptions contact_options;
    contact_options.thickness = thickness_;
    contact_options.stiffness = options_.contact_stiffness;
    contact_options.friction = options_.friction;
    Contact contact(cloth_, *field_, contact_options);
    DrapeEnergy energy(cloth_, &contact, options_.gravity);
    energy.holds = holds_;
    RelaxOptions relax_options;
    relax_options.iterations = options_.iterations;
    relax_options.stop_residual = options_.stop_residual;
    relax_options.watched = free_lines(pattern_, mesh_);
    const RelaxResult relaxed = relax(energy, start, relax_options, progress_);
    result_.drape.nodes = relaxed.nodes;
    DrapeDiagnostics& d = result_.diagnostics;
    d.iterations = relaxed.iterations;
    d.evaluations = relaxed.evaluations;
    d.energy = relaxed.energy;
    d.stalled = relaxed.stalled;
    result_.quality.residual = relaxed.residual;
    result_.quality.settling_move = relaxed.last_move;
    result_.quality.rest = relaxed.converged ? Rest::Converged : relaxed.settled ? Rest::Settled : Rest::NotAtRest;
  }

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  Body body_;
  const DrapeOptions& options_;
  Progress* progress_;
  Cloth cloth_;
  BodyGuides guides_;
  BodyLevels levels_;
  GarmentClass garment_;
  std::unique_ptr<SurfaceField> field_;
  double thickness_ = 0;
  std::vector<Hold> holds_;
  DrapeResult result_;
};

}  // namespace

DrapeResult drape(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const DrapeOptions& options,
                  Progress* progress) {
  check_options(options);
  return Draper(pattern, mesh, body, options, progress).from_flat();
}

DrapeResult drape_from(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const Drape& start,
                       const DrapeOptions& options, Progress* progress) {
  check_options(options);
  if (start.nodes.rows() != mesh.node_count || !start.nodes.allFinite())
    throw Error(ErrorCode::GarmentInvalid, "garment",
                "the given drape does not have one finite position for every node of the sewn garment");
  return Draper(pattern, mesh, body, options, progress).from_start(start.nodes);
}

}  // namespace toile
