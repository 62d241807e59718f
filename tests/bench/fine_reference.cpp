// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/fine_reference.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/flat_locator.h"
#include "engine/stage_options.h"
#include "tests/bench/bench.h"

namespace toile::bench {
namespace {

Triangles panel_triangles(const PatternMesh& mesh, std::size_t panel) {
  const PanelRange& range = mesh.panels[panel];
  return mesh.triangles.middleRows(range.triangle_begin, range.triangle_end - range.triangle_begin);
}

Points3 at_vertices(const PatternMesh& mesh, const Drape& drape) {
  Points3 all(mesh.vertex_count(), 3);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    all.row(v) = drape.nodes.row(mesh.node_of_vertex[static_cast<std::size_t>(v)]);
  return all;
}

// Mean stretch of the fine triangles whose middles lie in each coarse one, weighted by area.
class CoarseStretch {
 public:
  explicit CoarseStretch(const PatternMesh& coarse)
      : coarse_(coarse), area_(Eigen::VectorXd::Zero(coarse.triangle_count())), weft_(area_), warp_(area_) {}

  void add(const PatternMesh& fine, const FittingMap& fit) {
    for (std::size_t p = 0; p < fine.panels.size(); ++p) {
      const FlatLocator locator(coarse_.rest, panel_triangles(coarse_, p));
      for (int f = fine.panels[p].triangle_begin; f < fine.panels[p].triangle_end; ++f) {
        Vec2 middle = Vec2::Zero();
        for (int k = 0; k < 3; ++k) middle += fine.rest.row(fine.triangles(f, k)).transpose() / 3.0;
        const int in = coarse_.panels[p].triangle_begin + locator.closest(middle).triangle;
        area_[in] += fit.rest_area[f];
        weft_[in] += fit.rest_area[f] * fit.stretch_weft[f];
        warp_[in] += fit.rest_area[f] * fit.stretch_warp[f];
      }
    }
  }
  double rms_from(const FittingMap& fit) const {
    double squares = 0.0, sum = 0.0;
    for (int f = 0; f < coarse_.triangle_count(); ++f) {
      if (!(area_[f] > 0)) continue;
      const double weft = fit.stretch_weft[f] - weft_[f] / area_[f], warp = fit.stretch_warp[f] - warp_[f] / area_[f];
      squares += 0.5 * fit.rest_area[f] * (weft * weft + warp * warp);
      sum += fit.rest_area[f];
    }
    return std::sqrt(squares / sum);
  }

 private:
  const PatternMesh& coarse_;
  Eigen::VectorXd area_, weft_, warp_;
};

Vec2 middle_of(const PatternMesh& mesh, int triangle) {
  Vec2 middle = Vec2::Zero();
  for (int k = 0; k < 3; ++k) middle += mesh.rest.row(mesh.triangles(triangle, k)).transpose() / 3.0;
  return middle;
}

// Value at the middle of `own` of the plane that fits the values of the triangles round about best.
double plane_at(const PatternMesh& mesh, int own, const std::vector<int>& around, const Eigen::VectorXd& values) {
  const Vec2 centre = middle_of(mesh, own);
  Mat3 moments = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const int f : around) {
    const Vec2 at = (middle_of(mesh, f) - centre) / mesh.target_edge_length;
    const Vec3 row(1.0, at.x(), at.y());
    moments += row * row.transpose();
    right += values[f] * row;
  }
  return moments.ldlt().solve(right)[0];
}

// Stretch recovered from that of the triangles which share a corner: a plane through it. [ZienkiewiczZhu1992]
FittingMap recovered(const PatternMesh& mesh, FittingMap fit) {
  std::vector<std::vector<int>> at_vertex(static_cast<std::size_t>(mesh.vertex_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) at_vertex[static_cast<std::size_t>(mesh.triangles(f, k))].push_back(f);
  const Eigen::VectorXd weft = fit.stretch_weft, warp = fit.stretch_warp;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    std::vector<int> around;
    for (int k = 0; k < 3; ++k)
      for (const int g : at_vertex[static_cast<std::size_t>(mesh.triangles(f, k))]) around.push_back(g);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    if (around.size() < 6) continue;
    fit.stretch_weft[f] = plane_at(mesh, f, around, weft);
    fit.stretch_warp[f] = plane_at(mesh, f, around, warp);
  }
  return fit;
}

// Root mean square distance after the turn and shift that make it least.
double rms_after_motion(const Points2& a, const Points2& b) {
  const Eigen::RowVector2d mean_a = a.colwise().mean(), mean_b = b.colwise().mean();
  const Points2 x = a.rowwise() - mean_a, y = b.rowwise() - mean_b;
  const Mat2 m = x.transpose() * y;
  const double angle = std::atan2(m(0, 1) - m(1, 0), m(0, 0) + m(1, 1));
  const Mat2 turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return std::sqrt((x * turn.transpose() - y).rowwise().squaredNorm().mean());
}

double pattern_error(const Answer& fine, const Answer& coarse) {
  double squares = 0.0, count = 0.0;
  for (std::size_t p = 0; p < coarse.mesh.panels.size(); ++p) {
    const Triangles triangles = panel_triangles(fine.mesh, p);
    const FlatLocator locator(fine.mesh.rest, triangles);
    std::vector<int> border;
    for (const auto& edge : coarse.mesh.edge_vertices[p]) border.insert(border.end(), edge.begin(), edge.end());
    Points2 here(static_cast<Eigen::Index>(border.size()), 2), there = here;
    for (std::size_t i = 0; i < border.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      here.row(row) = coarse.target_rest.row(border[i]);
      there.row(row) = locator.closest(coarse.mesh.rest.row(border[i])).of(fine.target_rest, triangles);
    }
    const double rms = rms_after_motion(here, there);
    squares += rms * rms * static_cast<double>(border.size());
    count += static_cast<double>(border.size());
  }
  return std::sqrt(squares / count);
}

double position_error(const Answer& fine, const Answer& coarse) {
  const Points3 there = at_vertices(fine.mesh, fine.reference_drape),
                here = at_vertices(coarse.mesh, coarse.reference_drape);
  double squares = 0.0;
  for (std::size_t p = 0; p < coarse.mesh.panels.size(); ++p) {
    const Triangles triangles = panel_triangles(fine.mesh, p);
    const FlatLocator locator(fine.mesh.rest, triangles);
    for (int v = coarse.mesh.panels[p].vertex_begin; v < coarse.mesh.panels[p].vertex_end; ++v)
      squares += (locator.closest(coarse.mesh.rest.row(v)).of(there, triangles) - here.row(v)).squaredNorm();
  }
  return std::sqrt(squares / coarse.mesh.vertex_count());
}

}  // namespace

SceneBodies read_scene(const test::Scene& scene) {
  SceneBodies bodies{read_garment(scene.garment), read_body(scene.reference), read_body(scene.target), {}};
  bodies.map = register_bodies(bodies.reference, bodies.target).map;
  return bodies;
}

Answer answer(const SceneBodies& scene, const Accuracy& accuracy) {
  AlterOptions options;
  options.solver = accuracy.solver;
  DrapeOptions drape_options = drape_options_of(options);
  drape_options.stop_residual = accuracy.stop_residual;
  drape_options.newton_residual = std::min(1e-3, 0.01 * accuracy.stop_residual);
  Answer result;
  const double start = cpu_seconds();
  result.mesh = mesh_panels(scene.pattern, {.triangles = accuracy.triangles});
  result.reference_drape = drape(scene.pattern, result.mesh, scene.reference, drape_options, nullptr).drape;
  const FittingMap fit = build_fitting_map(result.mesh, result.reference_drape);
  const Drape carried =
      transport_garment(result.mesh, result.reference_drape, scene.reference, scene.target, scene.map).drape;
  const auto plane = mirror_plane_of(options, scene.pattern);
  const auto mirrors =
      plane ? find_garment_mirrors(scene.pattern, result.mesh, result.reference_drape, *plane) : GarmentMirrors{};
  const DerivedPattern derived = derive_in_loop(scene.pattern, result.mesh, fit, scene.target, carried, mirrors,
                                                derive_options_of(options), drape_options, loop_options_of(options));
  result.target_drape = derived.drape.drape;
  result.target_rest = derived.mesh.rest;
  result.cpu_s = cpu_seconds() - start;
  return result;
}

AnswerError compare(const Answer& fine, const Answer& coarse) {
  AnswerError error;
  CoarseStretch stretch(coarse.mesh);
  stretch.add(fine.mesh, build_fitting_map(fine.mesh, fine.reference_drape));
  const FittingMap fit = build_fitting_map(coarse.mesh, coarse.reference_drape);
  error.stretch = stretch.rms_from(fit);
  error.recovered_stretch = stretch.rms_from(recovered(coarse.mesh, fit));
  error.position = position_error(fine, coarse);
  error.pattern = pattern_error(fine, coarse);
  error.hem = std::abs(fine.reference_drape.nodes.col(1).minCoeff() - coarse.reference_drape.nodes.col(1).minCoeff());
  return error;
}

}  // namespace toile::bench
