// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/drape.h"

#include <cmath>
#include <numeric>

#include "engine/sim/relax.h"
#include "engine/sim/sewing.h"

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

// Nodes where the placement of their panels puts them: the mean over the vertices of a node.
Points3 placed(const Pattern& pattern, const PatternMesh& mesh) {
  Points3 nodes = Points3::Zero(mesh.node_count, 3);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(mesh.node_count);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(mesh.panel_of_vertex[static_cast<std::size_t>(v)])];
    const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
    nodes.row(node) += (panel.rotation * Vec3(mesh.rest(v, 0), mesh.rest(v, 1), 0) + panel.translation).transpose();
    count[node] += 1;
  }
  return nodes.array().colwise() / count.array();
}

class Draper {
 public:
  Draper(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const DrapeOptions& options,
         Progress* progress)
      : pattern_(pattern),
        mesh_(mesh),
        options_(options),
        progress_(progress),
        cloth_(make_cloth(pattern, mesh)),
        field_(body.surface.vertices, body.surface.triangles) {
    thickness_ = options.thickness + cloth_.mean_edge * cloth_.mean_edge / (8 * options.sag_radius);
  }

  DrapeResult from_flat() {
    report(progress_, "sew", 0);
    DrapeEnergy energy(cloth_, nullptr, 0.0);
    const SewingResult sewn = sew(energy, field_, thickness_, placed(pattern_, mesh_), {}, progress_);
    result_.diagnostics.sewing_iterations = sewn.iterations;
    return from(sewn.nodes);
  }

  DrapeResult from(const Points3& start) {
    if (options_.keep_drape)
      result_.drape.nodes = start;
    else
      relax_from(start);
    const double residual = result_.diagnostics.residual;
    result_.quality = measure_drape(mesh_, field_.tree(), result_.drape);
    result_.quality.residual = residual;
    result_.quality.rest = residual < 0.3 ? Rest::Converged : Rest::NotAtRest;
    report(progress_, "drape", 1);
    return result_;
  }

 private:
  void relax_from(const Points3& start) {
    report(progress_, "drape", 0);
    ContactOptions contact_options;
    contact_options.thickness = thickness_;
    contact_options.stiffness = options_.contact_stiffness;
    contact_options.friction = options_.friction;
    Contact contact(cloth_, field_, contact_options);
    DrapeEnergy energy(cloth_, &contact, options_.gravity);
    RelaxOptions relax_options;
    relax_options.iterations = options_.iterations;
    relax_options.stop_residual = options_.stop_residual;
    const RelaxResult relaxed = relax(energy, start, relax_options, progress_);
    result_.drape.nodes = relaxed.nodes;
    DrapeDiagnostics& d = result_.diagnostics;
    d.iterations = relaxed.iterations;
    d.evaluations = relaxed.evaluations;
    d.energy = relaxed.energy;
    d.residual = relaxed.residual;
    d.stalled = relaxed.stalled;
  }

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const DrapeOptions& options_;
  Progress* progress_;
  Cloth cloth_;
  SurfaceField field_;
  double thickness_ = 0;
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
  return Draper(pattern, mesh, body, options, progress).from(start.nodes);
}

}  // namespace toile
